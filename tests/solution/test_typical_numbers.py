"""Typical numbers and the figure of a motion, against values worked out by hand."""

import math
import re

import mpmath
import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET, CatalogueEntry, numbers_of
from polhode.solution import example_of
from polhode.solution._typical import number_latex, quantity_latex
from solution import own_systems


def worked(name):
    entry = PROBLEM_SET[name]
    equations = ph.derive(entry.build())
    defaults = {p.name: p.default for p in entry.parameters}
    numbers = numbers_of(entry, equations)
    return ph.solution(equations, example=example_of(equations, numbers, defaults, entry.plots))


@pytest.fixture(scope="module")
def marble():
    return worked("marble-on-turntable")


@pytest.fixture(scope="module")
def disk():
    return worked("rolling-disk")


def numbers(solution):
    steps = solution.sections["Typical numbers"]
    return [step.latex for step in steps if step.latex], " ".join(step.words for step in steps)


def test_the_marble_in_numbers(marble):
    """Problem set, (51) and (52): two sevenths; radius v/Λ; the force m v Λ of friction."""
    shown, words = numbers(marble)
    rate = 2 / 7 * 33 * 2 * math.pi / 60
    assert r"\Lambda = \frac{2 \Omega}{7}" in shown
    assert any(line.endswith(rf"= {rate:.3f}\,\mathrm{{rad/s}}") for line in shown)
    assert any(line.endswith(rf"= {0.05 / rate:.4f}\,\mathrm{{m}}") for line in shown)
    assert any(line.endswith(rf"= {2 * math.pi / rate:.2f}\,\mathrm{{s}}") for line in shown)
    assert quantity_latex(0.005 * math.hypot(9.81, 0.05 * rate), "N") in words
    assert f"at least ${number_latex(0.05 * rate / 9.81)}$" in words


def test_thresholds_and_rates_of_the_disk_in_numbers(disk):
    shown, words = numbers(disk)
    a, g, omega, theta = 0.03, 9.81, 40.0, math.radians(80)
    assert rf"\sqrt{{\frac{{g}}{{3 a}}}} = {math.sqrt(g / 3 / a):.1f}\,\mathrm{{rad/s}}" in shown
    root = math.sqrt(9 * omega**2 + 4 * g * math.cos(theta) ** 2 / (a * math.sin(theta)))
    for i, sign in ((1, 1), (2, -1)):
        rate = (3 * omega + sign * root) / math.cos(theta)
        assert rf"\dot{{\phi}}_{i} = {quantity_latex(rate, 'rad/s')}" in shown
    assert r"\theta" not in words.split("For instance")[1].split(".")[0]
    assert quantity_latex(0.2 * g, "N") in words


def test_every_number_was_judged(disk, marble):
    for solution in (disk, marble):
        steps = [s for s in solution.sections["Typical numbers"] if s.latex]
        assert steps
        assert all(step.verdict.holds for step in steps)


@pytest.mark.parametrize(
    ("value", "printed"),
    [
        (0, "0"),
        (12.345, "12.3"),
        (-297.546, "-297.5"),
        (0.0506, "0.0506"),
        (8e-3, r"8.00\times 10^{-3}"),
        (1.5e6, r"1.50\times 10^{6}"),
    ],
)
def test_numbers_are_rounded_to_three_digits(value, printed):
    assert number_latex(value) == printed


def test_a_motion_with_a_period_is_drawn_against_it():
    """Item 115: θ against t/T, with T the complete elliptic integral."""
    entry = CatalogueEntry.bare("pendulum", "Pendulum", own_systems.physical_pendulum())
    equations = ph.derive(entry.build())
    values = {"m": "1 kg", "l": "0.3 m", "g": "9.81", "I_1": "0.02"}
    example = example_of(equations, numbers_of(entry, equations, values, {"theta": "2"}, "9 s"))
    n = math.sqrt(9.81 * 0.3 / (0.02 + 0.09))
    period = float(4 * mpmath.ellipk(math.sin(1.0) ** 2) / n)
    assert example.period == pytest.approx(period)
    found = ph.solution(equations, "lagrange", example=example)
    words = " ".join(step.words for step in found.sections["A motion"])
    assert r"$\theta = 114.6^\circ$" in words
    assert f"$T = {quantity_latex(period, 's')}$" in words
    assert example.run.t[-1] == pytest.approx(3 * period)
    assert found.motion.count("<svg") == 1


def test_a_motion_without_a_known_period_is_drawn_against_the_time(disk):
    words = " ".join(step.words for step in disk.sections["A motion"])
    assert "against the time" in words
    assert disk.motion


def test_without_values_there_are_neither_numbers_nor_a_motion():
    found = ph.solution(own_systems.rolling_hoop())
    assert found.motion == ""
    assert not {"Typical numbers", "A motion"} & found.sections.keys()


def test_no_unit_is_left_without_a_number(disk, marble):
    for solution in (disk, marble):
        shown, words = numbers(solution)
        for text in (*shown, words):
            assert not re.search(r"= \\,\\mathrm", text)
