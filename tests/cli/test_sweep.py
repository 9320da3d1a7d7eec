"""`polhode sweep` and `polhode map`, as a shell has them."""

import json

import pytest

from polhode.cli import main

SWEEP = ["sweep", "rolling-disk", "--axis", "theta=50deg:85deg:3", "--axis", "omega_3=5rad/s:20:2"]
SHORT = ["--start", "phi_dot=1rad/s", "--duration", "0.05s", "--until", "lifts off"]


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    path = str(tmp_path_factory.mktemp("cli") / "fates")
    assert main([*SWEEP, *SHORT, "--keep", "theta", "--out", path, "--json"]) == 0
    return path


def test_a_sweep_reports_its_members(store, capsys):
    assert main([*SWEEP, *SHORT, "--keep", "theta", "--out", store, "--resume", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["members"] == 6
    assert found["failed"] == 0
    assert found["store"] == store
    assert found["seconds"] > 0
    assert found["schema"] == 3


def test_a_sweep_tells_why_members_failed(tmp_path, capsys):
    words = ["sweep", "rolling-disk", "--axis", "theta=80deg:85deg:2", "--duration", "0.3s"]
    assert main([*words, "--out", str(tmp_path / "fates")]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "2 members, 2 failed" in out
    assert "for instance at t = 0.156019054 s the normal force vanishes" in out


def test_a_map_is_drawn(store, tmp_path, capsys):
    for suffix, show in ((".png", []), (".svg", ["--show", "duration"])):
        picture = tmp_path / f"fates{suffix}"
        assert main(["map", store, "-o", str(picture), *show]) == 0
        assert picture.stat().st_size > 1000
    # Starts with phi_dot = 1 rad/s are no steady motion, and have no threshold of one.
    assert "3*a*omega_3**2 - g = 0" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([*SWEEP, *SHORT], "--out"),
        (["sweep", "rolling-disk", "--axis", "theta=1:2", "--out", "x"], "FROM:TO:COUNT"),
        (["sweep", "rolling-disk", "--axis", "theta=1:2:0", "--out", "x"], "0 values"),
        (["sweep", "rolling-disk", "--axis", "thete=1:2:3", "--out", "x"], "thete"),
        (["sweep", "rolling-disk", "--axis", "theta=1s:2s:3", "--out", "x"], "theta"),
        (["sweep", "gyrocompass", "--axis", "m=1kg:2kg:3", "--out", "x"], "depends on a quantity"),
        ([*SWEEP, *SHORT, "--start", "theta=1", "--out", "x"], "both an axis and a value"),
        ([*SWEEP, *SHORT, "--workers", "0", "--out", "x"], "0 workers"),
        ([*SWEEP, *SHORT, "--out", "/dev/null/x"], "cannot be written"),
        ([*SWEEP, *SHORT, "--scheduler", "nowhere", "--out", "x"], "no scheduler answers"),
        (["map", "nothing", "-o", "x.png"], "does not exist"),
    ],
)
def test_refusals(words, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("polhode.study._compute._REACHED_WITHIN", 0.5)
    assert main(words) == 2
    assert message in capsys.readouterr().err


def test_a_map_needs_an_existing_output(store, tmp_path, capsys):
    assert main(["map", store, "-o", str(tmp_path / "a.png"), "--show", "fates"]) == 2
    assert "fates" in capsys.readouterr().err
