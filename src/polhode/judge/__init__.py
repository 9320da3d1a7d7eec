"""Published equations and whole derivations read, bound to a model and judged.

What judges documents and writes pages is imported on first use, so that a single check stays light.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from polhode.judge._check import CheckRequest as CheckRequest
from polhode.judge._notation import Notation as Notation
from polhode.judge._verdict import Answer as Answer
from polhode.judge._verdict import Confirmation as Confirmation
from polhode.judge._verdict import Correction as Correction
from polhode.judge._verdict import Counterexample as Counterexample
from polhode.judge._verdict import Read as Read
from polhode.judge._verdict import Residual as Residual
from polhode.judge._verdict import Verdict as Verdict
from polhode.judge.document._document import Claim as Claim
from polhode.judge.document._document import Definition as Definition
from polhode.judge.document._document import Document as Document
from polhode.judge.document._document import Note as Note
from polhode.judge.document._document import Part as Part
from polhode.judge.latex import Statement as Statement
from polhode.judge.latex import read_latex as read_latex
from polhode.judge.latex import write_latex as write_latex
from polhode.judge.meaning._bindings import Bound as Bound
from polhode.judge.meaning._meaning import BindingError as BindingError
from polhode.judge.meaning._relations import BoundRelation as BoundRelation
from polhode.judge.processes._limited_check import check as check
from polhode.judge.processes._limited_check import uncorrected as uncorrected

if TYPE_CHECKING:
    from polhode.judge._audit import report_on as report_on
    from polhode.judge._audit_document import audit as audit
    from polhode.judge._audit_document import document_of as document_of
    from polhode.judge._review import review as review
    from polhode.judge._review import review_files as review_files
    from polhode.judge._reviewed import Mark as Mark
    from polhode.judge._reviewed import Review as Review
    from polhode.judge._reviewed import ReviewedLine as ReviewedLine
    from polhode.judge.document._read_document import read_document as read_document
    from polhode.judge.document._report import Consequence as Consequence
    from polhode.judge.document._report import Judged as Judged
    from polhode.judge.document._report import Report as Report
    from polhode.judge.document._report import tally as tally
    from polhode.judge.output._audit_page import audit_html as audit_html
    from polhode.judge.output._audit_page import audit_page as audit_page
    from polhode.judge.output._evidence_html import readings_html as readings_html
    from polhode.judge.output._github import github_annotations as github_annotations
    from polhode.judge.output._hints import Hints as Hints
    from polhode.judge.output._hints import with_hints as with_hints
    from polhode.judge.output._judgement_on import judgement_on as judgement_on
    from polhode.judge.output._messages import SIGNS as SIGNS
    from polhode.judge.output._messages import TITLES as TITLES
    from polhode.judge.output._messages import message_parts as message_parts
    from polhode.judge.output._messages import sentence as sentence
    from polhode.judge.output._notebook import html_of as html_of
    from polhode.judge.output._page import review_html as review_html
    from polhode.judge.output._page import review_page as review_page
    from polhode.judge.output._page import typesettables as typesettables
    from polhode.judge.output._referee import referee_html as referee_html
    from polhode.judge.output._referee import referee_report as referee_report
    from polhode.judge.output._sarif import sarif as sarif
    from polhode.judge.output._sarif import write_sarif as write_sarif
    from polhode.judge.processes._parallel_audit import ClaimLimits as ClaimLimits
    from polhode.judge.processes._parallel_audit import audit_apart as audit_apart
    from polhode.judge.source import DocumentRead as DocumentRead
    from polhode.judge.source import Macro as Macro
    from polhode.judge.source import ShownFormula as ShownFormula
    from polhode.judge.source import SourceRelation as SourceRelation
    from polhode.judge.source import SourceWords as SourceWords
    from polhode.judge.source import read_documents as read_documents
    from polhode.judge.source import read_file as read_file
    from polhode.judge.source import read_pieces as read_pieces
    from polhode.judge.source import read_source as read_source
    from polhode.judge.source import read_text as read_text
    from polhode.judge.text._systems_of_text import named_system as named_system
    from polhode.judge.text._systems_of_text import proposed_systems as proposed_systems

_LATE = {
    "_audit": "report_on",
    "_audit_document": "audit document_of",
    "_review": "review review_files",
    "_reviewed": "Mark Review ReviewedLine",
    "document._read_document": "read_document",
    "document._report": "Consequence Judged Report tally",
    "output._audit_page": "audit_html audit_page",
    "output._evidence_html": "readings_html",
    "output._github": "github_annotations",
    "output._hints": "Hints with_hints",
    "output._judgement_on": "judgement_on",
    "output._messages": "SIGNS TITLES message_parts sentence",
    "output._notebook": "html_of",
    "output._page": "review_html review_page typesettables",
    "output._referee": "referee_html referee_report",
    "output._sarif": "sarif write_sarif",
    "processes._parallel_audit": "ClaimLimits audit_apart",
    "source": """
        DocumentRead Macro ShownFormula SourceRelation SourceWords read_documents read_file
        read_pieces read_source read_text
    """,
    "text._systems_of_text": "named_system proposed_systems",
}
_HOME = {name: module for module, names in _LATE.items() for name in names.split()}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'polhode.judge' has no attribute {name!r}")
    found = getattr(import_module(f"polhode.judge.{_HOME[name]}"), name)
    globals()[name] = found
    return found
