"""Garbage on the command line: refused with exit code 2 in one line, and never a traceback."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from functools import partial
from io import StringIO

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polhode.catalogue import CATALOGUE
from polhode.cli import main
from polhode.cli._main import COMMANDS
from proof.widened import widened

QUICK = ["rolling-disk", "gyroscope", "tennis-racquet", "ball-on-paper"]
KEYS = ["m", "a", "g", "theta", "phi_dot", "omega_3", "X", "mu", "x", "t", "pi", ""]

anything = st.one_of(
    st.text(max_size=25),
    st.text("0123456789.eE+-*/^() amtsincokgrd_=", max_size=25),
    st.sampled_from(["nan", "inf", "-inf", "1e999", "1e-999", "0", "-0", "1/0", "0/0", "pi/0"]),
    st.tuples(
        st.floats(allow_nan=True, allow_infinity=True).map(str),
        st.sampled_from(["", "kg", "m", "deg", "rpm", "furlong", "m/s^2", "kg m^2", "1/s", "%"]),
    ).map("".join),
)
#: Holds a character that no value, name or path of ours has.
never_right = st.tuples(anything, st.sampled_from('#;`$?@!|&<>~{}\\"\u202e\x07€'), anything).map(
    "".join
)


@pytest.fixture(autouse=True, scope="module")
def _cache_of_its_own(tmp_path_factory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("POLHODE_CACHE", str(tmp_path_factory.mktemp("cache")))
        patch.delenv("POLHODE_DEBUG", raising=False)
        yield


@contextmanager
def heard() -> Iterator[tuple[StringIO, StringIO]]:
    """What is printed meanwhile, on standard output and standard error."""
    with redirect_stdout(StringIO()) as out, redirect_stderr(StringIO()) as err:
        yield out, err


def outcome(*words: str) -> int:
    """The exit code of a command, which has kept its manners whatever it was given."""
    with heard() as (out, err):
        code = main(words)
    said = err.getvalue()
    assert code in (0, 2), f"exit code {code}: {said}"
    assert "Traceback" not in said
    assert "please report it" not in said, said
    if code == 2:
        assert out.getvalue() == ""
        # One line, or one for each of several files.
        lines = said.splitlines()
        assert all(line.startswith("polhode: ") for line in lines)
        assert 1 <= len(lines) <= max(1, len(words) - 1)
    return code


def refused(*words: str) -> None:
    assert outcome(*words) == 2


#: A tour is written into whatever directory it is given.
NAMING = sorted({*COMMANDS, "nothing", ""} - {"tour"})


@partial(widened, examples=4000)
@given(st.sampled_from(NAMING), st.lists(never_right, min_size=1, max_size=3))
def test_garbage_for_a_name(command, words):
    assume(not any(word.startswith("-") for word in words))
    refused(command, *words)


@partial(widened, examples=3000)
@given(
    st.sampled_from(["derive", "steady", "invariants", "run"]),
    st.one_of(anything, st.sampled_from(sorted(CATALOGUE)).map(lambda name: name[:-1])),
)
def test_a_name_that_is_none(command, name):
    assume(name not in CATALOGUE and name not in ("-h", "--help"))
    refused(command, name)


@partial(widened, examples=4000)
@given(
    st.sampled_from(QUICK),
    st.sampled_from(["--set", "--start", "--duration"]),
    st.sampled_from(KEYS),
    never_right,
)
def test_garbage_for_a_value_of_a_run(name, option, key, text):
    value = text if option == "--duration" else f"{key}={text}"
    refused("run", name, "--duration", "0.01", option, value)


@partial(widened, examples=600)
@given(
    st.sampled_from(QUICK), st.sampled_from(["--set", "--start"]), st.sampled_from(KEYS), anything
)
def test_any_value_of_a_run(name, option, key, text):
    outcome("run", name, "--duration", "0.01", option, f"{key}={text}")


@partial(widened, examples=1500)
@given(st.sampled_from(QUICK), st.sampled_from(KEYS), never_right)
def test_garbage_for_a_steady_motion(name, key, text):
    refused("steady", name, "--at", f"{key}={text}")


@partial(widened, examples=300)
@given(st.sampled_from(QUICK[:2]), st.sampled_from(KEYS), anything)
def test_any_value_of_a_steady_motion(name, key, text):
    outcome("steady", name, "--at", f"{key}={text}")


@partial(widened, examples=3000)
@given(st.sampled_from([*COMMANDS]), st.lists(st.text(max_size=8).map("--".__add__), min_size=1))
def test_options_that_are_none(command, options):
    assume(not {"--help", "--json"} & set(options))
    assume(command != "tour")
    refused(command, *options, "--no-such-option")
