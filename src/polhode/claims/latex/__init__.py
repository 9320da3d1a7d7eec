"""LaTeX read into trees of what is printed, and trees written as LaTeX."""

from polhode.claims.latex._keyboard import as_latex as as_latex
from polhode.claims.latex._keyboard import keyboard_latex as keyboard_latex
from polhode.claims.latex._parser import read_latex as read_latex
from polhode.claims.latex._parser import slash_readings as slash_readings
from polhode.claims.latex._slashes import UnclearSlashError as UnclearSlashError
from polhode.claims.latex._tokens import bare_names as bare_names
from polhode.claims.latex._tree import Node as Node
from polhode.claims.latex._tree import Piece as Piece
from polhode.claims.latex._tree import Relation as Relation
from polhode.claims.latex._tree import Statement as Statement
from polhode.claims.latex._writer import write_latex as write_latex
