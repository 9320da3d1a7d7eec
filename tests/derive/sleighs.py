"""Chaplygin's sleigh."""

import polhode as ph


def sleigh(**options):
    """A blade at a distance a behind the centre of mass."""
    m, J, a = ph.symbols("m J a", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("phi"), "z")
    body = ph.Body("sleigh", mass=m, inertia=(J, J, J), axes=axes)
    return ph.System(
        ph.Pivot(body, only="z", name="ice"),
        ph.Hinge(body, axis="z", name="flat"),
        ph.KnifeEdge(body, across="y", at=axes["x"] * -a),
        name="sleigh",
        **options,
    )
