"""Runs beyond doubles, and runs that are interrupted, from a shell."""

import os
import signal
import subprocess
import sys
from decimal import Decimal, localcontext

import pytest

from polhode.base import SilentProgress, StopRequested
from polhode.cli._exit import Interruptible


def test_all_digits_are_printed(polhode):
    import json

    words = ("run", "tennis-racquet", "--duration", "0.1s", "--start", "omega_2=1/3")
    code, out, err = polhode(*words, "--precision", "40", "--json")
    assert (code, err) == (0, "")
    document = json.loads(out)
    assert document["precision"] == "40 digits"
    assert document["final"]["mode"] == "as declared"
    with localcontext() as context:
        context.prec = 60
        assert abs(Decimal(document["final"]["phi"]) - Decimal(1) / 30) < Decimal("1e-40")
    assert document["drift"]["energy"] < 1e-39
    assert document["duration"] == 0.1


def test_a_table_has_all_digits(polhode, tmp_path):
    words = ("run", "tennis-racquet", "--duration", "0.1s", "--start", "omega_2=1/3")
    code, out, _ = polhode(*words, "--precision", "quadruple", "--out", str(tmp_path))
    assert code == 0
    assert "omega_2 = 0.33333333333333333333333333333333" in out
    text = (tmp_path / "tennis-racquet.csv").read_text()
    assert "0.0333333333333333333333333333333" in text


@pytest.mark.parametrize("precision", ["triple", "7", "-20", "1e9", "99999999", "nan", "½"])
def test_an_unknown_precision_is_refused(polhode, precision):
    code, out, err = polhode("run", "tennis-racquet", "--precision", precision)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert "expected double, extended, quadruple, or a number of decimal digits" in err


def test_a_precise_motion_is_not_saved_in_doubles(polhode, tmp_path):
    save = str(tmp_path / "run.h5")
    code, out, err = polhode("run", "tennis-racquet", "--precision", "40", "--save", save)
    assert (code, out) == (2, "")
    assert "the file holds doubles" in err
    assert not list(tmp_path.iterdir())


# -- interrupted -----------------------------------------------------------------------------------


def test_an_interrupt_stops_at_the_next_step_and_only_once():
    progress = Interruptible(SilentProgress())
    before = signal.getsignal(signal.SIGINT)
    progress.begin("integrating")
    progress.advance()
    os.kill(os.getpid(), signal.SIGINT)
    with pytest.raises(StopRequested):
        progress.advance()
    assert signal.getsignal(signal.SIGINT) is before
    progress.finish()
    assert signal.getsignal(signal.SIGINT) is before


_RUN = """
import os, signal, sys
from polhode.base import SilentProgress
from polhode.cli import _motion
from polhode.cli._main import main

class AfterSteps(SilentProgress):
    left = 50

    def advance(self, steps=1):
        self.left -= 1
        if self.left == 0:
            os.kill(os.getpid(), signal.SIGINT)

_motion.terminal_progress = AfterSteps
sys.exit(main(sys.argv[1:]))
"""


def test_what_is_done_is_kept(tmp_path):
    import polhode as ph

    save = tmp_path / "run.h5"
    words = ("run", "rolling-disk", "--duration", "1e5s", "--save", str(save))
    done = subprocess.run(
        [sys.executable, "-c", _RUN, *words], capture_output=True, text=True, check=False
    )
    assert done.returncode == 130, done.stderr
    assert "interrupted at t = " in done.stderr
    assert "Traceback" not in done.stderr
    run = ph.load(save)
    assert run.events[-1].kind == "interrupted"
    assert 0 < run.duration < 1e4
    assert run.drift.energy < 1e-12
