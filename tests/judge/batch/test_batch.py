"""Submissions of a class: one bad file stops no other, and a run that was stopped goes on."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from collections import Counter

import pytest

from judge.solutions import equations
from polhode.base import DeclarationError, StopRequested, StoreError
from polhode.catalogue import PROBLEM_SET
from polhode.judge.batch import Submission, review_batch, slips, submissions, write_marks

SYSTEM = PROBLEM_SET["rolling-disk"].build()
RIGHT = r"The potential energy is $V = m g a \sin\theta$."
WRONG = r"The potential energy is $V = m g a \cos\theta$."
OTHER = r"The potential energy is $V = mga\cos\theta$, I think, and $\omega_1 = \dot\theta$."


@pytest.fixture
def handed_in(tmp_path):
    """A folder with what a class hands in, and what else lies there."""
    folder = tmp_path / "class"
    (folder / "carol").mkdir(parents=True)
    (folder / "anna.tex").write_text(RIGHT)
    (folder / "bob.md").write_text(WRONG)
    (folder / "carol" / "main.tex").write_text(r"\input{part}")
    (folder / "carol" / "part.tex").write_text(OTHER)
    (folder / "=dan.tex").write_text(WRONG)
    (folder / "broken.ipynb").write_text("{")
    (folder / "latin.tex").write_bytes(b"\xff$a = b$")
    (folder / "empty.tex").write_text("")
    (folder / "picture.png").write_bytes(b"x")
    (folder / ".hidden.tex").write_text(WRONG)
    return folder


class Stopping:
    """Progress that asks the run to stop after some submissions."""

    def __init__(self, after):
        self.left = after

    def begin(self, task, total=None):
        pass

    def advance(self, steps=1):
        self.left -= steps
        if self.left == 0:
            raise StopRequested

    def finish(self):
        pass


def table(path):
    with path.open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_what_counts_as_a_submission(handed_in):
    found = submissions([handed_in])
    names = [os.path.basename(s.name) for s in found]
    assert names == [
        "=dan.tex",
        "anna.tex",
        "bob.md",
        "broken.ipynb",
        "carol",
        "empty.tex",
        "latin.tex",
    ]
    assert [path.name for path in found[4].paths] == ["main.tex", "part.tex"]


def test_nowhere_and_nothing_are_refused(tmp_path):
    with pytest.raises(StoreError, match="cannot be read"):
        submissions([tmp_path / "missing"])
    with pytest.raises(StoreError, match="no documents"):
        submissions([tmp_path])


def test_a_class_with_bad_files(handed_in, tmp_path):
    batch = review_batch(submissions([handed_in]), SYSTEM, tmp_path / "m.jsonl", workers=1)
    records = {os.path.basename(name): record for name, record in batch.records.items()}
    assert batch.left == ()
    assert "UTF-8" in records["latin.tex"].problem
    assert "JSON is damaged" in records["broken.ipynb"].problem
    assert "no relation" in records["empty.tex"].problem
    marks = {name: [line["mark"] for line in record.lines] for name, record in records.items()}
    assert marks["anna.tex"] == ["true"]
    assert marks["bob.md"] == marks["=dan.tex"] == ["error"]
    assert marks["carol"] == ["error", "true"]

    (slip,) = slips(batch).values()
    assert [os.path.basename(name) for name in slip.made_by] == ["=dan.tex", "bob.md", "carol"]
    assert (slip.what, slip.number) == ("cos where sin is right", 1)

    paths = write_marks(batch, tmp_path / "marks.csv")
    assert [path.name for path in paths] == ["marks.csv", "marks.lines.csv", "marks.slips.csv"]
    rows = {os.path.basename(row["submission"]): row for row in table(paths[0])}
    assert len(rows) == 7
    assert (rows["carol"]["error"], rows["carol"]["group"]) == ("1", "1")
    assert rows["latin.tex"]["problem"].startswith(str(handed_in))
    lines = table(paths[1])
    assert Counter(line["mark"] for line in lines) == {"error": 3, "true": 2}
    assert table(paths[2])[0]["submissions"] == "3"


def test_no_cell_is_a_formula(handed_in, tmp_path, monkeypatch):
    monkeypatch.chdir(handed_in)
    (handed_in / "minus.tex").write_text(r"$-V = m g a \cos\theta$")
    names = [handed_in / "=dan.tex", handed_in / "minus.tex"]
    found = [Submission(path.name, (path,)) for path in names]
    batch = review_batch(found, SYSTEM, tmp_path / "m.jsonl", workers=1)
    for path in write_marks(batch, tmp_path / "marks.csv"):
        for row in table(path):
            assert not any(value.startswith(("=", "-", "+", "@")) for value in row.values())


def test_a_stopped_run_goes_on_where_it_was(handed_in, tmp_path):
    found, log = submissions([handed_in]), tmp_path / "m.jsonl"
    first = review_batch(found, SYSTEM, log, workers=1, progress=Stopping(3))
    assert len(first.records) == 3
    assert len(first.left) == len(found) - 3
    # What a kill in the middle of a line leaves behind:
    log.write_bytes(log.read_bytes() + b'{"key": "abc", "rec')
    second = review_batch(found, SYSTEM, log, workers=1)
    assert (second.kept, second.left) == (3, ())
    assert {name: second.records[name] for name in first.records} == first.records
    third = review_batch(found, SYSTEM, log, workers=1)
    assert third.kept == len(found)
    assert third.records == second.records


def test_a_submission_that_was_changed_is_reviewed_again(handed_in, tmp_path):
    found, log = submissions([handed_in / "anna.tex", handed_in / "bob.md"]), tmp_path / "m.jsonl"
    review_batch(found, SYSTEM, log, workers=1)
    (handed_in / "bob.md").write_text(RIGHT)
    again = review_batch(found, SYSTEM, log, workers=1)
    assert again.kept == 1
    assert not any(record.has_errors for record in again.records.values())


def test_a_log_of_another_system_counts_not(handed_in, tmp_path):
    found, log = submissions([handed_in / "anna.tex"]), tmp_path / "m.jsonl"
    review_batch(found, SYSTEM, log, workers=1)
    other = PROBLEM_SET["tennis-racquet"].build()
    assert review_batch(found, other, log, workers=1).kept == 0


def test_a_submission_that_takes_too_long_keeps_the_lines_judged(handed_in, tmp_path):
    many = "\n\n".join(rf"$V = m g a \sin\theta + {n} - {n}$" for n in range(3000))
    (handed_in / "long.tex").write_text(many)
    found = submissions([handed_in / "long.tex", handed_in / "anna.tex"])
    batch = review_batch(found, SYSTEM, tmp_path / "m.jsonl", workers=1, seconds=2.0)
    long, anna = batch.records.values()
    assert "more than 2 s" in long.problem
    assert [line["mark"] for line in anna.lines] == ["true"]


def test_no_workers_are_refused(tmp_path):
    with pytest.raises(DeclarationError, match="0 workers"):
        review_batch([], SYSTEM, tmp_path / "m.jsonl", workers=0)


def test_a_log_that_cannot_be_written(handed_in, tmp_path):
    with pytest.raises(StoreError, match="cannot be"):
        review_batch(submissions([handed_in]), SYSTEM, tmp_path / "no" / "m.jsonl", workers=1)


def test_a_killed_command_goes_on(handed_in, tmp_path):
    command = [sys.executable, "-m", "polhode", "review", str(handed_in), "--system"]
    command += ["rolling-disk", "--marks", str(tmp_path / "marks.csv"), "--workers", "1"]
    run = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    log = tmp_path / "marks.jsonl"
    while not (log.exists() and log.read_text().count("\n")):
        assert run.poll() is None
        time.sleep(0.02)
    run.send_signal(signal.SIGKILL)
    run.communicate()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1, done.stderr
    assert "in an earlier run" in done.stdout
    assert len(table(tmp_path / "marks.csv")) == 7
    rows = [json.loads(row) for row in log.read_text().splitlines() if row]
    assert len(rows) == len({row["key"] for row in rows}) == 7


def test_the_fixture_is_about_the_same_system():
    assert equations().system.name == SYSTEM.name


def test_one_slip_is_one_group_however_it_is_spaced(tmp_path):
    for name, latex in (("a", r"V=mga\cos\theta"), ("b", r"V = m\,g\,a \cos{\theta}")):
        (tmp_path / f"{name}.tex").write_text(f"The potential energy is ${latex}$")
    (tmp_path / "c.tex").write_text(r"The potential energy is $V = g \cos\theta m a$")
    found = submissions([tmp_path])
    batch = review_batch(found, SYSTEM, tmp_path / "log.jsonl", workers=1)
    one, other = slips(batch).values()
    assert len(one.made_by) == 2
    assert one.correction.replace(" ", "") == r"V=mga\sin\theta"
    assert other.correction == r"V = g \sin\theta m a"
