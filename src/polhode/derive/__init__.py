"""From a declaration to exact equations of motion and every reaction."""

from polhode.derive._attitudes import AngleTriple as AngleTriple
from polhode.derive._attitudes import attitudes as attitudes
from polhode.derive._attitudes import singular_attitudes as singular_attitudes
from polhode.derive._attitudes import with_turned_angles as with_turned_angles
from polhode.derive._automaton import Automaton as Automaton
from polhode.derive._automaton import Guard as Guard
from polhode.derive._automaton import Mode as Mode
from polhode.derive._automaton import Touch as Touch
from polhode.derive._automaton import automaton as automaton
from polhode.derive._automaton import height_of as height_of
from polhode.derive._automaton import slips_along as slips_along
from polhode.derive._automaton import velocities_of_support as velocities_of_support
from polhode.derive._balance_table import BalanceTable as BalanceTable
from polhode.derive._derive import derive as derive
from polhode.derive._derive import derive_in_parts as derive_in_parts
from polhode.derive._equations import Equations as Equations
from polhode.derive._equations import Reaction as Reaction
from polhode.derive._equations import equations_only as equations_only
from polhode.derive._equations import is_angle as is_angle
from polhode.derive._equations import lettered as lettered
from polhode.derive._equations import symbols_of as symbols_of
from polhode.derive._idle_factors import without_idle_factors as without_idle_factors
from polhode.derive._speed_choice import inertia_of as inertia_of
from polhode.derive._speed_choice import may_be_singular as may_be_singular
from polhode.derive._speed_choice import may_become_singular as may_become_singular
from polhode.derive._speed_choice import on_independent as on_independent
