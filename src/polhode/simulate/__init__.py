"""Numbers: start values, integration to rounding, and trajectories to read everything from."""

from polhode.simulate._drift import Drift as Drift
from polhode.simulate._dynamics import Dynamics as Dynamics
from polhode.simulate._dynamics import EquationsOfMotion as EquationsOfMotion
from polhode.simulate._simulate import simulate as simulate
from polhode.simulate._trajectory import Event as Event
from polhode.simulate._trajectory import Trajectory as Trajectory
