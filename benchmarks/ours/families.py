"""Systems of n bodies, as a user would declare them, with numbers and a start to run them from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import polhode as ph

Values = Mapping[str, float]


@dataclass(frozen=True)
class Member:
    """One system of a family."""

    system: ph.System
    parameters: Values
    start: Values


def pendulums(n: int) -> Member:
    """Rods in a vertical plane, each hung from the end of the one before."""
    m, length, g = ph.symbols("m l g", positive=True)
    moment = m * length**2 / 12
    lab, parts, before = ph.Frame("lab"), list[object](), None
    for k in range(1, n + 1):
        axes = lab.rotated(ph.coordinate(f"theta_{k}"), "y")
        rod = ph.Body(f"rod {k}", mass=m, inertia=(moment, moment, 0), axes=axes, tag=str(k))
        top = axes["z"] * (length / 2)
        name = f"pivot {k}"
        if before is None:
            parts.append(ph.Pivot(rod, at=top, name=name, force="P"))
        else:
            end = before.point(before.axes["z"] * (-length / 2))
            parts.append(ph.Pivot(rod, at=top, to=end, name=name, force="P"))
        before = rod
    start = {f"theta_{k}": 0.3 + 0.1 * k for k in range(1, n + 1)}
    system = ph.System(*parts, ph.Gravity(g), name=f"{n} pendulums")
    return Member(system, {"m": 1.0, "l": 0.5, "g": 9.81}, start)


#: Of every link: length, distance of the centre of mass from its joint, mass, moments of inertia.
LINK = {"l": 0.5, "c": 0.2, "m": 1.0, "A": 0.02, "B": 0.03, "C": 0.01}


def arm(n: int) -> Member:
    """Links on hinges whose axes are in turn along z and y of the link before."""
    g = ph.symbol("g", positive=True)
    lab = ph.Frame("lab")
    parts, axes, before, end = list[object](), lab, None, None
    for k in range(1, n + 1):
        length, c, m, *moments = ph.symbols(" ".join(f"{name}_{k}" for name in LINK), positive=True)
        axis = "z" if k % 2 else "y"
        axes = axes.rotated(ph.coordinate(f"q_{k}"), axis)
        link = ph.Body(f"link {k}", mass=m, inertia=tuple(moments), axes=axes, tag=str(k))
        held = {} if before is None else {"to": before}
        placed = {} if end is None else {"to": end}
        parts += [
            ph.Pivot(link, at=axes["z"] * -c, name=f"joint {k}", force="P", **placed),
            ph.Hinge(link, axis=axis, name=f"axle {k}", **held),
        ]
        before, end = link, link.point(axes["z"] * (length - c))
    numbers = {f"{name}_{k}": value for name, value in LINK.items() for k in range(1, n + 1)}
    start = {f"q_{k}": 0.1 * k for k in range(1, n + 1)}
    start |= {f"q_{k}_dot": 0.2 * k for k in range(1, n + 1)}
    # the last length places nothing
    parameters = {"g": 9.81} | {name: v for name, v in numbers.items() if name != f"l_{n}"}
    return Member(ph.System(*parts, ph.Gravity(g), name=f"{n}R arm"), parameters, start)


def trailers(n: int) -> Member:
    """Trailers on knife edges, each hitched behind the axle of the one before."""
    m, inertia, b, c, g = ph.symbols("m J b c g", positive=True)
    lab, parts, before = ph.Frame("lab"), list[object](), None
    for k in range(n):
        axes = lab.rotated(ph.coordinate(f"phi_{k}"), "z")
        body = ph.Body(f"trailer {k}", mass=m, inertia=(inertia,) * 3, axes=axes, tag=str(k))
        parts += [
            ph.Pivot(body, only="z", name=f"floor {k}"),
            ph.Hinge(body, axis="z", name=f"level {k}"),
            ph.Hold(body, at=axes.zero, along=axes, only="y", name=f"wheels {k}", force="W"),
        ]
        if before is not None:
            end = before.point(before.axes["x"] * -c)
            hitch = {"name": f"hitch {k}", "force": "H", "only": "x y"}
            parts.append(ph.Pivot(body, at=axes["x"] * b, to=end, **hitch))
        before = body
    start = {f"phi_{k}": 0.1 * k for k in range(n)} | {"phi_0_dot": 0.5, "v_x_0": 1.0}
    numbers = {"m": 1.0, "J": 0.2, "g": 9.81} | ({"b": 1.0, "c": 0.3} if n > 1 else {})
    system = ph.System(
        *parts,
        ph.Gravity(g),
        name=f"{n} trailers",
        # regular also where trailers are in line; those chosen by default need not be
        independent=(ph.coordinate("phi_0").dt(), ph.speed("v_x_0")),
    )
    return Member(system, numbers, start)


def rolling_chain(n: int) -> Member:
    """A wheel that rolls along a line, with a chain of n rods hung from its hub."""
    wheel_mass, spin, across, r = ph.symbols("M I_1 I_2 r", positive=True)
    m, length, g = ph.symbols("m l g", positive=True)
    moment = m * length**2 / 12
    lab = ph.Frame("lab")
    wheel = ph.Body(
        "wheel",
        mass=wheel_mass,
        inertia=(across, spin, across),
        axes=lab,
        spin=ph.About("y", "chi"),
        surface=ph.Rim(r, "y"),
        tag="W",
    )
    parts: list[object] = [ph.Rolling(wheel, on=ph.Plane(lab), name="ground")]
    end = wheel.point()
    for k in range(1, n + 1):
        axes = lab.rotated(ph.coordinate(f"theta_{k}"), "y")
        rod = ph.Body(f"rod {k}", mass=m, inertia=(moment, moment, 0), axes=axes, tag=str(k))
        top = axes["z"] * (length / 2)
        parts.append(ph.Pivot(rod, at=top, to=end, name=f"pivot {k}", force="P"))
        end = rod.point(axes["z"] * (-length / 2))
    start = {f"theta_{k}": 0.3 + 0.1 * k for k in range(1, n + 1)}
    numbers = {"M": 2.0, "I_1": 0.02, "I_2": 0.01, "r": 0.2, "m": 1.0, "l": 0.5, "g": 9.81}
    return Member(ph.System(*parts, ph.Gravity(g), name=f"wheel and {n} rods"), numbers, start)


FAMILIES: Mapping[str, Callable[[int], Member]] = {
    "pendulums": pendulums,
    "arm": arm,
    "trailers": trailers,
    "rolling-chain": rolling_chain,
}
