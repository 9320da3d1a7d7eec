"""The kernel within Python: bounded address space, forks, pickles, threads, a damaged cache."""

import multiprocessing
import pickle
import subprocess
import sys
import textwrap
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from polhode.base import NumericError, cache
from polhode.simulate.integrate._kernel import up_to_where_stopped
from polhode.simulate.kernel import _instance
from polhode.simulate.kernel._host import Kernel, Steps
from polhode.simulate.kernel._layout import Layout
from polhode.simulate.kernel._steps import Status
from simulate.kernel.tapes import layout_of
from simulate.kernel.test_steps import oscillator


def reached(kernel, goal=3.0):
    kernel.start(np.empty(0), 0.0, np.array([1.0, 0.5]))
    return kernel.advance(goal, np.inf, 64).state


@pytest.fixture
def kernel():
    return Kernel(layout_of(oscillator(), 2))


def test_with_a_bounded_address_space():
    """Two gibibytes, as by `ulimit -v`, for several kernels at once."""
    program = """
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))
        from simulate.kernel.test_host import Kernel, layout_of, oscillator, reached
        kernels = [Kernel(layout_of(oscillator(), 2)) for _ in range(20)]
        print(len({reached(kernel).tobytes() for kernel in kernels}))
    """
    command = [sys.executable, "-c", textwrap.dedent(program)]
    run = subprocess.run(command, capture_output=True, text=True, check=True, env=_environment())
    assert run.stdout.strip() == "1"


def _environment():
    import os

    return os.environ | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}


def test_pickled_it_is_its_layout_and_begins_anew(kernel):
    expected = reached(kernel)
    copied = pickle.loads(pickle.dumps(kernel))
    assert np.array_equal(reached(copied), expected)
    assert len(pickle.dumps(kernel)) < 5000


@pytest.mark.skipif(sys.platform == "win32", reason="there are no forks")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_process_compiles_its_own(kernel):
    expected = reached(kernel)
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe()

    def answer():
        theirs.send((reached(kernel), _instance._compiled.cache_info().currsize))

    process = context.Process(target=answer)
    process.start()
    assert ours.poll(60)
    found, compiled = ours.recv()
    process.join(60)
    assert np.array_equal(found, expected)
    assert compiled == _instance._compiled.cache_info().currsize + 1


def test_in_many_threads():
    kernels = [Kernel(layout_of(oscillator(), 2)) for _ in range(8)]
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(reached, kernels))
    assert all(np.array_equal(state, found[0]) for state in found)


@pytest.fixture
def empty_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("POLHODE_CACHE", str(tmp_path))
    _instance._compiled.cache_clear()
    yield tmp_path / "kernel"
    _instance._compiled.cache_clear()


@pytest.mark.parametrize("damage", ["bytes", "digest", "another module", "missing"])
def test_a_damaged_cache_is_made_anew(kernel, empty_cache, damage):
    expected = reached(Kernel(layout_of(oscillator(), 2)))
    key = _instance._key()
    whole = cache.read("kernel", key)
    assert whole[:4] == b"\0asm"
    (file,) = empty_cache.rglob(key)
    if damage == "missing":
        file.unlink()
    elif damage == "another module":
        cache.write("kernel", key, whole[:-100])
    else:
        content = bytearray(file.read_bytes())
        content[1 if damage == "digest" else -50] ^= 1
        file.write_bytes(content)
    _instance._compiled.cache_clear()
    assert np.array_equal(reached(Kernel(layout_of(oscillator(), 2))), expected)
    assert cache.read("kernel", key) == whole


def test_more_memory_than_there_is_is_an_error():
    layout = layout_of(oscillator(), 2)
    huge = Layout(replace(layout.tape, rows=2**28), layout.order, layout.steps)
    with pytest.raises(NumericError, match="MiB of memory to integrate"):
        Kernel(huge).start(np.empty(0), 0.0, np.zeros(2))


def test_a_call_that_is_broken_at_once_has_no_step_to_stop_at():
    broken = Steps(
        np.empty((0, 2)),
        np.empty(0),
        np.empty((0, 1, 1)),
        (0.5, 0.0),
        np.ones(1),
        Status.BROKEN,
        np.empty(0),
    )
    assert up_to_where_stopped(broken, lambda time, state: False) is broken
