"""From a declaration to exact equations of motion and every reaction."""

from polhode.derive._derive import derive as derive
from polhode.derive._equations import Equations as Equations
from polhode.derive._equations import Reaction as Reaction
