"""The Python in README and docs runs, prints what the page says, and makes the figures shown."""

import importlib.util
import inspect
import re
from pathlib import Path

import pytest

import polhode

ROOT = Path(__file__).parents[1]
PAGES = [
    page
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    if "```python" in page.read_text("utf-8")
]
PICTURE = re.compile(r"!\[[^]]+\]\(([^)]+)\)")


@pytest.fixture(scope="module")
def hooks():
    """What builds the documents."""
    spec = importlib.util.spec_from_file_location("docs_hooks", ROOT / "docs_hooks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_examples_print_what_the_page_says(hooks, page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = page.read_text("utf-8")
    hooks.run_page(text, page.name)
    for picture in PICTURE.findall(text):
        assert (tmp_path / picture).is_file() or (page.parent / picture).is_file()


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("```python\nprint(1)\n```\n\n```text\n2\n```\n", "says:\n2\n"),
        ("```python\nprint(1)\n```\n", "hides what is printed at its end"),
        ("```python\nprint(1)\n```\n```python\nx = 1\n```\n", "hides what is printed before"),
    ],
)
def test_an_untrue_page_is_found(hooks, text, fault):
    with pytest.raises(hooks.ExampleError, match=fault):
        hooks.run_page(text, "page.md")


def test_formulas_beside_the_text_are_those_of_the_solution(hooks):
    page = (ROOT / "docs" / "disk-beside-the-text.md").read_text("utf-8")
    written = hooks.with_formulas(page)
    assert page.count("{{ disk:") == written.count('<math display="block"') > 30
    assert "{{" not in written
    with pytest.raises(hooks.ExampleError, match="no formula"):
        hooks.with_formulas("{{ disk: \\omega_4 = }}")


def test_every_page_is_in_the_table_of_contents():
    navigation = (ROOT / "mkdocs.yml").read_text("utf-8").partition("\nnav:")[2]
    listed = re.findall(r"[\w/-]+\.md", navigation)
    examples = ROOT / "docs" / "examples"  # texts to be reviewed, no pages
    pages = [
        page.relative_to(ROOT / "docs").as_posix()
        for page in (ROOT / "docs").rglob("*.md")
        if not page.is_relative_to(examples)
    ]
    assert sorted(listed) == sorted(pages)


def test_every_public_name_is_described_and_stands_in_the_reference(hooks):
    """Under the place it lives at, so that the table of all names leads to it."""
    reference = "".join(p.read_text("utf-8") for p in (ROOT / "docs" / "reference").glob("*.md"))
    described = re.findall(r"^::: (\S+)$", reference, re.MULTILINE)
    names = list(hooks.all_names())
    assert {name for name, _, _ in names} == {*polhode.__all__} - {"__version__"}
    assert [name for name, _, summary in names if not summary] == []
    assert [path for _, path, _ in names if path not in described] == []
    assert len(described) == len(set(described))


def test_everything_in_the_reference_exists_and_is_described():
    reference = "".join(p.read_text("utf-8") for p in (ROOT / "docs" / "reference").glob("*.md"))
    for path, options in re.findall(r"^::: (\S+)\n(?: +options: (.+)\n)?", reference, re.MULTILINE):
        room, _, name = path.rpartition(".")
        thing = getattr(importlib.import_module(room), name)
        for member in re.findall(r"\w+", options.partition("members:")[2]):
            assert inspect.getdoc(getattr(thing, member)), f"{path}.{member}"
