"""What follows from the equations exactly: integrals, steady motions, stability."""

from polhode.analyse._ansatz import Ansatz as Ansatz
from polhode.analyse._conditions import Condition as Condition
from polhode.analyse._conditions import Truth as Truth
from polhode.analyse._invariants import Invariant as Invariant
from polhode.analyse._invariants import Invariants as Invariants
from polhode.analyse._invariants import invariants as invariants
from polhode.analyse._reduced import Reduced as Reduced
from polhode.analyse._reduced import reduced as reduced
from polhode.analyse._stability import PROVES as PROVES
from polhode.analyse._stability import Stability as Stability
from polhode.analyse._stability import stability as stability
from polhode.analyse._steady import Branch as Branch
from polhode.analyse._steady import SteadyMotion as SteadyMotion
from polhode.analyse._steady import steady as steady
