"""Motion and reactions at thousands of random states and parameters, against the oracles.

The oracles know nothing of polhode: all bodies in the inertial frame, with multipliers.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial

import numpy as np
import pytest

from catalogue import test_newton_euler as single
from catalogue.systems import numeric
from derive import test_linkages as several
from oracles.draws import FOUR_BAR, draw
from polhode.catalogue import CATALOGUE
from polhode.derive import Equations
from proof.ledger import Ledger
from proof.states import Comparison, Watched

FIRST, EACH = 10_000, 500  # seeds that no other test uses
batches = pytest.mark.parametrize("batch", range(6))

MODELS: dict[str, Callable[[int], None]] = {
    "double pendulum": several.test_double_pendulum,
    "four-bar, one branch": partial(several.test_four_bar_linkage, branch=1.0),
    "four-bar, the other": partial(several.test_four_bar_linkage, branch=-1.0),
    "two wheels on an axle": several.test_two_wheels_on_an_axle,
    "gyroscope in gimbals": several.test_gyroscope_in_gimbals,
    "rolling ellipsoid": several.test_rolling_ellipsoid,
}


@cache
def catalogued(name: str) -> Watched:
    return Watched(numeric(name).equations)


@cache
def declared(declaration: Callable[[], Equations]) -> Watched:
    return Watched(declaration())


def can_be_closed(name: str, seed: int) -> bool:
    """Whether the links of a four-bar linkage reach one another; the other models always can."""
    if not name.startswith("four-bar"):
        return True
    bar = draw(FOUR_BAR, seed)
    chord = np.hypot(
        bar["d"] - bar["l_1"] * np.cos(bar["theta_1"]), bar["l_1"] * np.sin(bar["theta_1"])
    )
    return abs(bar["l_2"] - bar["l_3"]) < chord < bar["l_2"] + bar["l_3"]


def seeds(batch: int) -> range:
    return range(FIRST + batch * EACH, FIRST + (batch + 1) * EACH)


@batches
@pytest.mark.parametrize("name", CATALOGUE)
def test_catalogue(name: str, batch: int, ledger: Ledger, monkeypatch) -> None:
    comparison = Comparison(ledger)
    comparison.system = catalogued(name)
    monkeypatch.setattr(single, "agree", comparison.agree)
    ledger.part = name
    for seed in seeds(batch):
        comparison.place = f"seed {seed}"
        single.COMPARISONS[name](comparison.system, seed)
        ledger.cases += 1


@batches
@pytest.mark.parametrize("name", MODELS)
def test_several_bodies(name: str, batch: int, ledger: Ledger, monkeypatch) -> None:
    comparison = Comparison(ledger)

    def looked_at(declaration: Callable[[], Equations]) -> Watched:
        comparison.system = declared(declaration)
        return comparison.system

    monkeypatch.setattr(several, "numeric", looked_at)
    monkeypatch.setattr(several, "agree", comparison.agree)
    ledger.part = name
    chosen = [seed for seed in seeds(batch) if can_be_closed(name, seed)]
    ledger.aside = len(seeds(batch)) - len(chosen)
    for seed in chosen:
        comparison.place = f"seed {seed}"
        MODELS[name](seed)
        ledger.cases += 1
