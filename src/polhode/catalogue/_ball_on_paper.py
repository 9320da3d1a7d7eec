"""Problem 6: a ball that rolls on a sheet of paper while the sheet is moved."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _ball() -> ph.System:
    m, r, k, g = ph.symbols("m r k g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=r, inertia=k * m * r**2, axes=lab)
    x, y, chi = ph.functions("X Y chi")
    sheet = ph.Sheet(lab, motion=(x, y), angle=chi)
    return ph.System(ph.Rolling(ball, on=sheet, name="sheet"), ph.Gravity(g), name="ball-on-paper")


BALL_ON_PAPER = CatalogueEntry(
    name="ball-on-paper",
    title="Ball and paper",
    about=(
        "A ball rolls on a sheet of paper while the sheet is moved about and turned in its plane. "
        "However it is moved, once sheet and ball are left alone the ball has the velocity it "
        "started with. Here it rolls throughout."
    ),
    whatever_touches=(
        "A ball on a sheet of paper, while the sheet is moved about and turned in its plane. "
        "However it is moved, once sheet and ball are left alone the ball has the velocity it "
        "started with."
    ),
    build=_ball,
    parameters=(
        Parameter("m", "kg", "50 g", "mass of the ball"),
        Parameter("r", "m", "20 mm", "radius of the ball"),
        Parameter("k", "", "2/5", "moment of inertia of the ball over m r^2"),
        GRAVITY,
    ),
    start={"v_x": "0.2 m/s"},
    duration="6 s",
    plots=(("x", "y"), ("v_x", "v_y"), ("F_x", "F_y", "F_z")),
    forcing={"X": "(1 - cos(2*t))/20", "Y": "sin(t)**3/10", "chi": "0"},
)
