"""A block that rocks on its lower edges and comes to rest."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _rocking_block() -> ph.System:
    m, w, d, h, g = ph.symbols("m w d h g", positive=True)
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("theta"), "y")
    inertia = tuple(m * (one**2 + two**2) / 3 for one, two in ((d, h), (w, h), (w, d)))
    block = ph.Body("block", mass=m, inertia=inertia, axes=axes)
    left, right = axes["x"] * -w - axes["z"] * h, axes["x"] * w - axes["z"] * h
    return ph.System(
        ph.Rolling(block, on=ph.Plane(lab), at=left, name="left", force="L"),
        ph.Rolling(block, on=ph.Plane(lab), at=right, name="right", force="R"),
        ph.Hinge(block, axis="y"),
        ph.Gravity(g),
        name="rocking-block",
        impacts="Moreau",
    )


ROCKING_BLOCK = CatalogueEntry(
    name="rocking-block",
    title="Rocking block",
    about=(
        "A uniform block rocks from edge to edge without slipping. Each impact takes the same "
        "share of its angular velocity, so that it comes to rest after infinitely many, at a "
        "finite time. theta is its tilt."
    ),
    whatever_touches="A uniform block rocks from edge to edge.",
    build=_rocking_block,
    parameters=(
        Parameter("m", "kg", "2 kg", "mass of the block"),
        Parameter("w", "m", "0.1 m", "half of its width"),
        Parameter("d", "m", "0.15 m", "half of its depth"),
        Parameter("h", "m", "0.4 m", "half of its height"),
        GRAVITY,
    ),
    start={
        "theta": "0",
        "z": "0.4 m",
        "theta_dot": "1 rad/s",
        "v_x": "0.4 m/s",
        "v_z": "0.1 m/s",
    },
    duration="8 s",
    plots=(("theta",), ("theta_dot",)),
)
