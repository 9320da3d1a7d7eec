"""What follows from the equations exactly: integrals, steady motions, stability."""

from polhode.analyse._ansatz import Ansatz as Ansatz
from polhode.analyse._conditions import Condition as Condition
from polhode.analyse._conditions import Truth as Truth
from polhode.analyse._expansion import Expansion as Expansion
from polhode.analyse._expansion import expand as expand
from polhode.analyse._fictitious import Fictitious as Fictitious
from polhode.analyse._fictitious import fictitious_force as fictitious_force
from polhode.analyse._fictitious import fictitious_torque as fictitious_torque
from polhode.analyse._fictitious import relative_momentum as relative_momentum
from polhode.analyse._fictitious import relative_rate as relative_rate
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
