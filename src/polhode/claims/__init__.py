"""Claims of texts, read, bound to a model, and judged.

What judges whole documents is fetched when first asked for, so that one check loads no more than
it needs.
"""

from typing import TYPE_CHECKING, Any

from polhode.claims._bindings import Bound as Bound
from polhode.claims._bindings import BoundRelation as BoundRelation
from polhode.claims._check import check as check
from polhode.claims._document import Claim as Claim
from polhode.claims._document import Definition as Definition
from polhode.claims._document import Document as Document
from polhode.claims._document import Part as Part
from polhode.claims._meaning import BindingError as BindingError
from polhode.claims._notation import Notation as Notation
from polhode.claims._verdict import Answer as Answer
from polhode.claims._verdict import Confirmation as Confirmation
from polhode.claims._verdict import Correction as Correction
from polhode.claims._verdict import Counterexample as Counterexample
from polhode.claims._verdict import Residual as Residual
from polhode.claims._verdict import Verdict as Verdict
from polhode.claims.latex import Statement as Statement
from polhode.claims.latex import read_latex as read_latex
from polhode.claims.latex import write_latex as write_latex

if TYPE_CHECKING:
    from polhode.claims._late import Consequence as Consequence
    from polhode.claims._late import Judged as Judged
    from polhode.claims._late import Limits as Limits
    from polhode.claims._late import Report as Report
    from polhode.claims._late import audit as audit
    from polhode.claims._late import audit_apart as audit_apart
    from polhode.claims._late import read_document as read_document
    from polhode.claims._late import tidied as tidied
    from polhode.claims._late import told as told

_LATE = {
    "Limits",
    "audit_apart",
    "audit",
    "read_document",
    "Consequence",
    "Judged",
    "Report",
    "told",
    "tidied",
}


def __getattr__(name: str) -> Any:
    if name not in _LATE:
        raise AttributeError(f"module 'polhode.claims' has no attribute {name!r}")
    from polhode.claims import _late

    globals().update({late: getattr(_late, late) for late in _LATE})
    return globals()[name]
