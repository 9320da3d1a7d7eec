"""polhode page: pages that play a motion, and live ones."""

import json
import re
import zlib
from base64 import b64decode

import pytest

_LIVE = re.compile(r'<script type="application/json" id="live">"([^"]+)"</script>')


def live_part(text):
    """What a live page has besides its scene; None for one that plays a motion."""
    found = _LIVE.search(text)
    return json.loads(zlib.decompress(b64decode(found[1]))) if found else None


def test_a_page_plays_a_motion(polhode, tmp_path):
    path = tmp_path / "disk.html"
    code, out, err = polhode("page", "rolling-disk", "--duration", "0.2s", "-o", str(path))
    assert (code, out, err) == (0, f"{path}\n", "")
    text = path.read_text("utf-8")
    assert live_part(text) is None
    assert "wasm-unsafe-eval" not in text
    assert "<title>Rolling disk</title>" in text


def test_a_live_page_has_sliders_for_what_was_given(polhode, tmp_path):
    path = tmp_path / "paper.html"
    words = ("page", "ball-on-paper", "--case", "rolls-off", "--set", "r=3cm", "--live")
    code, out, _ = polhode(*words, "-o", str(path), "--json")
    assert code == 0
    assert json.loads(out)["live"] is True
    text = path.read_text("utf-8")
    assert "script-src 'sha256-" in text
    assert "'wasm-unsafe-eval'" in text
    assert "worker-src blob:" in text
    live = live_part(text)["live"]
    numbers = {slider["name"]: slider["text"] for slider in live["parameters"]}
    assert numbers["r"] == "3 cm"
    assert (numbers["mu"], numbers["edge"]) == ("0.2", "0.3 m")
    assert {mode["phase"] for mode in live["modes"]} == {"rolling", "sliding", "flight"}
    assert live["duration"] == 3


def test_the_cases_of_a_system_are_offered(polhode, tmp_path):
    path = tmp_path / "disk.html"
    assert polhode("page", "rolling-disk", "--live", "-o", str(path))[0] == 0
    presets = live_part(path.read_text("utf-8"))["live"]["presets"]
    assert [preset["title"].split()[0] for preset in presets] == ["Rolling", "Unless"]
    assert all(preset["start"]["theta"] == "91 deg" for preset in presets)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("page", "rolling-disk"), "-o"),
        (("page", "rolling-disk", "-o", "disk.txt"), ".html"),
        (("page", "rolling-disk", "--live", "-o", "no/such/folder/disk.html"), "no/such/folder"),
        (("page", "rolling-disk", "--mu-static", "0.3", "-o", "disk.html"), "--mu"),
        (("page", "rolling-disk", "--live", "--mu", "-1", "-o", "disk.html"), "-1"),
        (("page", "rolling-disk", "--live", "--set", "a=-3cm", "-o", "disk.html"), "a"),
        (("page", "rolling-disc", "-o", "disk.html"), "rolling-disk"),
    ],
)
def test_what_cannot_be_is_refused_and_writes_nothing(polhode, tmp_path, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    code, out, err = polhode(*words)
    assert (code, out) == (2, "")
    assert said in err
    assert list(tmp_path.iterdir()) == []


def test_a_system_without_a_live_page_says_why(polhode, tmp_path):
    """Resistance is a second contact beside that of the rim, and slides against it."""
    page = tmp_path / "disk.html"
    words = ("page", "eulers-disk", "--duration", "0.2s")
    code, _, err = polhode(*words, "--live", "-o", str(page))
    assert code == 2
    assert "a live page of eulers-disk, where one of several contacts slides" in err
    assert "leave out live" in err
    assert not page.exists()
    assert polhode(*words, "-o", str(page))[0] == 0
    assert page.exists()
