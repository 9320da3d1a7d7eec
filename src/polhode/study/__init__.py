"""Many motions: ensembles, sweeps, maps, sensitivities and fits."""

from polhode.study._boundary import Refined as Refined
from polhode.study._boundary import refined_map as refined_map
from polhode.study._ensemble import Ensemble as Ensemble
from polhode.study._ensemble import ensemble as ensemble
from polhode.study._fit import Fit as Fit
from polhode.study._fit import fit as fit
from polhode.study._found import Found as Found
from polhode.study._found import found_in as found_in
from polhode.study._happenings import Duration as Duration
from polhode.study._happenings import EndMode as EndMode
from polhode.study._happenings import EventCount as EventCount
from polhode.study._happenings import EventKinds as EventKinds
from polhode.study._happenings import EventTime as EventTime
from polhode.study._happenings import EventTimes as EventTimes
from polhode.study._happenings import Fate as Fate
from polhode.study._output import Output as Output
from polhode.study._outputs import Final as Final
from polhode.study._outputs import Largest as Largest
from polhode.study._outputs import Least as Least
from polhode.study._outputs import Series as Series
from polhode.study._reasons import Reason as Reason
from polhode.study._sensitivity import Sensitivities as Sensitivities
from polhode.study._sensitivity import sensitivities as sensitivities
from polhode.study._store import Store as Store
from polhode.study._store import open_store as open_store
from polhode.study._sweep import sweep as sweep
