"""Worked solutions: from a declaration to a text in which every displayed formula was judged."""

from polhode.solution._solution import ROUTES as ROUTES
from polhode.solution._solution import Solution as Solution
from polhode.solution._solution import Step as Step
from polhode.solution._solution import solution as solution
