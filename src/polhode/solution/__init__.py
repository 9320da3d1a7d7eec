"""Worked solutions: from a declaration to a text in which every displayed formula was judged."""

from polhode.solution._answers import AtInstant as AtInstant
from polhode.solution._answers import CoriolisTorque as CoriolisTorque
from polhode.solution._answers import ForceAlong as ForceAlong
from polhode.solution._answers import LeastForces as LeastForces
from polhode.solution._answers import RateOf as RateOf
from polhode.solution._answers import SlidingOnRest as SlidingOnRest
from polhode.solution._answers import SmallOscillation as SmallOscillation
from polhode.solution._answers import WhateverForce as WhateverForce
from polhode.solution._example import Example as Example
from polhode.solution._example import example_of as example_of
from polhode.solution._files import SOLUTION_FILES as SOLUTION_FILES
from polhode.solution._files import write_solution as write_solution
from polhode.solution._markdown import markdown_of_solution as markdown_of_solution
from polhode.solution._questions import ByRoute as ByRoute
from polhode.solution._questions import FromSection as FromSection
from polhode.solution._questions import TextQuestion as TextQuestion
from polhode.solution._remarks import Remark as Remark
from polhode.solution._remarks import remarks_on as remarks_on
from polhode.solution._solution import ROUTES as ROUTES
from polhode.solution._solution import Solution as Solution
from polhode.solution._solution import Step as Step
from polhode.solution._solution import solution as solution
