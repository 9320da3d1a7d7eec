"""Exported kernels: the same bits in Node and in Python, and the motion that `simulate` finds."""

import hashlib
import json
import math
import struct

import numpy as np
import pytest

import polhode as ph
from polhode.base import DeclarationError
from polhode.catalogue import PROBLEM_SET, numbers_of
from polhode.simulate._export_kernel import exported_kernel
from polhode.simulate.kernel._host import Kernel
from polhode.simulate.kernel._steps import Status
from simulate.kernel.hosts import node

# A host in a few lines, by nothing but the description in the module.
_RUN = """
const { readFileSync } = require("fs");
const { createHash } = require("crypto");
const { file, duration } = JSON.parse(readFileSync(0, "utf8"));
const module_ = new WebAssembly.Module(readFileSync(file));
const [section] = WebAssembly.Module.customSections(module_, "polhode");
const about = JSON.parse(new TextDecoder().decode(section));
const { memory, start, advance, values } = new WebAssembly.Instance(module_).exports;
const bytes = memory.buffer, view = new DataView(bytes), { fields, records } = about;
const set = (place, value) => view.setFloat64(place, value, true);
for (const { address, value } of about.parameters) set(address, value);
for (const { address, start } of about.states) set(address, start);
set(fields.time, 0);
set(fields.goal, duration);
set(fields.longest, duration / about.steps.fewest);
start();
const hash = createHash("sha256");
let status = about.status.going, steps = 0;
while (status === about.status.going) {
  status = advance(about.steps.most);
  const done = view.getInt32(fields.done, true);
  hash.update(new Uint8Array(bytes, records.address, done * records.bytes));
  steps += done;
}
values();
const hex = ({ address }) => view.getBigUint64(address, true).toString(16).padStart(16, "0");
process.stdout.write(JSON.stringify({
  status, steps, records: hash.digest("hex"),
  state: about.states.map(hex), quantities: about.quantities.map(hex),
}));
"""


def doubles(texts):
    return [struct.unpack(">d", bytes.fromhex(text))[0] for text in texts]


def in_python(exported, duration):
    """The same motion with wasmtime: status, steps, their records, and the state at the end."""
    about, kernel = exported.description, Kernel(exported.layout)
    kernel.start(
        np.array([p["value"] for p in about["parameters"]]),
        0.0,
        np.array([s["start"] for s in about["states"]]),
    )
    digest, steps = hashlib.sha256(), 0
    while True:
        call = kernel.advance(duration, duration / about["steps"]["fewest"], 64)
        for begin, length, shares in zip(call.begins, call.lengths, call.shares, strict=True):
            digest.update(begin.tobytes() + length.tobytes() + shares.tobytes())
        steps += len(call.lengths)
        if call.status is not Status.GOING:
            return call.status, steps, digest.hexdigest(), call.state


@pytest.mark.parametrize("name", PROBLEM_SET)
def test_node_and_python_compute_the_same_bits(name, tmp_path):
    """All steps of the default motion of every system, and its state at the end."""
    entry = PROBLEM_SET[name]
    equations = ph.derive(entry.build())
    numbers = numbers_of(entry, equations)
    exported = exported_kernel(equations, numbers.parameters, numbers.start, numbers.forcing)
    run = ph.simulate(
        equations,
        numbers.parameters,
        numbers.start,
        numbers.duration,
        samples=2,
        forcing=numbers.forcing,
    )
    file = tmp_path / "system.wasm"
    file.write_bytes(exported.binary)
    there = node(_RUN, file=str(file), duration=run.duration)
    status, steps, records, state = in_python(exported, run.duration)
    assert (there["status"], there["steps"], there["records"]) == (status, steps, records)
    assert status is Status.GOAL
    assert doubles(there["state"]) == state.tolist()
    about = exported.description
    reached = dict(zip((s["name"] for s in about["states"]), state, strict=True))
    named = (q["name"] for q in about["quantities"])
    reached |= dict(zip(named, doubles(there["quantities"]), strict=True))
    for quantity, value in reached.items():
        expected = run.evaluate(equations.least.get(quantity, quantity), run.duration)
        assert value == pytest.approx(float(expected), rel=1e-8, abs=1e-8), quantity


def hanging():
    theta = ph.coordinate("theta")
    m, l, g, k = ph.symbols("m l g k", positive=True)
    rod = ph.rod("rod", mass=m, length=l, axes=ph.Frame("lab").rotated(theta, "y"), axis="z")
    parts = (ph.Pivot(rod, at=rod.axes["z"] * (l / 2)), ph.Gravity(g))
    return parts, theta, k


def test_the_description_names_units_and_values():
    parts, _, _ = hanging()
    equations = ph.derive(ph.System(*parts))
    binary = ph.export(equations, "wasm", {"m": 2, "l": "30 cm", "g": 9.81}, {"theta": "30 deg"})
    text = binary[binary.index(b'{"format": "polhode kernel"') :]
    about, _ = json.JSONDecoder().raw_decode(text.decode("utf-8", errors="replace"))
    states = {s["name"]: (s["unit"], s["start"]) for s in about["states"]}
    assert states == {"theta": ("rad", math.radians(30)), "theta_dot": ("rad/s", 0.0)}
    values = {p["name"]: (p["unit"], p["value"]) for p in about["parameters"]}
    assert values == {"m": ("kg", 2.0), "l": ("m", 0.3), "g": ("m/s^2", 9.81)}
    units = {q["name"]: q["unit"] for q in about["quantities"]}
    assert units["energy"] == "J"
    assert about["guards"] == []


def test_without_values_it_has_none():
    parts, _, _ = hanging()
    equations = ph.derive(ph.System(*parts))
    about = exported_kernel(equations, {}, {}, {}).description
    assert {p["value"] for p in about["parameters"]} == {None}
    assert {s["start"] for s in about["states"]} == {None}


NUMBERS = {"m": 2, "g": 10, "k": 4, "h": 1, "i": 1}


def test_a_normal_force_that_vanishes_ends_the_motion():
    """A block on ice, pulled upwards by k t, is lifted at t = m g/k."""
    m, g, k, h, i = ph.symbols("m g k h i", positive=True)
    lab = ph.Frame("lab")
    block = ph.Body("block", mass=m, inertia=(i, i, i), axes=lab, surface=ph.Face(h))
    pull = ph.Force(block.point(), lab["z"] * (k * ph.time), name="pull")
    system = ph.System(ph.Smooth(block, on=ph.Plane(lab)), ph.Gravity(g), pull)
    exported = exported_kernel(ph.derive(system), NUMBERS, {}, {})
    about, kernel = exported.description, Kernel(exported.layout)
    assert about["guards"] == ["F_z"]
    kernel.start(
        np.array([p["value"] for p in about["parameters"]]),
        0.0,
        np.array([s["start"] for s in about["states"]]),
    )
    call = kernel.advance(20.0, 0.5, 64)
    assert call.status is Status.FALL
    assert call.end[0] == pytest.approx(5, abs=1e-14)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"start": {"theta": 1}}, "start values without values of the parameters"),
        ({"parameters": {"m": 1}}, "no value for"),
    ],
)
def test_values_that_are_missing(given, message):
    parts, _, _ = hanging()
    with pytest.raises(DeclarationError, match=message):
        ph.export(ph.derive(ph.System(*parts)), "wasm", **given)


def test_values_are_for_kernels_only():
    parts, _, _ = hanging()
    with pytest.raises(DeclarationError, match="values for source code in c"):
        ph.export(ph.derive(ph.System(*parts)), "c", {"m": 1})
