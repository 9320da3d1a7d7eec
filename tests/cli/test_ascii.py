"""Formulas in ASCII mean what they mean in Unicode, and no sign of any command's output is lost."""

import random
import re
import unicodedata

import pytest
import sympy
from sympy.parsing.sympy_parser import (
    convert_xor,
    implicit_multiplication,
    parse_expr,
    standard_transformations,
)

import polhode as ph
from polhode.algebra.printing._text import pretty, text
from polhode.catalogue import PROBLEM_SET
from polhode.cli._ascii import in_ascii

# SymPy's reader, which knows nothing of polhode: blanks multiply, ^ is a power.
READER = (*standard_transformations, convert_xor, implicit_multiplication)
NAME = re.compile(r"[A-Za-z]\w*")
FUNCTIONS = {"sin", "cos", "exp", "sqrt", "abs"}


def read(formula):
    formula = re.sub(r"\blambda_?\b", "lam", formula)  # a keyword of Python's
    names = set(NAME.findall(formula)) - FUNCTIONS
    known = {name: sympy.Symbol(name, positive=True) for name in names}
    absolute = re.sub(r"\|([^|]*)\|", r"abs(\1)", formula)
    found = parse_expr(absolute, {**known, "abs": sympy.Abs}, READER)
    return found, known


def at_random_values(found, known):
    draw = random.Random(1)
    values = {known[name]: draw.uniform(0.5, 1.5) for name in sorted(known)}
    return complex(found.subs(values).evalf())


def formulas():
    for name, entry in PROBLEM_SET.items():
        if name.count("/"):
            continue
        equations = ph.derive(entry.build())
        yield from equations.motion
        yield from equations.dependent.values()
        yield equations.energy
    x, t = ph.coordinates("x theta")
    a, b, p = ph.symbols("a b_max Fprime_rho", positive=True)
    yield ph.sqrt(a + b) * ph.cos(t) ** 3 / ph.sqrt(p) + ph.exp(-a * x) * x.dt().dt()
    yield ph.sin(2 * t + x) ** 2 * x.dt().dt().dt() - t.dt() ** 2 / (a - b) ** 2


@pytest.mark.parametrize("formula", list(formulas()), ids=lambda formula: text(formula)[:40])
def test_it_reads_as_the_plain_form_does(formula):
    written = in_ascii(pretty(formula))
    assert written.isascii()
    ours, plain = read(written), read(text(formula))
    assert ours[1].keys() == plain[1].keys()
    assert at_random_values(*ours) == pytest.approx(at_random_values(*plain), rel=1e-12)


@pytest.mark.parametrize(
    ("unicode", "ascii"),
    [
        ("θ̈ sinθ − 2 θ̇ ω₃", "theta_ddot sin(theta) - 2 theta_dot omega_3"),
        ("sin²(α + cos²β) + cos² x", "sin(alpha + cos(beta)^2)^2 + cos(x)^2"),
        ("√(a (b + √c)) √2 √ω₃", "sqrt(a (b + sqrt(c))) sqrt(2) sqrt(omega_3)"),
        ("F′_ρ ȧb₁ ω̇_y x⁽⁴⁾ ẋ ẑ", "Fprime_rho ab_1_dot omega_y_dot x_d4 x_dot z_hat"),
        ("2θ μθ dθ/dt ωt", "2 theta mu theta dtheta/dt omega t"),
        ("10⁻³³ kg m² s⁻¹, 80°, 5′", "10^-33 kg m^2 s^-1, 80 deg, 5'"),
        ("a ≤ b ≠ c → d, ω × L · v", "a <= b != c -> d, omega x L . v"),
        ("naïve — “Müller”…", 'naive -- "Muller"...'),
        ("a ≢ b ∉ 中", r"a \u2262 b \u2209 \u4e2d"),  # never the opposite: ≡, ∈
        ("(⁽ √ ∂", "(( sqrt d"),
        ("2½ ½", "2 1/2 1/2"),
        ("a\udcff", "a?"),
    ],
)
def test_signs(unicode, ascii):
    assert in_ascii(unicode) == ascii


@pytest.mark.parametrize("encoding", ["cp437", "cp1253", "shift_jis", "gbk", "euc_kr", "koi8-r"])
def test_what_an_encoding_has_is_kept(encoding):
    shown = "θ̇² é".encode(encoding, "polhode.ascii").decode(encoding)
    assert shown[:2] in ("θ_", "th")
    assert "dot" in shown
    assert shown[-1] in "eé"


COMMANDS = [
    "list rolling-disk",
    "derive gyroscope",
    "steady rolling-disk",
    "invariants gyroscope",
    "lagrangian spinning-coin",
    "linearise rolling-disk --at theta=pi/2",
    "vectors rolling-disk",
    "fictitious marble-on-turntable",
    "run rolling-disk --duration 0.1s --events",
    "check gyroscope T=V",
    "check rolling-disk \\dot\\omega_3=\\dot\\theta\\dot\\phi\\sin\\theta",
    "exact tennis-racquet",
    "solve spinning-coin",
    "exercise spinning-coin --kind motion",
    "review docs/examples/review/disk.tex",
    "audit --only 1",
]


@pytest.mark.parametrize("line", COMMANDS)
def test_no_sign_of_a_command_is_lost(line, polhode, monkeypatch, tmp_path, request):
    monkeypatch.chdir(request.config.rootpath)
    code, out, _ = polhode(*line.split(), *(["--out", str(tmp_path)] if line[:4] == "run " else []))
    assert code in (0, 1), line
    written = in_ascii(out)
    assert written.count("?") == out.count("?")
    assert "\\u" not in written.replace("\\u", "", out.count("\\u"))
    assert written.count("-") >= out.count("−") + out.count("-")
    assert not [c for c in written if unicodedata.category(c) == "Cc" and c != "\n"]
