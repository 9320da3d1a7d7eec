"""Worked solutions: from a declaration to a text in which every displayed formula was judged."""

from polhode.solution._figure import figure_of as figure_of
from polhode.solution._files import SOLUTION_FILES as SOLUTION_FILES
from polhode.solution._files import write_solution as write_solution
from polhode.solution._lines import Line as Line
from polhode.solution._lines import breaks as breaks
from polhode.solution._lines import inline as inline
from polhode.solution._lines import letter_of as letter_of
from polhode.solution._lines import listed as listed
from polhode.solution._lines import unit as unit
from polhode.solution._lines import vector_latex as vector_latex
from polhode.solution._markdown import markdown_of_solution as markdown_of_solution
from polhode.solution._setting import PATIENCE as PATIENCE
from polhode.solution._setting import Setting as Setting
from polhode.solution._solution import ROUTES as ROUTES
from polhode.solution._solution import Solution as Solution
from polhode.solution._solution import Step as Step
from polhode.solution._solution import solution as solution
from polhode.solution._statement import assumptions as assumptions
from polhode.solution._statement import choice_of_axes as choice_of_axes
from polhode.solution._words import rendered as rendered
