"""Motions side by side: in the lanes of vector instructions, and with their derivatives."""

from polhode.simulate.many._abreast import Abreast as Abreast
from polhode.simulate.many._abreast import Flights as Flights
from polhode.simulate.many._abreast import abreast as abreast
from polhode.simulate.many._sightings import LAST as LAST
from polhode.simulate.many._sightings import Sightings as Sightings
from polhode.simulate.many._subjects import Plan as Plan
from polhode.simulate.many._tangents import Dual as Dual
from polhode.simulate.many._tangents import Stretch as Stretch
from polhode.simulate.many._tangents import Tangents as Tangents
from polhode.simulate.many._tangents import duals as duals
