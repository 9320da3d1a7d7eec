"""The command as a process: help, versions, failures nobody foresaw, interruptions, pipes."""

import json
import os
import signal
import subprocess
import sys
from importlib.metadata import version

import pytest

from polhode import base
from polhode.cli import _parser, _run_files, main

POLHODE = (sys.executable, "-m", "polhode")


def test_the_installed_command_and_the_module_are_one():
    script = os.path.join(os.path.dirname(sys.executable), "polhode")
    for command in ((script,), POLHODE):
        run = subprocess.run([*command, "--version"], capture_output=True, text=True)
        assert (run.returncode, run.stdout) == (0, f"polhode {version('polhode')}\n")


@pytest.mark.parametrize("command", [(), ("list",), ("derive",), ("run",), ("tour",), ("cache",)])
def test_help_is_help(polhode, command):
    code, out, err = polhode(*command, "--help")
    assert (code, err) == (0, "")
    assert out.startswith(" ".join(["usage: polhode", *command]))


def test_help_names_every_command(polhode):
    _, out, _ = polhode("--help")
    for command in ("list", "derive", "run", "tour", "cache"):
        assert f"\n    {command} " in out


def test_values_and_formulas_may_begin_with_a_minus_sign():
    parser = _parser.Parser()
    parser.add_argument("formula")
    parser.add_argument("--given")
    parser.add_argument("-o")
    read = parser.parse_args(["-M g \\hat z", "--given", "-2*a", "-o", "-file"])
    assert (read.formula, read.given, read.o) == ("-M g \\hat z", "-2*a", "-file")


def fail(*_):
    raise RuntimeError("something\nnobody foresaw")


def test_an_unforeseen_failure_is_one_line(polhode, monkeypatch):
    monkeypatch.setattr(base.cache, "clear", fail)
    code, out, err = polhode("cache", "clear")
    assert (code, out) == (2, "")
    assert err.startswith("polhode: unexpected RuntimeError: something nobody foresaw")
    assert err.count("\n") == 1


def test_an_unforeseen_failure_has_a_traceback_on_request(polhode, monkeypatch):
    monkeypatch.setattr(base.cache, "clear", fail)
    monkeypatch.setenv("POLHODE_DEBUG", "1")
    code, _, err = polhode("cache", "clear")
    assert code == 2
    assert err.startswith("Traceback")
    assert 'raise RuntimeError("something' in err


def test_a_full_disk_under_the_output_is_named():
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "polhode", "list", "--json"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
        )
    assert done.returncode == 2
    assert "no space left" in done.stderr
    assert "unexpected" not in done.stderr


def test_warnings_of_libraries_are_not_shown(polhode):
    code, _, err = polhode("run", "rolling-disk", "--set", "m=1e308", "--duration", "0.1s")
    assert code == 2
    assert "Warning" not in err


#: The command, which says on its standard output when it has taken its first step.
_RUN = """
import sys
from polhode.base import SilentProgress
from polhode.cli import _motion
from polhode.cli._main import main

class Announced(SilentProgress):
    steps = 0

    def advance(self, steps=1):
        self.steps += 1
        if self.steps == 1:
            print("under way", flush=True)

_motion.terminal_progress = Announced
sys.exit(main(sys.argv[1:]))
"""


def test_an_interrupted_run_ends_with_130():
    words = (sys.executable, "-c", _RUN, "run", "rolling-disk", "--duration", "1e6")
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        assert run.stdout.readline() == "under way\n"
        run.send_signal(signal.SIGINT)
        out, err = run.communicate()
    assert run.returncode == 130
    assert "interrupted" in out  # with the state reached by then
    assert err.startswith("polhode: interrupted")


def test_an_interrupted_run_names_the_files_written(polhode, monkeypatch, tmp_path):
    def interrupt(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(_run_files, "figure_of_run", interrupt)
    code, out, err = polhode("run", "spinning-coin", "--duration", "0.1s", "--out", str(tmp_path))
    table = tmp_path / "spinning-coin.csv"
    assert (code, out, err) == (130, "", f"polhode: interrupted; kept {table}\n")
    assert list(tmp_path.iterdir()) == [table]


def test_a_closed_pipe_is_no_error():
    words = f"{' '.join(POLHODE)} list --json | head -n 1; echo ${{PIPESTATUS[@]}}"
    run = subprocess.run(["bash", "-c", words], capture_output=True, text=True)
    assert run.stderr == ""
    assert run.stdout.startswith("{\n")


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "cp850"])
def test_a_terminal_without_greek_gets_formulas_in_ascii(encoding):
    environment = {**os.environ, "PYTHONIOENCODING": encoding}
    words = (*POLHODE, "derive", "rolling-disk")
    run = subprocess.run(words, capture_output=True, env=environment)
    assert (run.returncode, run.stderr) == (0, b"")
    square = "^2" if encoding == "ascii" else "²"
    motion = f"5 a theta_ddot - a phi_dot{square} sin(theta) cos(theta)"
    assert f"{motion} + 6 a omega_3 phi_dot sin(theta)" in run.stdout.decode(encoding)


@pytest.mark.parametrize(
    ("line", "code", "told"),
    [
        ("derive gyroscope >&-", 2, "standard output is closed"),
        ("list --json >&- 2>&-", 2, ""),
        ("derive gyroscope 1</dev/null", 2, "not open for writing"),
        ("derive gyroscope > /dev/full 2>&1", 2, ""),
        ("derive none > /dev/null 2>/dev/full", 2, ""),
        ("derive gyroscope > /dev/null <&-", 0, ""),
        ("list --json 2>&- > /dev/null", 0, ""),
        ("audit --only 1 >&-", 2, "standard output is closed"),
        ("audit --only 1 > /dev/null <&- 2>&-", 0, ""),
    ],
)
def test_streams_that_are_closed(line, code, told):
    run = subprocess.run(["bash", "-c", f"{' '.join(POLHODE)} {line}"], capture_output=True)
    assert run.returncode == code
    assert run.stdout == b""
    lines = run.stderr.decode().splitlines()
    assert [told in row and row.startswith("polhode: ") for row in lines] == [True] * bool(told)


def test_errors_never_appear_in_the_output_in_place_of_a_closed_stream():
    words = f"{' '.join(POLHODE)} derive nothing 2>&-"
    run = subprocess.run(["bash", "-c", words], capture_output=True)
    assert (run.returncode, run.stdout, run.stderr) == (2, b"", b"")


def test_what_compiled_libraries_print_is_no_part_of_a_document(tmp_path):
    """LAPACK writes to descriptor 1 itself, as the system's file does here."""
    noisy = """
import os
import polhode as ph
os.write(1, b" ** On entry to DLASCL parameter number  4 had an illegal value")
lab = ph.Frame("lab")
m, l, g = ph.symbols("m l g", positive=True)
axes = lab.rotated(ph.coordinate("theta"), "y")
bob = ph.point_mass("bob", mass=m, axes=axes)
system = ph.System(ph.Pivot(bob, at=axes["z"] * l), ph.Gravity(g), name="pendulum")
"""
    (tmp_path / "noisy.py").write_text(noisy)
    command = [*POLHODE, "derive", "noisy.py:system", "--json"]
    run = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert run.returncode == 0
    assert json.loads(run.stdout)["schema"] == 3
    assert "DLASCL" in run.stderr


def test_the_cache_is_cleared(polhode, tmp_path, monkeypatch):
    monkeypatch.setenv("POLHODE_CACHE", str(tmp_path / "cache"))
    main(["cache", "clear"])
    (base.cache.folder("compiled") / "object").write_bytes(bytes(1000))
    code, out, _ = polhode("cache", "clear")
    assert code == 0
    freed = int(out.splitlines()[-1].split()[1])
    assert freed >= 1000
    assert polhode("cache", "clear")[1].startswith("freed 0 bytes")
