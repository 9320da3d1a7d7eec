"""The smallest correction of a claim that fails."""

from polhode.claims.repair._edits import Repaired as Repaired
from polhode.claims.repair._places import tidied as tidied
from polhode.claims.repair._repair import repaired as repaired
