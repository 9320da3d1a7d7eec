"""Claims of texts, read, bound to a model, and judged."""

from polhode.claims._audit import Judged as Judged
from polhode.claims._audit import Report as Report
from polhode.claims._audit import audit as audit
from polhode.claims._bindings import Bound as Bound
from polhode.claims._bindings import BoundRelation as BoundRelation
from polhode.claims._check import check as check
from polhode.claims._document import Claim as Claim
from polhode.claims._document import Definition as Definition
from polhode.claims._document import Document as Document
from polhode.claims._document import Part as Part
from polhode.claims._meaning import BindingError as BindingError
from polhode.claims._notation import Notation as Notation
from polhode.claims._read_document import read_document as read_document
from polhode.claims._verdict import Answer as Answer
from polhode.claims._verdict import Confirmation as Confirmation
from polhode.claims._verdict import Correction as Correction
from polhode.claims._verdict import Counterexample as Counterexample
from polhode.claims._verdict import Residual as Residual
from polhode.claims._verdict import Verdict as Verdict
from polhode.claims.latex import Statement as Statement
from polhode.claims.latex import read_latex as read_latex
from polhode.claims.latex import write_latex as write_latex
