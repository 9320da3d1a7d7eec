"""What packages above this one build on: trees of formulas, their meanings, claims and states."""

from polhode.claims._check import Judgement as Judgement
from polhode.claims._check import judgement as judgement
from polhode.claims.balance._declared import reaction_symbol as reaction_symbol
from polhode.claims.contexts._contexts import holds as holds
from polhode.claims.document._part_readings import Choice as Choice
from polhode.claims.document._part_readings import choices_by_part as choices_by_part
from polhode.claims.document._part_readings import part_readings as part_readings
from polhode.claims.document._part_readings import proposed as proposed
from polhode.claims.document._part_readings import under_part_reading as under_part_reading
from polhode.claims.latex._names import name_of as name_of
from polhode.claims.latex._names import spelled as spelled
from polhode.claims.latex._tree import Name as Name
from polhode.claims.latex._tree import Node as Node
from polhode.claims.latex._tree import Number as Number
from polhode.claims.latex._tree import Relation as Relation
from polhode.claims.latex._tree import walk as walk
from polhode.claims.meaning._bindings import restrictions as restrictions
from polhode.claims.meaning._meaning import Meaning as Meaning
from polhode.claims.meaning._mechanics import Mechanics as Mechanics
from polhode.claims.meaning._vocabulary import constant as constant
from polhode.claims.states._bound_claim import EQUALITY as EQUALITY
from polhode.claims.states._bound_claim import SENSE as SENSE
from polhode.claims.states._bound_claim import BoundClaim as BoundClaim
from polhode.claims.states._bound_claim import Small as Small
from polhode.claims.states._claim_domain import TrueMotion as TrueMotion
from polhode.claims.states._field_states import solved_residues as solved_residues
