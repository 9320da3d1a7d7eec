"""Exported source code, run in its language, against polhode's own evaluation."""

import ctypes
import json
import math
import re
import shutil
import subprocess
import sys
from functools import cache

import numpy as np
import pytest

import polhode as ph
from derive import linkages
from model import transmissions
from polhode.base import DeclarationError
from polhode.catalogue import PROBLEM_SET
from polhode.simulate import LANGUAGES

SYSTEMS = {name: entry.build for name, entry in PROBLEM_SET.items()}
SYSTEMS["double pendulum"] = lambda: linkages.double_pendulum().system
SYSTEMS["atwood"] = transmissions.atwood


@cache
def _derived(name):
    return ph.derive(SYSTEMS[name]())


def _values(equations, seed=7):
    """Random values of states, parameters and prescribed functions."""
    random = np.random.default_rng(seed)
    states = len(equations.coordinates) + len(equations.speeds)
    sizes = (states, len(equations.parameters), 3 * len(equations.functions))
    return [random.uniform(0.3, 1.1, size) for size in sizes]


def _expected(equations, x, p, f):
    """Rates, reactions and energy by SymPy's numbers."""
    functions = [
        s.published
        for q in equations.functions
        for s in (q, q.derivative(), q.derivative().derivative())
    ]
    names = [s.published for s in (*equations.coordinates, *equations.speeds)]
    table = dict(zip(names, x, strict=True)) | dict(zip(functions, f, strict=True))
    table |= dict(zip((s.published for s in equations.parameters), p, strict=True))
    table["t"] = 0.2

    def number(expression):
        shown = ph.to_sympy(equations.on_shell(expression))
        return float(shown.subs(table).evalf(30))

    symbols = (*equations.coordinates, *equations.speeds)
    reactions = {**equations.components, **equations.least}
    rates = [number(equations.rate(ph.Expr.generator(s))) for s in symbols]
    return rates, [number(e) for e in reactions.values()], number(equations.energy)


def _python(source):
    """The functions of a module."""
    space = {}
    exec(compile(source, "exported", "exec"), space)
    return space


@pytest.mark.parametrize("name", SYSTEMS)
def test_numpy(name):
    equations = _derived(name)
    x, p, f = _values(equations)
    module = _python(ph.export(equations, "numpy"))
    rates, reactions, energy = _expected(equations, x, p, f)
    assert np.allclose(module["rates"](0.2, x, p, f), rates, rtol=1e-9, atol=1e-9)
    assert np.allclose(module["reactions"](0.2, x, p, f), reactions, rtol=1e-9, atol=1e-9)
    assert np.isclose(module["energy"](0.2, x, p, f), energy, rtol=1e-9)


def test_numpy_takes_arrays_of_states():
    equations = _derived("gyroscope")
    x, p, f = _values(equations)
    module = _python(ph.export(equations, "numpy"))
    many = module["rates"](0.0, np.stack([x, 2 * x, x], axis=1), p, f)
    assert many.shape == (len(x), 3)
    assert np.array_equal(many[:, 0], many[:, 2])


def test_entries_that_do_not_depend_on_the_state_have_the_shape_of_the_batch():
    """A block on a level rail: its reactions are constants, and those across the rail are zero."""
    m, g = ph.symbols("m g", positive=True)
    lab = ph.Frame("lab")
    rail = ph.Slider(ph.point_mass("block", mass=m, axes=lab), axis="x")
    equations = ph.derive(ph.System(rail, ph.Gravity(g)))
    module = _python(ph.export(equations, "numpy"))
    numbers = {"m": 2.0, "g": 10.0}
    p = [numbers[s.published] for s in equations.parameters]
    states = np.ones((2, 3))
    found = module["reactions"](0.0, states, p)
    assert found.shape == (len(equations.components), 3)
    assert np.array_equal(found[list(equations.components).index("F_z")], [20, 20, 20])
    assert module["rates"](0.0, states, p).shape == (2, 3)
    assert module["energy"](0.0, states, p).shape == (3,)
    swept = [np.array([2.0, 4.0]) if value == 2 else value for value in p]
    assert module["reactions"](0.0, [0.0, 0.0], swept).shape == (len(equations.components), 2)
    free = ph.derive(ph.System(ph.point_mass("ball", mass=m, axes=lab)))
    nothing = _python(ph.export(free, "numpy"))["reactions"](0.0, np.ones((6, 5)), [1.0])
    assert nothing.shape == (0, 5)


@pytest.mark.parametrize("name", ["rolling-disk", "ball-on-paper", "atwood"])
def test_c(name, tmp_path):
    equations = _derived(name)
    source = tmp_path / "system.c"
    source.write_text(ph.export(equations, "c"))
    library = tmp_path / "system.so"
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O1", "-shared", "-fPIC"]
    subprocess.run([compiler, *flags, str(source), "-o", str(library), "-lm"], check=True)
    loaded = ctypes.CDLL(str(library))
    vectors = _values(equations)
    expected = dict(zip(("rates", "reactions"), _expected(equations, *vectors), strict=False))
    pointer = ctypes.POINTER(ctypes.c_double)
    given = [np.ascontiguousarray(v).ctypes.data_as(pointer) for v in vectors]
    for function, values in expected.items():
        out = np.zeros(len(values))
        getattr(loaded, function)(ctypes.c_double(0.2), *given, out.ctypes.data_as(pointer))
        assert np.allclose(out, values, rtol=1e-9, atol=1e-9)


#: Runs exported code; the threads of JAX would make it unsafe to fork the process of the tests.
RUN_JAX = """
import json, sys
import jax
jax.config.update("jax_enable_x64", True)
source, *vectors = json.load(sys.stdin)
space = {}
exec(compile(source, "exported", "exec"), space)
x, p, f = map(jax.numpy.array, vectors)
rates = jax.jit(space["rates"])(0.2, x, p, f)
slopes = jax.jacfwd(space["rates"], argnums=1)(0.2, x, p, f)
found = [rates, space["reactions"](0.2, x, p, f), slopes]
print(json.dumps([each.tolist() for each in found]))
"""


@pytest.mark.parametrize("name", ["rolling-disk", "gyrocompass"])
def test_jax_agrees_and_differentiates(name):
    equations = _derived(name)
    x, p, f = vectors = _values(equations)
    question = json.dumps([ph.export(equations, "jax"), *(v.tolist() for v in vectors)])
    command = [sys.executable, "-c", RUN_JAX]
    answer = subprocess.run(command, input=question, capture_output=True, text=True, check=True)
    found = json.loads(answer.stdout)
    rates, reactions, _ = _expected(equations, x, p, f)
    assert np.allclose(found[0], rates, rtol=1e-9, atol=1e-9)
    assert np.allclose(found[1], reactions, rtol=1e-9, atol=1e-9)
    slopes = np.array(found[2])
    step, numpy = 1e-6, _python(ph.export(equations, "numpy"))["rates"]
    for i in range(len(x)):
        d = step * np.eye(len(x))[i]
        difference = (numpy(0.2, x + d, p, f) - numpy(0.2, x - d, p, f)) / (2 * step)
        assert np.allclose(slopes[:, i], difference, rtol=1e-5, atol=1e-6)


class _FromOne(list):
    """A list whose first index is 1, as in Julia."""

    def __getitem__(self, i):
        assert i >= 1
        return super().__getitem__(i - 1)

    def __setitem__(self, i, value):
        assert i >= 1
        super().__setitem__(i - 1, value)


@pytest.mark.parametrize("name", ["rolling-disk", "ball-on-paper", "double pendulum"])
def test_julia_line_by_line(name):
    """Julia is on no package index that tests may use; its straight lines are also Python's."""
    equations = _derived(name)
    vectors = x, p, f = _values(equations)
    source = ph.export(equations, "julia")
    pattern = r"function (\w+)!\(out, x, p, t\)\n(.*?)    return out\nend"
    bodies = dict(re.findall(pattern, source, re.DOTALL))
    assert set(bodies) == {"rates", "reactions", "energy"}
    line = re.compile(r"    (v\d+|out\[\d+\]) = [-+*/(). \w\[\]]+")
    for function, values in zip(
        ("rates", "reactions"), _expected(equations, *vectors), strict=False
    ):
        lines = bodies[function].splitlines()
        assert all(line.fullmatch(text) for text in lines)
        out = _FromOne([0.0] * len(values))
        space = {n: getattr(math, n) for n in ("sin", "cos", "sqrt", "exp", "sinh", "cosh", "pi")}
        space |= {"x": _FromOne(x), "p": _FromOne([*p, *f]), "t": 0.2, "out": out}
        exec("\n".join(text.strip() for text in lines), space)
        assert np.allclose(list(out), values, rtol=1e-9, atol=1e-9)


def test_the_head_says_what_every_entry_is():
    equations = _derived("rolling-disk")
    for to, language in LANGUAGES.items():
        head = ph.export(equations, to).split("\n\n")[0]
        assert all(text.startswith(language.comment) for text in head.splitlines())
        for symbol in (*equations.coordinates, *equations.speeds, *equations.parameters):
            assert symbol.published in head


def test_what_cannot_be_exported():
    with pytest.raises(DeclarationError, match="fortran"):
        ph.export(_derived("rolling-disk"), "fortran")
    ball = ph.point_mass("ball", mass=1, axes=ph.Frame("lab"))
    z = ph.coordinate("z")
    drag = ph.Force(ball.point(), ph.Frame("lab")["z"] * ph.absolute(z))
    with pytest.raises(DeclarationError, match="kinks"):
        ph.export(ph.derive(ph.System(ball, drag)), "c")
