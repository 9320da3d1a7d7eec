"""The smallest correction of a claim that fails.

Each file uses those before it: `_places` (where a formula can be changed), `_multiplier` (by which
factor), `_edits` (how an author would write that), `_trials` and `_numeric_evaluator` (residuals of
a changed claim at sample points), `_repair_context` and `_missing_terms` (letters and terms of the
text), `_small_changes` and `_screens` (slips of one stroke, tried by numbers), `_repair_search`
(candidates for one claim), `_repair` (which of them is proposed) and `_spelling` (in the author's
spelling). The package uses `contexts`, and nothing there uses it.
"""

from polhode.judge.repair._edits import Repaired as Repaired
from polhode.judge.repair._repair import repaired as repaired
from polhode.judge.repair._spelling import spelled as spelled
