"""The page as a file; what it does in a browser is tested in tests/browser."""

import base64
import hashlib
import json
import re

import pytest

import polhode as ph
from polhode.base import StoreError

HOSTILE = "</script><script>alert(1)</script>\u2028<!--"


@pytest.fixture(scope="module")
def text(run_of, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "disk.html"
    ph.page(run_of("rolling-disk"), path, title=HOSTILE, about=HOSTILE)
    return path.read_text("utf-8")


def test_it_is_one_small_file_that_refers_to_nothing(text):
    assert len(text.encode()) < 1_500_000
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
    data = re.search(r'id="scene">(.*?)</script>', text, flags=re.DOTALL).group(1)
    assert "<" not in data
    assert json.loads(data)["title"] == HOSTILE
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
