"""Saved motions that were altered, with a right checksum: an error of polhode's, or a motion.

`tests/proof/test_saved_files.py` does the same some thousand times, each in a process of its own.
"""

import json
import random
from contextlib import suppress

import numpy as np
import pytest

import polhode as ph
from polhode.base import PolhodeError, StoreError
from simulate.files.alterations import altered, opened, sealed

m, a, g, mu = ph.symbols("m a g mu", positive=True)
theta, phi = ph.coordinates("theta phi")
lab = ph.Frame("lab")


def rolled() -> ph.Trajectory:
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    disk = ph.disk("disk", mass=m, radius=a, axes=axes)
    system = ph.System(ph.Rolling(disk, on=ph.Plane(lab)), ph.Gravity(g))
    start = {"theta": 1.3, "phi_dot": 0.5, "omega_3": 15.0}
    watched = {"bare": ph.speeds("omega_3")[0] ** 2}
    return ph.simulate(system, {m: 1, a: 0.1, g: 9.81}, start, 1.0, invariants=watched, samples=11)


def pulled() -> ph.Trajectory:
    x = ph.functions("X")[0]
    ball = ph.sphere("ball", mass=m, radius=a, inertia=m * a**2 / 2, axes=lab)
    on = ph.Sheet(lab, motion=(x, 0))
    system = ph.System(ph.Coulomb(ball, on=on, mu=mu, name="sheet"), ph.Gravity(g))
    path = ph.sampled([0, 0.1, 0.2, 0.3], [0, 0.1, 0.1, 0.0])
    values = {m: 0.05, a: 0.02, g: 9.81, mu: 0.05}
    return ph.simulate(system, values, {"v_y": 0.2}, 0.5, forcing={"X": path}, samples=11)


def used(run: ph.Trajectory) -> None:
    """Everything that can be read from a motion."""
    with np.errstate(all="ignore"):
        repr(run)
        run.table(run.quantities)
        run.final  # noqa: B018
        run.drift  # noqa: B018
        for event in run.events:
            event.as_json()
            event.state_before  # noqa: B018
            event.state_after  # noqa: B018


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("motions")
    for number, run in enumerate((rolled(), pulled())):
        run.save(folder / f"{number}.h5")
    return [path.read_bytes() for path in sorted(folder.iterdir())]


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_altered_files_are_refused_or_are_motions(files, tmp_path):
    rng, path = random.Random(17), tmp_path / "motion.h5"
    counts = {"refused": 0, "read": 0}
    for _ in range(60):
        path.write_bytes(altered(rng, rng.choice(files))[1])
        try:
            run = ph.load(path, seconds=10)
        except StoreError:
            counts["refused"] += 1
            continue
        counts["read"] += 1
        with suppress(PolhodeError):
            used(run)
    assert min(counts.values()) > 5


def test_an_unaltered_file_is_the_same_motion(files, tmp_path):
    path = tmp_path / "motion.h5"
    path.write_bytes(sealed(*opened(files[0])))
    assert path.read_bytes() == files[0]
    used(ph.load(path))


def with_declaration(content, change):
    before, document, numbers = opened(content)
    declared = json.loads(document["declaration"])
    change(declared["parts"])
    return sealed(before, {**document, "declaration": json.dumps(declared)}, numbers)


def many_angles(parts):
    """The tilt as a sum of forty angles: its sine has a million million terms."""
    theta = next(i for i, part in enumerate(parts) if part.get("name") == "theta")
    tilt = next(i for i, part in enumerate(parts) if part.get("over") == [{"#": theta}])
    kind = {"is": "symbol", "kind": "coordinate", "order": 0, "positive": False}
    symbols = [{**kind, "name": f"q_{i}"} for i in range(40)]
    for part in parts:
        shift(part, tilt, len(symbols))
    parts[tilt:tilt] = symbols
    powers = [[int(i == j) for j in range(40)] for i in range(40)]
    parts[tilt + 40].update(
        over=[{"#": tilt + i} for i in range(40)],
        above=[[row, 1, 1] for row in powers],
        below=[[[0] * 40, 1, 1]],
    )


def shift(node, since, by):
    """References to parts from one on, to the same parts further on."""
    if isinstance(node, dict):
        if set(node) == {"#"}:
            node["#"] += by if node["#"] >= since else 0
        else:
            for value in node.values():
                shift(value, since, by)
    elif isinstance(node, list):
        for value in node:
            shift(value, since, by)


def test_a_declaration_that_takes_too_long_is_abandoned(files, tmp_path):
    path = tmp_path / "motion.h5"
    path.write_bytes(with_declaration(files[0], many_angles))
    with pytest.raises(StoreError, match=r"more than 1 s of computing.*load\(path, seconds="):
        ph.load(path, seconds=1)


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), float("inf")])
def test_an_invalid_time_limit_is_refused(files, tmp_path, seconds):
    path = tmp_path / "motion.h5"
    path.write_bytes(files[0])
    with pytest.raises(StoreError, match="a limit of"):
        ph.load(path, seconds=seconds)
