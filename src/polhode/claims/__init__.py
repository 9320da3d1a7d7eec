"""Published equations read from LaTeX, bound to a model and judged.

The code that judges whole documents is imported on first use, so that a single check stays light.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from polhode.claims._check import CheckRequest as CheckRequest
from polhode.claims._notation import Notation as Notation
from polhode.claims._verdict import Answer as Answer
from polhode.claims._verdict import Confirmation as Confirmation
from polhode.claims._verdict import Correction as Correction
from polhode.claims._verdict import Counterexample as Counterexample
from polhode.claims._verdict import Read as Read
from polhode.claims._verdict import Residual as Residual
from polhode.claims._verdict import Verdict as Verdict
from polhode.claims.document._document import Claim as Claim
from polhode.claims.document._document import Definition as Definition
from polhode.claims.document._document import Document as Document
from polhode.claims.document._document import Note as Note
from polhode.claims.document._document import Part as Part
from polhode.claims.latex import Statement as Statement
from polhode.claims.latex import read_latex as read_latex
from polhode.claims.latex import write_latex as write_latex
from polhode.claims.meaning._bindings import Bound as Bound
from polhode.claims.meaning._meaning import BindingError as BindingError
from polhode.claims.meaning._relations import BoundRelation as BoundRelation
from polhode.claims.processes._limited_check import check as check
from polhode.claims.processes._limited_check import uncorrected as uncorrected

if TYPE_CHECKING:
    from polhode.claims._audit import audit as audit
    from polhode.claims.document._read_document import read_document as read_document
    from polhode.claims.document._report import Consequence as Consequence
    from polhode.claims.document._report import Judged as Judged
    from polhode.claims.document._report import Report as Report
    from polhode.claims.document._report import tally as tally
    from polhode.claims.processes._parallel_audit import ClaimLimits as ClaimLimits
    from polhode.claims.processes._parallel_audit import audit_apart as audit_apart
    from polhode.claims.source import DocumentRead as DocumentRead
    from polhode.claims.source import Macro as Macro
    from polhode.claims.source import ShownFormula as ShownFormula
    from polhode.claims.source import SourceRelation as SourceRelation
    from polhode.claims.source import SourceWords as SourceWords
    from polhode.claims.source import read_documents as read_documents
    from polhode.claims.source import read_file as read_file
    from polhode.claims.source import read_pieces as read_pieces
    from polhode.claims.source import read_source as read_source
    from polhode.claims.source import read_text as read_text

_LATE = {
    "ClaimLimits": "processes._parallel_audit",
    "audit_apart": "processes._parallel_audit",
    "audit": "_audit",
    "read_document": "document._read_document",
    "Consequence": "document._report",
    "Judged": "document._report",
    "Report": "document._report",
    "tally": "document._report",
    "DocumentRead": "source",
    "Macro": "source",
    "ShownFormula": "source",
    "SourceRelation": "source",
    "SourceWords": "source",
    "read_documents": "source",
    "read_file": "source",
    "read_pieces": "source",
    "read_source": "source",
    "read_text": "source",
}


def __getattr__(name: str) -> Any:
    if name not in _LATE:
        raise AttributeError(f"module 'polhode.claims' has no attribute {name!r}")
    found = getattr(import_module(f"polhode.claims.{_LATE[name]}"), name)
    globals()[name] = found
    return found
