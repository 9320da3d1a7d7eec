"""`polhode exercise`: sheets, files, the list of kinds, marks and refusals."""

import csv
import json
from pathlib import Path

import pytest

DISK = ("exercise", "rolling-disk", "--seed", "3")
#: Kinds that cost little to make.
CHEAP = ("--kind", "freedom", "--kind", "motion", "--kind", "threshold")


def test_a_sheet_is_printed_without_its_answers(polhode):
    code, out, err = polhode(*DISK, *CHEAP)
    assert (code, err) == (0, "")
    assert out.startswith("<!-- polhode: rolling-disk -->")
    assert "1a: degrees of freedom: ______" in out
    assert r"\sqrt" not in out  # the threshold


def test_the_document(document):
    found = document(*DISK, "--kind", "threshold")
    (sheet,) = found["sheets"]
    (one,) = sheet["exercises"]
    assert found["seed"] == 3
    assert one["system"] == "rolling-disk"
    assert one["figure"].startswith("<svg")
    formula, number = one["questions"][0]["answers"]
    assert formula["kind"] == "formula"
    assert number["unit"] == "rad/s"


def test_kinds_are_listed(document):
    found = document("exercise", "gyroscope/held", "--list")
    assert found["systems"][0]["kinds"] == ["freedom", "velocities", "reaction", "wrong"]
    assert "threshold" in found["meanings"]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Two systems for three students in one command."""
    from polhode.cli import main

    folder = tmp_path_factory.mktemp("sheets")
    words = ["exercise", "rolling-disk", "marble-on-turntable", "--seed", "5", "--students", "3"]
    words += ["--kind", "freedom", "--kind", "frequency"]
    assert main([*words, "-o", str(folder / "week.md")]) == 0
    return folder


def test_files_of_several_students(made):
    names = sorted(path.name for path in made.iterdir())
    assert names == [
        "week-1-marble-on-turntable.svg",
        "week-1-rolling-disk.svg",
        "week-1.md",
        "week-2-marble-on-turntable.svg",
        "week-2-rolling-disk.svg",
        "week-2.md",
        "week-3-marble-on-turntable.svg",
        "week-3-rolling-disk.svg",
        "week-3.md",
        "week-key.json",
        "week-solution.md",
    ]
    texts = [(made / f"week-{i}.md").read_text("utf-8") for i in (1, 2, 3)]
    assert len(set(texts)) == 3
    assert all("1.2a: $S =$ ______" in text for text in texts)
    solution = (made / "week-solution.md").read_text("utf-8")
    assert "Sheet 5.3" in solution
    assert r"\tag{1}" in solution


def test_a_class_is_marked(made, tmp_path, polhode):
    key = json.loads((made / "week-key.json").read_text("utf-8"))
    folder = tmp_path / "handed in"
    folder.mkdir()
    for sheet in key["sheets"][:2]:
        rows = [f"student: {sheet['student']}"]
        for name, entry in sheet["answers"].items():
            right = entry["latex"] if entry["kind"] == "formula" else f"{entry['values'][0]:.4g}"
            rows.append(f"{name}: {right if sheet['student'] == 1 or name != '2.1a' else 17}")
        (folder / f"student-{sheet['student']}.txt").write_text("\n".join(rows), "utf-8")
    table = tmp_path / "marks.csv"
    mark = ("exercise", "--key", str(made / "week-key.json"), "--mark", str(folder))
    code, out, err = polhode(*mark, "--marks", str(table))
    assert (code, err) == (1, "")
    assert "student-1.txt, sheet 1: 8 of 8 right" in out
    assert "✗ 2.1a" in out
    first, second = csv.DictReader(table.read_text("utf-8").splitlines())
    assert (first["right"], first["wrong"], second["wrong"], second["2.1a"]) == (
        "8",
        "0",
        "1",
        "wrong",
    )
    (folder / "student-2.txt").unlink()
    assert polhode(*mark)[0] == 0


@pytest.mark.parametrize("ending", [".html", ".tex", ".ipynb"])
def test_files_by_their_endings(ending, polhode, tmp_path):
    sheet, solution = tmp_path / f"a{ending}", tmp_path / f"b{ending}"
    words = ("--kind", "freedom", "-o", str(sheet), "--solution", str(solution))
    code, out, _ = polhode("exercise", "marble-on-turntable", *words)
    assert code == 0
    assert out.split() == [str(sheet), str(tmp_path / "a-key.json"), str(solution)]
    text = sheet.read_text("utf-8")
    assert "degrees of freedom" in text
    assert "Without supports" not in text
    assert "Without supports" in solution.read_text("utf-8")
    assert "<script" not in text
    if ending == ".ipynb":
        assert json.loads(text)["nbformat"] == 4


def test_a_system_in_a_file(polhode, tmp_path):
    file = tmp_path / "swing.py"
    file.write_text(
        "import polhode as ph\n"
        "m, l, g = ph.symbols('m l g', positive=True)\n"
        "axes = ph.Frame('lab').rotated(ph.coordinate('theta'), 'y', name='axes')\n"
        "bob = ph.point_mass('bob', mass=m, axes=axes)\n"
        "swing = ph.System(ph.Pivot(bob, at=axes['z'] * l), ph.Gravity(g), name='swing')\n"
    )
    out = tmp_path / "swing.html"
    code, _, err = polhode(
        "exercise", f"{file}:swing", "--kind", "frequency", "--set", "l=1m", "-o", str(out)
    )
    assert (code, err) == (0, "")
    (sheet,) = json.loads((tmp_path / "swing-key.json").read_text("utf-8"))["sheets"]
    assert sheet["answers"]["1b"]["values"] == pytest.approx([2.00607], rel=1e-5)  # 2π√(l/g)
    answers = tmp_path / "mine.txt"
    answers.write_text("1a: \\sqrt{\\frac gl}\n1b: 2.0 s\n")
    mark = ("--key", str(tmp_path / "swing-key.json"), "--mark", str(answers))
    code, out, err = polhode("exercise", f"{file}:swing", *mark)
    assert (code, err) == (0, "")
    assert "2 of 2 right" in out
    moved = tmp_path / "elsewhere"
    moved.mkdir()
    file.rename(moved / "swing.py")
    assert polhode("exercise", f"{moved}/swing.py:swing", *mark)[0] == 0
    code, out, err = polhode("exercise", *mark)  # a key names no files
    assert (code, out) == (2, "")
    assert "polhode exercise FILE.py:NAME --key" in err


def test_a_sheet_on_a_system_in_a_file_names_none(polhode):
    top = Path(__file__).parents[2] / "docs" / "examples" / "top.py"
    code, out, _ = polhode("exercise", f"{top}:top", "--kind", "freedom")
    assert code == 0
    assert out.startswith("# ")


@pytest.mark.parametrize("name", ["9" * 5000, "12345678901", "0"])
def test_a_number_that_no_student_has(made, tmp_path, polhode, name):
    answers = tmp_path / "mine.txt"
    answers.write_text(f"student: {name}\n1.1: 2\n")
    code, _, err = polhode("exercise", "--key", str(made / "week-key.json"), "--mark", str(answers))
    assert code == 2
    assert "a student from 1 to 3" in err


@pytest.mark.parametrize("deep", ["[" * 100_000, '{"a":' * 100_000, '"x"', "{}", "[1]", "\udcff"])
def test_damaged_keys_and_notebooks(made, tmp_path, polhode, deep):
    damaged, notebook = tmp_path / "key.json", tmp_path / "1.ipynb"
    for path in (damaged, notebook):
        path.write_text(deep, "utf-8", errors="surrogateescape")
    mark = ("exercise", "--key", str(made / "week-key.json"), "--mark", str(notebook))
    for words in (mark, ("exercise", "--key", str(damaged), "--mark", str(notebook))):
        code, out, err = polhode(*words)
        assert (code, out) == (2, "")
        assert "unexpected" not in err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "no system"),
        (("nothing",), "is no system"),
        (("rolling-disk", "--kind", "essay"), "is no kind of question"),
        (("marble-on-turntable", "--kind", "threshold"), "list the kinds"),
        (("rolling-disk", "-o", "sheet.docx"), "ends in .html"),
        (("rolling-disk", "--students", "0"), "from 1 to 1000"),
        (("rolling-disk", "--questions", "0"), "from 1 to"),
        (("rolling-disk", "--set", "q=1"), "is no parameter"),
        (("rolling-disk", "--set", "a=1kg"), "kg"),
        (("rolling-disk", "--set", "a=-1m"), "a positive value"),
        (("rolling-disk", "--set", "a=foo"), "foo"),
        (("tennis-racquet", "--set", "I_1=9kg m^2"), "moments of inertia"),
        (("rolling-disk", "--seed", "x"), "invalid int"),
        (("rolling-disk", "rolling-disk"), "named twice"),
        (("rolling-disk", "spinning-coin", "--set", "a=1m"), "one system"),
        (("--key", "no-such-key.json", "--mark", "a.txt"), "no-such-key.json"),
        (("--mark", "a.txt"), "both"),
    ],
)
def test_bad_input_is_a_sentence(polhode, words, message):
    code, out, err = polhode("exercise", *words)
    assert (code, out) == (2, "")
    assert message in err
    assert "Traceback" not in err
