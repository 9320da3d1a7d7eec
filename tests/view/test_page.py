"""The page as a file; what it does in a browser is tested in tests/browser."""

import base64
import hashlib
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

import polhode as ph
from pages import scene_in, unpacked
from polhode.base import StoreError
from polhode.view._packed import packed_scene

HOSTILE = "</script><script>alert(1)</script>\u2028<!--"


@pytest.fixture(scope="module")
def text(run_of, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "disk.html"
    ph.page(run_of("rolling-disk"), path, title=HOSTILE, about=HOSTILE)
    return path.read_text("utf-8")


def test_it_is_one_small_file_that_refers_to_nothing(text):
    assert len(text.encode()) < 900_000
    assert not re.findall(r"<(?:script|img|iframe|link)[^>]* (?:src|href)=\"(?!data:)", text)
    assert "@import" not in text
    assert "default-src 'none'" in text


def test_only_its_own_script_may_run(text):
    scripts = re.findall(r"<script>(.*?)</script>", text, flags=re.DOTALL)
    assert len(scripts) == 1
    digest = base64.b64encode(hashlib.sha256(scripts[0].encode()).digest()).decode()
    assert f"script-src 'sha256-{digest}'" in text


def test_names_are_no_markup(text):
    assert "<script>alert" not in text
    assert scene_in(text)["title"] == HOSTILE
    assert "&lt;/script&gt;" in re.search("<title>(.*?)</title>", text, re.DOTALL).group(1)


def test_licences_travel_with_the_page(text):
    for name in ("three", "uplot"):
        assert re.search(rf"^{name} [\d.]+ \(MIT\)$", text, flags=re.MULTILINE)
    assert text.count("Permission is hereby granted") == 2


def test_a_page_that_cannot_be_written_is_reported(run_of, tmp_path):
    with pytest.raises(StoreError, match="cannot be written"):
        ph.page(run_of("gyroscope/held"), tmp_path / "none" / "page.html")


def test_the_same_motion_gives_the_same_page(run_of):
    first, second = (ph.scene(run_of("gyroscope/held")).as_json() for _ in range(2))
    assert first == second


@pytest.fixture(scope="module")
def disk(run_of):
    return ph.scene(run_of("rolling-disk"), frames=21)


@given(st.data())
def test_numbers_are_packed_without_loss(disk, data):
    """But for arrows, of which 14 binary digits are kept."""
    shapes = array_shapes(min_dims=1, max_dims=3, min_side=0, max_side=7)
    bits = [data.draw(arrays("<u4", data.draw(shapes))) for _ in range(3)]
    sent = replace(disk, origin={"sent": [b.view("<f4") for b in (*bits, bits[0])]})
    found = unpacked(packed_scene(sent))
    for one, came in zip((*bits, bits[0]), found["origin"]["sent"], strict=True):
        assert np.array_equal(came.view("<u4"), one)
    for arrow, came in zip(disk.arrows, found["arrows"], strict=True):
        assert np.allclose(came["along"], arrow.along, rtol=2**-14, atol=0)


def test_all_that_is_in_a_scene_is_in_its_page(disk):
    found = unpacked(packed_scene(disk))
    assert found["arrows"][0]["foot"].shape == disk.arrows[0].foot.shape
    turn = disk.bodies[0].pose.turn.astype("f4")
    assert np.array_equal(found["bodies"][0]["pose"]["turn"], turn)
    assert [body["name"] for body in found["bodies"]] == ["disk"]


def test_a_constant_force_is_not_rounded(disk):
    """A weight of 4.905 N would be shown as 4.9 N."""
    (weight,) = (arrow for arrow in disk.arrows if arrow.kind == "load")
    shown = replace(disk, arrows=(replace(weight, along=np.array([[0.0, 0.0, -4.905]])),))
    (found,) = unpacked(packed_scene(shown))["arrows"]
    assert found["along"][0, 2] == np.float32(-4.905)
