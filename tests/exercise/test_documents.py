"""Sheets in LaTeX: lines keep within the page."""

import shutil
import subprocess

import pytest

import polhode as ph
from polhode.exercise import write_document
from polhode.exercise._documents import tex_of
from polhode.exercise._sheet import SheetBlock

SUM = " + ".join(rf"I_{k} \dot{{\omega}}_{k}^2 \sin\theta" for k in range(1, 14))
LONG = [rf"\sqrt{{{SUM}}}", SUM, rf"\frac{{d}}{{dt}}\left({SUM}\right) = 0"]


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="LaTeX is not installed")
def test_long_formulas_keep_within_the_page(tmp_path):
    blocks = [SheetBlock(words=f"It oscillates at ${latex}$, 63° from 2 kg m².") for latex in LONG]
    blocks += [SheetBlock(latex=latex, number="7") for latex in LONG]
    source = tmp_path / "it.tex"
    source.write_text(tex_of(blocks, "It", ["rolling-disk"], 1), "utf-8")
    options = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    command = ["pdflatex", *options, source.name]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, timeout=120)
    assert "Overfull" not in source.with_suffix(".log").read_text("latin-1")


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="LaTeX is not installed")
def test_a_sheet_as_pdf(tmp_path):
    (path,) = write_document([SheetBlock(latex="1 = 1")], tmp_path / "it.pdf", "It", ["coin"], 1)
    assert path.read_bytes().startswith(b"%PDF")


def test_without_latex_a_pdf_is_refused(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ph.StoreError, match="pdflatex"):
        write_document([SheetBlock(latex="1 = 1")], tmp_path / "it.pdf", "It", ["coin"], 1)
