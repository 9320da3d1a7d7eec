"""Worked solutions: from a declaration to a text in which every displayed formula was judged."""

from polhode.solution._files import SOLUTION_FILES as SOLUTION_FILES
from polhode.solution._files import write_solution as write_solution
from polhode.solution._markdown import markdown_of_solution as markdown_of_solution
from polhode.solution._solution import ROUTES as ROUTES
from polhode.solution._solution import Solution as Solution
from polhode.solution._solution import Step as Step
from polhode.solution._solution import solution as solution
