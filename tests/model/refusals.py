"""Declarations that are refused, and what the message has to say."""

from collections.abc import Callable

import pytest

import polhode as ph

m, a, g, mu = ph.symbols("m a g mu", positive=True)
theta, phi = ph.coordinates("theta phi")
LAB = ph.Frame("lab")
FLOOR = ph.Plane(LAB)
AXES = LAB.rotated(phi, "z").rotated(theta, "x", labels="1 2 3", name="axes")


def body(**changed: object) -> ph.Body:
    given = {"mass": 2, "inertia": (3, 4, 5), "axes": AXES, **changed}
    return ph.Body("brick", **given)


def wheel(name: str = "wheel", **more: object) -> ph.Body:
    return ph.disk(name, **{"mass": m, "radius": a, "axes": AXES, **more})


def tilting(name: str, coordinate: str, **more: object) -> ph.Body:
    """A spinning body with axes of its own."""
    axes = LAB.rotated(ph.coordinates(coordinate)[0], "x", labels="1 2 3")
    return ph.Body(name, mass=m, inertia=(m, m, m), axes=axes, spin_about="3", **more)


def system(*parts: object, **more: object) -> Callable[[], object]:
    return lambda: ph.derive(ph.System(*parts, **more))


Refusal = tuple[Callable[[], object], type[ph.PolhodeError], tuple[str, ...]]
DECLARATION, CONSTRAINT, NUMERIC = ph.DeclarationError, ph.ConstraintError, ph.NumericError
UNIT = ph.UnitError


def is_refused(refusal: Refusal) -> None:
    """Refused with an error of its kind, in these words and with what was expected."""
    declare, kind, words = refusal
    with pytest.raises(kind) as refused:
        declare()
    for word in words:
        assert word in str(refused.value)
    assert refused.value.expected
