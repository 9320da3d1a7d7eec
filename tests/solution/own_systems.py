"""Systems outside the catalogue, of which worked solutions are tested."""

import polhode as ph


def physical_pendulum() -> ph.System:
    """A bar that swings in a plane about one of its points."""
    m, l, g, first, third = ph.symbols("m l g I_1 I_3", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    bar = ph.Body("bar", mass=m, inertia=(first, first, third), axes=axes)
    return ph.System(bar, ph.Pivot(bar, at=axes["3"] * l), ph.Gravity(g), name="pendulum")


def spherical_pendulum() -> ph.System:
    """A particle at the end of a light rod."""
    m, l, g = ph.symbols("m l g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "y", labels="1 2 3", name="axes")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    return ph.System(ph.Pivot(bob, at=axes["3"] * -l), ph.Gravity(g), name="spherical-pendulum")


def renamed_top() -> ph.System:
    """A heavy top in letters that no other system uses, its axis along its second direction."""
    mass, length, strength, along, across = ph.symbols("W h G A B", positive=True)
    tilt, azimuth = ph.coordinates("beta gamma")
    axes = ph.Frame("lab").rotated(azimuth, "z").rotated(tilt, "y", labels="3 1 2", name="axes")
    top = ph.Body("spindle", mass=mass, inertia=(across, across, along), axes=axes, spin_about="2")
    pivot = ph.Pivot(top, at=axes["2"] * -length)
    return ph.System(pivot, ph.Gravity(strength), name="spindle")


def double_pendulum() -> ph.System:
    """Two particles on light rods in a plane."""
    m, l, g = ph.symbols("m l g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    lab = ph.Frame("lab")
    upper = ph.point_mass("upper", mass=m, axes=lab.rotated(alpha, "y", name="one"))
    lower = ph.point_mass("lower", mass=m, axes=lab.rotated(beta, "y", name="two"))
    return ph.System(
        ph.Pivot(upper, at=upper.axes["z"] * l, name="nail"),
        ph.Pivot(lower, at=lower.axes["z"] * l, to=upper.point(), name="joint", force="G"),
        ph.Gravity(g),
        name="double-pendulum",
    )


def ball_on_incline() -> ph.System:
    """A uniform ball that rolls down an inclined plane."""
    m, a, g, alpha = ph.symbols("m a g alpha", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    rolling = ph.Rolling(ball, on=ph.Plane(lab, tilt=alpha))
    return ph.System(rolling, ph.Gravity(g), name="incline")


def rolling_hoop() -> ph.System:
    """A hoop that rolls on a horizontal plane."""
    m, a, g = ph.symbols("m a g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3", name="axes")
    hoop = ph.hoop("hoop", mass=m, radius=a, axes=axes)
    return ph.System(ph.Rolling(hoop, on=ph.Plane(lab)), ph.Gravity(g), name="hoop")


def foucault_pendulum() -> ph.System:
    """A particle on a light rod on the turning Earth."""
    m, l, g = ph.symbols("m l g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    ground = ph.earth(ph.symbol("Omega"), colatitude=ph.symbol("lambda_"))
    axes = ground.rotated(alpha, "x").rotated(beta, "y", labels="1 2 3", name="swing")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    return ph.System(ph.Pivot(bob, at=axes["3"] * l), ph.Gravity(g), name="foucault")


def two_on_a_spring() -> ph.System:
    """Two particles joined by a spring."""
    m, M, k = ph.symbols("m M k", positive=True)
    lab = ph.Frame("lab")
    first = ph.point_mass("first", mass=m, axes=lab, tag="1")
    second = ph.point_mass("second", mass=M, axes=lab, tag="2")
    return ph.System(ph.Spring(first.point(), second.point(), stiffness=k), name="two")


def smooth_ball() -> ph.System:
    """A ball that slides freely on a horizontal plane, while it turns in any way."""
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    return ph.System(ph.Smooth(ball, on=ph.Plane(lab)), ph.Gravity(g), name="smooth-ball")


def bar_on_a_universal_joint() -> ph.System:
    """A bar that hangs from a joint which turns about the vertical and tilts."""
    m, l, g = ph.symbols("m l g", positive=True)
    moments = ph.symbols("A B C", positive=True)
    theta, phi = ph.coordinates("theta phi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "y", labels="1 2 3", name="axes")
    bar = ph.Body("bar", mass=m, inertia=moments, axes=axes)
    joint = ph.Universal(bar, arm=axes["2"], other_arm=lab["z"])
    return ph.System(ph.Pivot(bar, at=axes["3"] * l), joint, ph.Gravity(g), name="hanging-bar")


def asymmetric_top() -> ph.System:
    """A heavy top with three different moments of inertia."""
    m, l, g, *moments = ph.symbols("m l g I_1 I_2 I_3", positive=True)
    theta, phi, psi = ph.coordinates("theta phi psi")
    tilted = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x")
    axes = tilted.rotated(psi, "z", labels="1 2 3", name="axes")
    top = ph.Body("top", mass=m, inertia=tuple(moments), axes=axes)
    return ph.System(ph.Pivot(top, at=axes["3"] * -l), ph.Gravity(g), name="asymmetric-top")


def sliding_ladder() -> ph.System:
    """A uniform ladder that slides down a smooth wall onto a smooth floor."""
    m, l, g = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    ladder = ph.rod("ladder", mass=m, length=2 * l, axes=axes, axis="3")
    return ph.System(
        ph.Pivot(ladder, at=axes["3"] * -l, only="y z", name="floor", force="N"),
        ph.Pivot(ladder, at=axes["3"] * l, only="x", name="wall", force="W"),
        ph.Gravity(g),
        name="ladder",
    )


def chaplygin_sleigh() -> ph.System:
    """A body on ice with a blade behind its centre of mass."""
    m, a, I = ph.symbols("m a I", positive=True)
    phi, x, y = ph.coordinates("phi x y")
    axes = ph.Frame("lab").rotated(phi, "z", labels="1 2 3", name="axes")
    sleigh = ph.Body("sleigh", mass=m, inertia=(I, I, I), axes=axes)
    return ph.System(
        ph.Pivot(sleigh, only="z", name="ice"),
        ph.Hinge(sleigh, axis="3", name="level"),
        ph.KnifeEdge(sleigh, across="2", at=axes["1"] * -a, name="blade"),
        speeds={"v": x.dt() * ph.cos(phi) + y.dt() * ph.sin(phi), "omega": phi.dt()},
        name="sleigh",
    )


def gimballed_gyro() -> ph.System:
    """A rotor in two gimbals: the outer one turns about the vertical, the inner one within it."""
    A, B, C, I_1, I_3, J, m = ph.symbols("A B C I_1 I_3 J m", positive=True)
    phi, theta = ph.coordinates("phi theta")
    turned = ph.Frame("lab").rotated(phi, "z", labels="1 2 3", name="outer axes")
    tilted = turned.rotated(theta, "1", labels="1 2 3", name="inner axes")
    outer = ph.Body("outer gimbal", mass=m, inertia=(J, J, J), axes=turned, tag="o")
    inner = ph.Body("inner gimbal", mass=m, inertia=(A, B, C), axes=tilted, tag="i")
    rotor = ph.Body("rotor", mass=m, inertia=(I_1, I_1, I_3), axes=tilted, spin_about="3", tag="r")
    return ph.System(
        *(ph.Pivot(b, name=f"centre of the {b.name}") for b in (outer, inner, rotor)),
        ph.Hinge(outer, axis="3", name="outer axle"),
        ph.Hinge(inner, axis="1", to=outer, name="inner axle"),
        ph.Hinge(rotor, axis="3", to=inner, name="rotor axle"),
        name="gimbals",
    )


def two_wheels() -> ph.System:
    """Two wheels that roll on a plane, each free to turn about a common axle that stays level."""
    m, M, a, b, g = ph.symbols("m M a b g", positive=True)
    phi, x, y = ph.coordinates("phi x_A y_A")
    heading = ph.Frame("lab").rotated(phi, "z", labels="1 2 3", name="heading")
    axle = ph.rod("axle", mass=M, length=2 * b, axes=heading, axis="2", tag="A")
    left = ph.disk("left wheel", mass=m, radius=a, axes=heading, axis="2", tag="L")
    right = ph.disk("right wheel", mass=m, radius=a, axes=heading, axis="2", tag="R")
    forward, turn = x.dt() * ph.cos(phi) + y.dt() * ph.sin(phi), b * phi.dt()
    both = (left, right, axle)
    slip_l = forward - turn - a * ph.speed("omega_2_L")
    slip_r = forward + turn - a * ph.speed("omega_2_R")
    return ph.System(
        ph.Pivot(axle, only="z", name="floor", force="N"),
        ph.Hinge(axle, axis="3", name="level"),
        ph.KnifeEdge(axle, across="2", name="edge", force="S"),
        ph.Pivot(left, to=axle.point(heading["2"] * b), name="left bearing", force="P"),
        ph.Hinge(left, axis="2", to=axle, name="left axle"),
        ph.Pivot(right, to=axle.point(heading["2"] * -b), name="right bearing", force="Q"),
        ph.Hinge(right, axis="2", to=axle, name="right axle"),
        ph.Constraint(slip_l, on=both, name="left rolling", force="T_L"),
        ph.Constraint(slip_r, on=both, name="right rolling", force="T_R"),
        ph.Gravity(g),
        name="two-wheels",
    )


def machine_of_atwood() -> ph.System:
    """Two weights in vertical guides, on a rope over a pulley that turns with it."""
    first, second, moment, radius, g = ph.symbols("m_1 m_2 I R g", positive=True)
    lab = ph.Frame("lab")
    x, z = lab["x"], lab["z"]
    axes = lab.rotated(ph.coordinate("alpha"), "y")
    wheel = ph.Body("pulley", mass=ph.symbol("m"), inertia=(moment,) * 3, axes=axes, tag="p")
    left = ph.point_mass("left weight", mass=first, axes=lab, tag="1")
    right = ph.point_mass("right weight", mass=second, axes=lab, tag="2")
    return ph.System(
        ph.Pivot(wheel, name="axle"),
        ph.Hinge(wheel, axis="y"),
        ph.Rope([left.point(), wheel.point(x * -radius)], directions=[z], name="left rope"),
        ph.Rope([right.point(), wheel.point(x * radius)], directions=[z], name="right rope"),
        ph.Pivot(left, to=x * -radius, only="x y", name="left guide"),
        ph.Pivot(right, to=x * radius, only="x y", name="right guide"),
        ph.Gravity(g),
        name="Atwood's machine",
    )


def weights_on_a_long_rope() -> ph.System:
    """Two weights on a rope over two small pulleys, whose height and distance are letters."""
    first, second, half, height, g = ph.symbols("m_1 m_2 R l g", positive=True)
    lab = ph.Frame("lab")
    x, z = lab["x"], lab["z"]
    left = ph.point_mass("left weight", mass=first, axes=lab, tag="1")
    right = ph.point_mass("right weight", mass=second, axes=lab, tag="2")
    over = [x * -half + z * height, x * half + z * height]
    return ph.System(
        ph.Pivot(left, to=x * -half, only="x y", name="left guide"),
        ph.Pivot(right, to=x * half, only="x y", name="right guide"),
        ph.Rope([left.point(), *over, right.point()], name="rope"),
        ph.Gravity(g),
        name="weights on a rope",
    )


def weight_on_a_spring() -> ph.System:
    """A particle in a vertical plane, on a spring with a natural length."""
    m, l, k, g = ph.symbols("m l k g", positive=True)
    lab = ph.Frame("lab")
    weight = ph.point_mass("weight", mass=m, axes=lab)
    pull = ph.Spring(weight.point(), lab.zero, stiffness=k, length=l)
    return ph.System(ph.Pivot(weight, only="y", name="plane"), pull, ph.Gravity(g), name="weight")


def bead_on_a_high_rail() -> ph.System:
    """A bead on a straight rail whose height enters no equation of motion."""
    m, a, k, g = ph.symbols("m a k g", positive=True)
    lab = ph.Frame("lab")
    bead = ph.point_mass("bead", mass=m, axes=lab)
    rail = ph.Pivot(bead, to=lab["z"] * a, only="y z", name="rail")
    pull = ph.Potential(k * ph.coordinate("x") ** 2 / 2, on=bead, name="pull")
    return ph.System(rail, pull, ph.Gravity(g), name="bead")
