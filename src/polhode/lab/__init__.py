"""The lab: a page, served on this machine alone, to play with a system's motion."""

from polhode.lab._offer import Own as Own
from polhode.lab._serve import PORT as PORT
from polhode.lab._serve import serve as serve
