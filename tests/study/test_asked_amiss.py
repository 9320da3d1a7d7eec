"""What cannot be fitted, differentiated or mapped is refused in words; one name needs no list."""

import resource
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

from polhode.base import DeclarationError, NumericError, StoreError
from polhode.derive import derive
from polhode.simulate import sampled
from polhode.study import ensemble, fit, refine_map, sensitivities, sweep
from study.examples import NUMBERS, disk, rough_balls

START = {"theta": 1.2, "phi_dot": 1.0, "omega_3": 20.0}
TIMES = np.linspace(0.0, 0.1, 5)


@pytest.mark.parametrize(
    ("asked", "error", "words"),
    [
        ({"vary": []}, DeclarationError, "nothing to vary"),
        ({"measured": {"theta": TIMES * np.nan}}, NumericError, "0 measurements for 1 values"),
        ({"forcing": {"X": np.sin}}, DeclarationError, "prescribed function"),
    ],
)
def test_fits(asked, error, words):
    given = {"measured": {"theta": TIMES}, "vary": "a"} | asked
    with pytest.raises(error, match=words):
        fit(disk(), NUMBERS, START, TIMES, **given)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"of": []}, "nothing to differentiate"),
        ({"by": []}, "nothing to differentiate by"),
        ({"forcing": {"X": sampled([0.0, 0.1], [0.0, 1.0])}}, "prescribed function"),
    ],
)
def test_sensitivities(asked, words):
    with pytest.raises(DeclarationError, match=words):
        sensitivities(disk(), NUMBERS, START, 0.1, **({"of": "theta", "by": "a"} | asked))


@pytest.mark.parametrize("span", [3.0, (1.0,), ("10 deg", "20 deg"), (0.0, np.inf)])
def test_maps(span):
    axes = {"theta": (1.0, 1.2), "omega_3": span}
    with pytest.raises(DeclarationError, match="the axis omega_3"):
        refine_map(disk(), axes, NUMBERS, {}, 0.1)


def test_a_name_is_no_system(tmp_path):
    with pytest.raises(DeclarationError, match="'rolling-disk' to be simulated"):
        ensemble("rolling-disk", NUMBERS, {"theta": [1.0]}, 0.1)  # type: ignore[arg-type]
    with pytest.raises(DeclarationError, match="'rolling-disk' to be simulated"):
        sweep("rolling-disk", {"theta": [1.0]}, NUMBERS, {}, 0.1, out=tmp_path / "s")  # type: ignore[arg-type]


def test_one_name_stands_for_itself():
    equations = derive(disk())
    found = ensemble(equations, NUMBERS, {"theta": [1.0], "omega_3": 20.0}, 0.01, outputs="theta")
    assert list(found.values) == ["theta"]
    slopes = sensitivities(equations, NUMBERS, START, 0.01, of="theta", by="a")
    assert list(slopes.derivatives["theta"]) == ["a"]
    case = rough_balls()
    ended = ensemble(
        case.modes, case.parameters | {"mu": 0.05}, {"v_x": [0.0] * 2}, 1.0, until="slips",
        outputs=["t"], forcing=case.options["forcing"],
    )  # fmt: skip
    assert np.all(ended["t"] < 1.0)


@contextmanager
def nearly_full() -> Iterator[None]:
    """No file may grow beyond some bytes."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (600, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def test_a_store_that_cannot_be_begun_is_not_in_the_way(tmp_path):
    out, asked = tmp_path / "s", ({"theta": [1.0, 1.1]}, NUMBERS, {"omega_3": 20.0}, 0.01)
    with nearly_full(), pytest.raises(StoreError, match="cannot be written"):
        sweep(derive(disk()), *asked, out=out, outputs="theta")
    assert not out.exists()
    done = sweep(derive(disk()), *asked, out=out, outputs="theta", resume=True)
    assert done.sizes["theta_start"] == 2
