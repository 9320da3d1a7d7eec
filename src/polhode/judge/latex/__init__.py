"""LaTeX read into trees of what is printed, and trees written as LaTeX."""

from polhode.judge.latex._keyboard import as_latex as as_latex
from polhode.judge.latex._keyboard import keyboard_latex as keyboard_latex
from polhode.judge.latex._lexicon import GREEK as GREEK
from polhode.judge.latex._parser import read_latex as read_latex
from polhode.judge.latex._parser import slash_readings as slash_readings
from polhode.judge.latex._slashes import UnclearSlashError as UnclearSlashError
from polhode.judge.latex._tokens import bare_names as bare_names
from polhode.judge.latex._tree import ComponentList as ComponentList
from polhode.judge.latex._tree import Derivative as Derivative
from polhode.judge.latex._tree import Dots as Dots
from polhode.judge.latex._tree import Name as Name
from polhode.judge.latex._tree import Node as Node
from polhode.judge.latex._tree import Piece as Piece
from polhode.judge.latex._tree import Relation as Relation
from polhode.judge.latex._tree import Span as Span
from polhode.judge.latex._tree import Statement as Statement
from polhode.judge.latex._tree import walk as walk
from polhode.judge.latex._writer import write_latex as write_latex
