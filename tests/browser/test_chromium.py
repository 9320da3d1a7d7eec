"""Where the browser of the tests comes from."""

import pytest

from browser import chromium


@pytest.fixture
def nothing_installed(monkeypatch):
    monkeypatch.setattr(chromium, "INSTALLED", ())


def test_without_any_it_says_what_to_install(nothing_installed, monkeypatch):
    monkeypatch.setattr(chromium.shutil, "which", lambda name: None)
    with pytest.raises(chromium.NoBrowserError, match="install Node"):
        chromium.find_chromium()


def test_a_lacking_library_is_named(nothing_installed, monkeypatch, tmp_path):
    listing = "\tlibnss3.so => not found\n\tlibc.so.6 => /lib/libc.so.6 (0x0)\n"
    monkeypatch.setattr(chromium, "_unpacked", lambda node: tmp_path / "chromium")
    monkeypatch.setattr(chromium, "HERE", tmp_path)
    monkeypatch.setattr(chromium.shutil, "which", lambda name: "node")
    (tmp_path / "node_modules").mkdir()
    monkeypatch.setattr(chromium.subprocess, "run", lambda *a, **k: _Told(listing))
    with pytest.raises(chromium.NoBrowserError, match=r"lacks libnss3\.so,?"):
        chromium.find_chromium()


class _Told:
    def __init__(self, text):
        self.stdout = text
