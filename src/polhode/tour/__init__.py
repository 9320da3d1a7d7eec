"""The tour: every system of the problem set worked through, and a page of it."""

from polhode.tour._checks import Check as Check
from polhode.tour._report import Row as Row
from polhode.tour._report import TourReport as TourReport
from polhode.tour._tour import write_tour as write_tour
