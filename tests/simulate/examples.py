"""Equations of motion written out by hand, in the shape in which they are simulated."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import SimpleNamespace

from polhode.algebra import ZERO, Expr, Matrix, Symbol


@dataclass(frozen=True)
class ByHand:
    """Equations of one contact mode, each part as it was written down."""

    coordinates: tuple[Symbol, ...]
    speeds: tuple[Symbol, ...]
    kinematics: Mapping[Symbol, Expr]
    mass: Matrix
    forcing: tuple[Expr, ...]
    energy: Expr
    parameters: tuple[Symbol, ...] = ()
    functions: tuple[Symbol, ...] = ()
    power: Expr = ZERO
    dependent: Mapping[Symbol, Expr] = field(default_factory=dict)
    components: Mapping[str, Expr] = field(default_factory=dict)
    undetermined: tuple[str, ...] = ()
    closures: tuple[Expr, ...] = ()
    assumed_positive: tuple[Expr, ...] = ()
    dimensions: Mapping[Symbol, object] = field(default_factory=dict)
    system: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(name="by hand"))
