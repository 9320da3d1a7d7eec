"""What judges, tells and mends whole documents; `claims` fetches it when first asked for."""

from polhode.claims._apart import Limits as Limits
from polhode.claims._apart import audit_apart as audit_apart
from polhode.claims._audit import audit as audit
from polhode.claims._read_document import read_document as read_document
from polhode.claims._report import Consequence as Consequence
from polhode.claims._report import Judged as Judged
from polhode.claims._report import Report as Report
from polhode.claims._report import told as told
from polhode.claims.repair import tidied as tidied
