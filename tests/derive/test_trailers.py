"""Trailers in a row against Newton's and Euler's equations by hand; no symbol is unknown."""

from functools import cache

import numpy as np
import pytest

import polhode as ph
from derive.states import Numeric, Values, agree
from derive.trailers import by_hand, train
from polhode.derive import Equations

seeds = pytest.mark.parametrize("seed", range(3))
LENGTHS = {"b": "m", "c": "m"}


@cache
def equations(size: int, hitch: bool = True, redundant: bool = False) -> Equations:
    return ph.derive(train(size, hitch=hitch, redundant=redundant))


@cache
def numeric(size: int, hitch: bool = True) -> Numeric:
    """The same compiled, once for all states."""
    return Numeric(equations(size, hitch))


def state(found: Equations, seed: int) -> dict[str, float]:
    random = np.random.default_rng(seed)
    given = {name: random.uniform(0.5, 2) for name in ("m", "J", "b", "c", "g")}
    given |= {q.published: random.uniform(0.2, 2.9) for q in found.coordinates}
    return given | {u.published: random.normal() for u in found.speeds}


@seeds
@pytest.mark.parametrize(("size", "hitch"), [(1, True), (2, True), (3, True), (3, False)])
def test_motion_and_forces_are_those_found_by_hand(size: int, hitch: bool, seed: int) -> None:
    declared = equations(size, hitch)
    given = state(declared, seed)
    found = numeric(size, hitch).at(**given)
    agree_with_hand(declared, found, by_hand(size, found, hitch=hitch))


def agree_with_hand(declared: Equations, found: Values, expected: Values) -> None:
    independent = [s.published for s in declared.acceleration_symbols if "phi" in s.published]
    agree(found, expected, independent, 1e-9)
    agree(found, expected, [name for name in expected if name[0] in "WH"], 1e-9)


@pytest.mark.parametrize("size", [1, 2, 3])
def test_every_symbol_is_declared_and_has_its_dimension(size: int) -> None:
    declared = equations(size)
    known = {*declared.coordinates, *declared.speeds, *declared.acceleration_symbols}
    known |= {*declared.dependent, *declared.parameters}
    for value in (*declared.components.values(), *declared.motion):
        assert value.symbols() <= known
    dimensions = {s.published: str(d) for s, d in declared.dimensions.items()}
    assert dimensions["m"] == "kg"
    assert dimensions["J"] == "kg m^2"
    assert {n: dimensions[n] for n in LENGTHS if n in dimensions} == dict(
        list(LENGTHS.items())[: 2 * (size > 1)]
    )


@pytest.mark.parametrize("size", [2, 3])
def test_what_trailers_bear_for_each_other_is_open_and_has_dimensions(size: int) -> None:
    """Hitches that hold up too: the least forces, and then the least couples, are consistent."""
    declared = equations(size, redundant=True)
    open_ = {f"{f}_{k}" for k in range(size) for f in ("F_z", "tau_y")}
    assert set(declared.undetermined) == open_ | {f"H_z_{k}" for k in range(1, size)}
    dimensions = {s.published: str(d) for s, d in declared.dimensions.items()}
    assert {name: dimensions[name] for name in ("b", "c", "g", "m")} == {
        "b": "m", "c": "m", "g": "m/s^2", "m": "kg",
    }  # fmt: skip
    # With no hitch bearing anything, every trailer rests on its own wheels.
    m, g = ph.symbols("m g", positive=True)
    assert all(declared.least[f"F_z_{k}"] == m * g for k in range(size))


def test_reactions_alone_may_be_in_parts_and_say_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """Letters are explained, and are no coordinates: every trailer has a z of its own."""
    written = equations(2)
    declared = ph.derive(train(2))
    monkeypatch.setattr("polhode.algebra._elimination.LONGEST", 20)
    assert declared.in_parts
    assert not declared.motion_in_parts
    monkeypatch.undo()
    assert not written.in_parts
    lines = str(declared).splitlines()
    assert lines[-1].startswith("where Z₁, ..., Z")
    assert lines[-1].endswith("are long expressions of coordinates and speeds, kept under names")
    assert "z₁ " not in "".join(line for line in lines if "= " in line and "ż" not in line)
    given = state(written, 1)
    agree(Numeric(declared).at(**given), numeric(2).at(**given), written.components, 1e-9)


def test_rows_that_outgrow_the_page_are_derived_in_parts() -> None:
    """In closed form the rows of four trailers have tens of thousands of terms."""
    declared = equations(4)
    assert declared.motion_in_parts
    assert declared.in_parts
    found = numeric(4).at(**state(declared, 0))
    agree_with_hand(declared, found, by_hand(4, found))
