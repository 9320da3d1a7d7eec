"""Figures as files: whole, alike, and telling their origin."""

import json
import re

import pytest

from polhode.base import SCHEMA, StoreError, write_whole
from polhode.view import figures as view
from polhode.view.figures import _style as style


@pytest.fixture(scope="module")
def run(run_of):
    return run_of("gyroscope")


def drawn(run):
    return view.figure_of_run(run, [("theta",), ("F_rho", "F_z")])


@pytest.mark.parametrize("kind", ["svg", "pdf", "png"])
def test_the_same_picture_is_the_same_file(run, kind, tmp_path):
    first, second = tmp_path / f"a.{kind}", tmp_path / f"b.{kind}"
    view.save_figure(drawn(run), first)
    view.save_figure(drawn(run), second)
    assert first.read_bytes() == second.read_bytes()
    assert len(first.read_bytes()) > 1000
    assert [path.name for path in sorted(tmp_path.iterdir())] == [first.name, second.name]


def test_no_date_is_written(run):
    assert not re.search(r"dc:date|20\d\d-\d\d-\d\d", view.svg_of(drawn(run)))


def test_a_file_says_what_it_was_made_with(run, tmp_path):
    target = tmp_path / "run.svg"
    view.save_figure(drawn(run), target, origin=view.origin_of(run))
    text = target.read_text("utf-8").replace("&quot;", '"')
    (description,) = re.findall(r"<dc:description>(.*?)</dc:description>", text, re.DOTALL)
    origin = json.loads(description)
    assert origin["schema"] == SCHEMA
    assert origin["system"] == "gyroscope"
    assert origin["parameters"]["M"] == 0.5
    assert "polhode" in origin["versions"]
    assert "seed" in origin


def test_another_ending_is_refused(run, tmp_path):
    with pytest.raises(StoreError, match=r"run\.bmp; expected a name that ends in \.svg"):
        view.save_figure(drawn(run), tmp_path / "run.bmp")


def test_a_folder_that_is_not_there_is_an_error(run, tmp_path):
    with pytest.raises(StoreError, match="cannot be written"):
        view.save_figure(drawn(run), tmp_path / "nowhere" / "run.svg")


def test_a_failed_write_keeps_the_old_file(tmp_path, monkeypatch):
    target = tmp_path / "run.svg"
    target.write_text("old")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    with pytest.raises(StoreError, match="No space left"):
        write_whole(target, b"new")
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_the_dark_twin_differs_in_colours_alone(run):
    light = view.svg_of(drawn(run))
    dark = view.for_dark_pages(light)
    colour = re.compile("#[0-9a-f]{6}")
    assert colour.sub("", light) == colour.sub("", dark)
    assert set(colour.findall(dark)) <= set(style._DARK.values())


@pytest.mark.parametrize("shade", [*style.COLOURS, style.INK, style.MUTED])
def test_lines_and_text_stand_out_on_light_and_dark(shade):
    assert contrast(shade, "#ffffff") > 3
    assert contrast(style._DARK[shade], style._DARK["#ffffff"]) > 3


def contrast(first, second):
    """The contrast ratio of the web's accessibility guidelines."""
    low, high = sorted((luminance(first), luminance(second)))
    return (high + 0.05) / (low + 0.05)


def luminance(colour):
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
