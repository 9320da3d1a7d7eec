"""The smallest correction of a claim that fails.

The order in which its files are built on one another: `_places` (where a formula can be changed),
`_multiplier` (by which factor), `_edits` (how that is written), `_trials` and
`_numeric_evaluator` (what is left of a changed claim at sample points), `_repair_context` and
`_missing_terms` (letters and terms of the text), `_repair_search` (candidates for one claim) and
`_repair` (which of them is proposed). It is built on `contexts`, and nothing there on it.
"""

from polhode.claims.repair._edits import Repaired as Repaired
from polhode.claims.repair._places import tidied as tidied
from polhode.claims.repair._repair import repaired as repaired
