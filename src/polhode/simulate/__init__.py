"""Simulation: start values, integration to rounding, and trajectories to read from."""

from polhode.simulate._absolute_values import smooth_at as smooth_at
from polhode.simulate._drift import Drift as Drift
from polhode.simulate._dynamics import Dynamics as Dynamics
from polhode.simulate._dynamics import EquationsOfMotion as EquationsOfMotion
from polhode.simulate._dynamics import constants as constants
from polhode.simulate._dynamics import quantity_names as quantity_names
from polhode.simulate._event import Event as Event
from polhode.simulate._simulate import NEAR_FLAT as NEAR_FLAT
from polhode.simulate._simulate import Experiment as Experiment
from polhode.simulate._simulate import simulate as simulate
from polhode.simulate._start import read_start as read_start
from polhode.simulate._trajectory import Trajectory as Trajectory
from polhode.simulate._validity import refuse_doubt as refuse_doubt
from polhode.simulate._values import idle_parameters as idle_parameters
from polhode.simulate._values import read_parameters as read_parameters
from polhode.simulate._values import refuse_missing as refuse_missing
from polhode.simulate.contact._auxiliary_states import slip_symbols as slip_symbols
from polhode.simulate.files._saved import load as load
from polhode.simulate.forcing._approximation import Approximation as Approximation
from polhode.simulate.forcing._approximation import approximated as approximated
from polhode.simulate.forcing._pieces import Jump as Jump
from polhode.simulate.forcing._pieces import Pieces as Pieces
from polhode.simulate.forcing._samples import SheetPath as SheetPath
from polhode.simulate.forcing._samples import read_sheet as read_sheet
from polhode.simulate.forcing._samples import sampled as sampled
from polhode.simulate.integrate._number_types import numbers_for as numbers_for
