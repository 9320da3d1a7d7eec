"""Systems as documents: they come back as they were, and nothing else comes in."""

import json
import random
import re
from inspect import isabstract

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from derive import linkages
from model import transmissions
from polhode import model
from polhode.base import StoreError
from polhode.catalogue import CATALOGUE
from polhode.model import read_declaration, write_declaration

m, a, g, mu = ph.symbols("m a g mu", positive=True)
I_1, I_3 = ph.symbols("I_1 I_3", positive=True)
theta, phi, psi = ph.coordinates("theta phi psi")
LAB = ph.Frame("lab")
AXES = LAB.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")


def wheel(name: str = "wheel", **more) -> ph.Body:
    given = {"spin_about": "3", "rim": a, **more}
    return ph.Body(name, mass=m, inertia=(I_1, I_1, I_3), axes=AXES, **given)


def ball(name: str = "ball", **more) -> ph.Body:
    return ph.sphere(name, mass=m, radius=a, axes=LAB, **more)


def top(name: str = "top", **more) -> ph.Body:
    return ph.Body(name, mass=m, inertia=(I_1, I_1, I_3), axes=AXES, **more)


MOVING = ph.Sheet(LAB, motion=ph.functions("X Y"), angle=ph.functions("chi")[0])
FLOOR = ph.Plane(LAB)
TILTED = ph.Plane(LAB, tilt=ph.symbol("alpha"))
RIM = wheel().point(AXES["3"] * a)

SYSTEMS = {
    "smooth": ph.System(ph.Smooth(wheel(), on=FLOOR, restitution=ph.symbol("e"))),
    "tilted": ph.System(ph.Rolling(wheel(spin=ph.Relative("3", "Omega")), on=TILTED)),
    "stribeck": ph.System(
        ph.Coulomb(ball(), on=MOVING, mu=mu, mu_static=2 * mu, viscous=1, stribeck=a, force="R")
    ),
    "turntable": ph.System(ph.Rolling(ball(tag="2"), on=ph.Turntable(LAB, 2 * ph.time))),
    "tagged": ph.System(ph.Rolling(wheel(tag="left"), on=FLOOR), ph.Gravity(g, up=LAB["x"])),
    "pivot": ph.System(ph.Pivot(top(), at=AXES["3"] * -a, only="x z", along=LAB, force="P")),
    "moved pivot": ph.System(ph.Pivot(top(), to=LAB["x"] * ph.sin(3 * ph.time))),
    "weld": ph.System(ph.Weld(ph.Body("box", mass=1, inertia=(1, 1, 1), axes=LAB), at=LAB["x"])),
    "hold": ph.System(ph.Hold(top(), at=AXES["1"] * a, only="y", name="thumb")),
    "hinge": ph.System(ph.Pivot(top()), ph.Hinge(top(), axis="3", torque="T")),
    "guide": ph.System(ph.Pivot(top()), ph.Guide(top(), axis="3", normal=LAB["z"], label="2")),
    "motor": ph.System(
        ph.Pivot(wheel()), ph.Motor(wheel(), axis="3", rate=ph.symbol("w"), relative_to=LAB)
    ),
    "universal": ph.System(
        ph.Pivot(top()), ph.Universal(top(), arm=AXES["1"], other_arm=LAB["y"], name="cross")
    ),
    "loads": ph.System(
        ph.Force(RIM, LAB["x"] * ph.cos(ph.time), name="push"),
        ph.Torque(wheel(), AXES["3"] * -ph.symbol("c"), name="drag"),
        ph.Spring(RIM, LAB["z"] * a, stiffness=ph.symbol("k"), length=a),
        ph.Damper(RIM, ph.point_mass("p", mass=1, axes=LAB, tag="p").point(LAB.zero), damping=1),
    ),
    "components": ph.System(
        ph.Body(
            "brick",
            mass=m,
            inertia=(1, 2, 2.5),
            axes=AXES.rotated(psi, "3"),
            spin=ph.Components(("phi", "theta", "psi")),
            surface=ph.Ellipsoidal((a, 2 * a, 3 * a)),
        )
    ),
    "skew inertia": ph.System(
        ph.Body("blade", mass=1, inertia=((2, 1, 0), (1, 3, 0), (0, 0, 4)), axes=AXES)
    ),
    "face": ph.System(ph.Coulomb(top("block", surface=model.Face(a)), on=FLOOR, mu=mu)),
    "earth": ph.System(
        ph.Pivot(
            ph.Body(
                "compass",
                mass=m,
                inertia=(I_1, I_1, I_3),
                axes=ph.upright(ph.earth(ph.symbol("Omega"), colatitude=ph.pi / 4)),
                spin=ph.About("3", "gamma"),
            )
        ),
        name="on the Earth",
    ),
    "sharing": ph.System(
        ph.Coulomb(
            ph.box("box", mass=m, sides=(a, 2 * a, 3 * a), axes=LAB),
            on=FLOOR,
            at=LAB["z"] * a,
            mu=mu,
        ),
        sharing="equal stiffness",
    ),
    "impacts": ph.System(ph.Rolling(ball(), on=FLOOR, name="floor"), impacts="Moreau"),
    "resistance": ph.System(
        roll := ph.Rolling(ball(), on=FLOOR),
        ph.RollingResistance(roll, mu=mu, mu_static=2 * mu, viscous=1, force="Q"),
        ph.DrillingFriction(roll, mu=a, stribeck=1, name="spinning"),
    ),
    "cylinder": ph.System(
        ph.Rolling(ph.cylinder("can", mass=m, radius=a, height=3 * a, axes=AXES), on=FLOOR),
        independent=(theta.dt(),),
    ),
}
SYSTEMS |= {"atwood": transmissions.atwood(), "geared": transmissions.everything()}
SYSTEMS |= {name: entry.build() for name, entry in CATALOGUE.items()}
SYSTEMS |= {
    chain.__name__: chain().system
    for chain in (
        linkages.double_pendulum,
        linkages.four_bar,
        linkages.wheels_on_axle,
        linkages.gimballed_gyroscope,
        linkages.rolling_ellipsoid,
    )
}


@pytest.mark.parametrize("name", SYSTEMS)
def test_systems_come_back_as_they_were(name):
    text = write_declaration(SYSTEMS[name])
    again = read_declaration(text)
    assert again == SYSTEMS[name]
    assert hash(again) == hash(SYSTEMS[name])
    assert write_declaration(again) == text


@pytest.mark.parametrize("name", ["rolling-disk", "ball-on-paper", "double_pendulum", "universal"])
def test_what_comes_back_derives_the_same(name):
    first = ph.derive(SYSTEMS[name])
    second = ph.derive(read_declaration(write_declaration(SYSTEMS[name])))
    assert first.motion == second.motion
    assert first.components == second.components
    assert first.energy == second.energy


def test_every_public_part_of_a_system_can_be_written():
    made = {"Apart", "Contact", "Flight", "Load", "Sliding", "Spin", "Surface"}  # by derivation
    parts = model.Element | model.Load | model.Spin | model.Surface | model.Plane
    known = {
        name
        for name, kind in vars(model).items()
        if isinstance(kind, type) and issubclass(kind, parts) and not isabstract(kind)
    }
    written = {
        shape
        for system in SYSTEMS.values()
        for shape in re.findall(r'"is": "(\w+)"', write_declaration(system))
    }
    assert known - made <= written


beta = ph.coordinate("beta")
angles = st.sampled_from(
    [theta, phi - ph.pi / 3, 2 * beta, ph.functions("chi")[0] * ph.symbol("n")]
)
turns = st.lists(st.tuples(angles, st.sampled_from("123")), max_size=3)
lengths = st.sampled_from([a, a / 3, ph.sqrt(a * m), a + ph.symbol("d") ** 2])
contacts = st.sampled_from([ph.Rolling, ph.Smooth, lambda *w, **k: ph.Coulomb(*w, mu=mu, **k)])


@settings(max_examples=50)
@given(turns, lengths, contacts, st.sampled_from([FLOOR, TILTED, MOVING]), st.text(max_size=5))
def test_systems_of_any_make(steps, radius, contact, support, name):
    axes = LAB
    for angle, about in steps:
        axes = axes.rotated(angle, about)
    body = ph.disk("disk", mass=m, radius=radius, axes=axes)
    system = ph.System(contact(body, on=support), ph.Gravity(g), name=name)
    assert read_declaration(write_declaration(system)) == system


# -- what is no declaration ------------------------------------------------------------------------


def changed(name, change):
    document = json.loads(write_declaration(SYSTEMS[name]))
    change(document["parts"])
    return json.dumps(document)


def part(parts, shape):
    return next(part for part in parts if part["is"] == shape)


def setting(shape, **fields):
    return lambda parts: part(parts, shape).update(fields)


def some(parts, shape):
    return {"#": next(i for i, part in enumerate(parts) if part["is"] == shape)}


BAD = {
    "another contact": ("smooth", setting("Smooth", **{"is": "Sticky"})),
    "a class of Python": ("smooth", setting("Smooth", **{"is": "builtins.eval"})),
    "a name that is a number": ("smooth", setting("Smooth", name=3)),
    "a body that is a frame": (
        "smooth",
        lambda parts: part(parts, "Smooth").update(body=some(parts, "Frame")),
    ),
    "no support": ("smooth", setting("Smooth", on=None)),
    "private attributes": ("smooth", setting("Smooth", __class__="int")),
    "labels that are equal": ("smooth", setting("Frame", labels=["x", "x", "y"])),
    "two labels": ("smooth", setting("Frame", labels=["x", "y"])),
    "labels that are numbers": ("smooth", setting("Frame", labels=[1, 2, 3])),
    "a frame about nothing": ("smooth", setting("Frame", axis=[])),
    "a rim about no axis": ("smooth", setting("Rim", axis="9")),
    "a rim of a text": ("smooth", setting("Rim", radius="wide")),
    "a lopsided wheel": (
        "smooth",
        lambda parts: part(parts, "matrix")["rows"].reverse(),
    ),
    "a system without bodies": ("smooth", setting("System", bodies=[], elements=[])),
    "a body left out": ("smooth", setting("System", bodies=[])),
    "a body as a load": ("smooth", lambda p: part(p, "System").update(loads=[some(p, "Body")])),
    "a system that goes on": ("smooth", lambda parts: parts.append(parts[0])),
    "a pivot in no direction": ("pivot", setting("Pivot", only=["sideways", 3])),
    "a vector of two": ("pivot", lambda parts: part(parts, "vector")["components"].pop()),
    "a vector along a symbol": (
        "pivot",
        lambda parts: part(parts, "vector").update(frame=some(parts, "symbol")),
    ),
    "angles that are two": ("components", setting("Components", angles=["phi", "theta"])),
    "half-axes that are two": (
        "components",
        lambda parts: part(parts, "Ellipsoidal")["half_axes"].pop(),
    ),
    "a guide to a body": ("guide", lambda p: part(p, "Guide").update(to=some(p, "Body"))),
    "a matrix of two": ("pivot", lambda parts: part(parts, "matrix")["rows"].pop()),
}


@pytest.mark.parametrize("name", BAD)
def test_nonsense_is_refused(name):
    system, change = BAD[name]
    with pytest.raises(StoreError, match="a declaration that cannot be read"):
        read_declaration(changed(system, change))


def test_damaged_documents_are_refused_or_declare_something():
    rng = random.Random(5)
    refused = 0
    for name in ("rolling-disk", "ball-on-paper", "loads"):
        text = write_declaration(SYSTEMS[name])
        tokens = sorted(set(re.findall(r'"[^"]*"|-?\d+|[][{},:]|true|false|null', text)))
        for _ in range(150):
            pieces = re.split(r'("[^"]*"|-?\d+|[][{},:]|true|false|null)', text)
            pieces[rng.randrange(len(pieces) // 2) * 2 + 1] = rng.choice(tokens)
            try:
                write_declaration(read_declaration("".join(pieces)))
            except StoreError:
                refused += 1
    assert refused > 300


def test_a_document_cut_short_is_refused():
    text = write_declaration(SYSTEMS["rolling-disk"])
    for end in range(0, len(text) - 2, 37):
        with pytest.raises(StoreError):
            read_declaration(text[:end])
