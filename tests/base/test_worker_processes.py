"""Worker processes: limits that hold, ends that are noticed, interruptions, and nothing left."""

import os
import signal
import subprocess
import sys
import time
from contextlib import closing
from functools import partial
from pathlib import Path

import pytest

from base.worker_tasks import all_of, doing, from_list, not_starting, refusing
from polhode.base import DeclarationError, StartMethod, Worker, WorkerEndedError, answers, can_copy

TESTS = Path(__file__).parents[1]
LONG = 120.0  # s within which something is seen to happen, on a machine that has other work

STARTS = [StartMethod.FRESH, StartMethod.SERVER, *([StartMethod.COPY] if can_copy() else [])]


@pytest.fixture(params=STARTS, ids=lambda start: start.name.lower())
def worker(request):
    with closing(Worker(doing, request.param, memory=8 << 30)) as begun:
        yield begun


def until(condition):
    end = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def is_alive(pid):
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


# -- one worker ------------------------------------------------------------------------------------


def test_one_process_answers_question_after_question(worker):
    assert worker.ask(("double", 3)) == 6
    assert worker.ask("pid") == worker.ask("pid") == worker.pid != os.getpid()


def test_what_is_reported_is_heard_before_the_answer(worker):
    heard = []
    assert worker.ask(("report", 5), heard=heard.append) == 6
    assert heard == [5]


def test_an_error_comes_instead_of_an_answer_and_the_worker_stays(worker):
    with pytest.raises(DeclarationError, match="this; expected that"):
        worker.ask("refuse")
    with pytest.raises(RuntimeError, match="IndexError: list index out of range"):
        worker.ask("fail")
    assert worker.ask("pid") == worker.pid


@pytest.mark.parametrize(
    ("question", "seconds"), [("compute for ever", 0.2), ("die", LONG), ("too much", LONG)]
)
def test_a_worker_that_ends_says_why(worker, question, seconds):
    with pytest.raises(WorkerEndedError) as caught:
        worker.ask(question, seconds)
    assert caught.value.out_of_time is (seconds < LONG)
    assert caught.value.was_ready
    assert not worker.is_open
    with pytest.raises(WorkerEndedError):
        worker.ask("pid")


def test_a_process_that_takes_no_processor_time_is_out_of_time_by_the_clock(worker):
    with pytest.raises(WorkerEndedError) as caught:
        worker.ask("stop", 0.05)
    assert caught.value.out_of_time


def test_a_worker_ended_from_outside_is_not_open(worker):
    worker.ask("pid")
    assert worker.is_open
    os.kill(worker.pid, signal.SIGKILL)
    until(lambda: not worker.is_open)


def test_ctrl_c_does_not_reach_a_worker(worker):
    worker.ask("pid")
    os.kill(worker.pid, signal.SIGINT)
    assert worker.ask(("double", 1)) == 2


def test_an_interruption_ends_the_worker(worker):
    def interrupted(said):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        worker.ask(("report", 1), heard=interrupted)
    assert not is_alive(worker.pid)


def test_a_setup_that_fails_is_reported():
    with closing(Worker(refusing)) as worker, pytest.raises(DeclarationError, match="this"):
        worker.ask("pid")
    with closing(Worker(not_starting)) as worker, pytest.raises(WorkerEndedError) as caught:
        worker.ask("pid")
    assert not caught.value.was_ready


# -- several ---------------------------------------------------------------------------------------


def test_tasks_are_shared_out_among_no_more_workers_than_asked_for():
    outcomes = all_of([("double", number) for number in range(20)])
    assert sorted(outcome.reply for outcome in outcomes) == list(range(0, 40, 2))
    assert all(outcome.reply == 2 * outcome.task[1] for outcome in outcomes)
    assert len({outcome.reply for outcome in all_of(["pid"] * 12)}) <= 2


def test_a_task_that_ends_its_worker_is_told_and_the_others_go_on():
    outcomes = {str(o.task): o for o in all_of(["die", "report and die", ("double", 4)], workers=1)}
    assert outcomes["('double', 4)"].reply == 8
    assert outcomes["report and die"].told == ("so far",)
    for name in ("die", "report and die"):
        assert outcomes[name].reply is None
        assert outcomes[name].lost is not None
        assert not outcomes[name].lost.out_of_time


def test_a_task_that_takes_too_long_is_told_and_the_others_go_on():
    slow, quick = all_of(["compute for ever", ("double", 4)], workers=1, seconds=1.0)
    assert slow.lost is not None
    assert slow.lost.out_of_time
    assert quick.reply == 8


def test_a_task_whose_worker_ended_is_begun_again(tmp_path):
    (outcome,) = all_of(["die once"], scratch=str(tmp_path), retries=1)
    assert outcome.reply == "alive"
    (outcome,) = all_of(["die"], retries=2)
    assert outcome.lost is not None


def test_an_error_of_a_task_ends_the_others():
    with pytest.raises(DeclarationError):
        all_of(["refuse", ("double", 1), ("double", 2)])


def test_workers_that_do_not_start_are_reported():
    with (
        pytest.raises(WorkerEndedError),
        closing(answers(partial(Worker, not_starting), 2, from_list("ab"))) as outcomes,
    ):
        next(outcomes)


def test_an_interruption_keeps_what_is_done_and_ends_the_workers():
    begun, done = [], []

    def begin():
        begun.append(Worker(doing))
        return begun[-1]

    def interrupted_after_one():
        tasks = from_list([("double", 1), "compute for ever", "compute for ever"])
        with closing(answers(begin, 2, tasks)) as outcomes:
            done.append(next(outcomes).reply)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted_after_one()
    assert done == [2]
    assert len(begun) == 2
    assert not any(is_alive(worker.pid) for worker in begun)


# -- the program that has workers ------------------------------------------------------------------


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="no /proc to look in")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_workers_end_with_the_program_that_has_them(tmp_path, number):
    program = [sys.executable, "-m", "base.worker_tasks", str(tmp_path)]
    path = os.pathsep.join(filter(None, [str(TESTS), os.environ.get("PYTHONPATH")]))
    started = subprocess.Popen(program, env={**os.environ, "PYTHONPATH": path})
    marks = [tmp_path / name for name in ("idle", "one", "other")]
    until(lambda: all(mark.exists() and mark.read_text() for mark in marks))
    pids = [int(mark.read_text()) for mark in marks]
    assert all(map(is_alive, pids))
    started.send_signal(number)
    started.wait()
    until(lambda: not any(map(is_alive, pids)))


def test_a_script_from_standard_input_needs_no_guard():
    script = (
        f"import sys; sys.path.insert(0, {str(TESTS)!r})\n"
        "from base.worker_tasks import all_of\n"
        "print([outcome.reply for outcome in all_of([('double', 21)])])\n"
    )
    run = subprocess.run([sys.executable, "-"], input=script, capture_output=True, text=True)
    assert (run.stdout, run.stderr) == ("[42]\n", "")


def test_what_a_script_defines_is_found_in_its_workers(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "from polhode.base import Worker\n"
        "def setup():\n"
        "    return lambda question, tell: question + 1\n"
        "if __name__ == '__main__':\n"
        "    print(Worker(setup).ask(41))\n"
    )
    run = subprocess.run([sys.executable, script], capture_output=True, text=True)
    assert (run.stdout, run.stderr) == ("42\n", "")


@pytest.mark.parametrize("start", STARTS, ids=lambda start: start.name.lower())
def test_nothing_of_the_current_folder_is_imported(tmp_path, start):
    """The folder may be one of submissions, in which someone has put a module of that name."""
    for name in ("multiprocessing", "signal", "pickle", "polhode", "json", "tempfile"):
        (tmp_path / f"{name}.py").write_text("open(f'ran {__name__}', 'w')\n")
    script = tmp_path / "script" / "main.py"
    script.parent.mkdir()
    script.write_text(
        "from functools import partial\n"
        "from base.worker_tasks import doing\n"
        "from polhode.base import StartMethod, Worker\n"
        "if __name__ == '__main__':\n"
        f"    worker = Worker(doing, StartMethod.{start.name})\n"
        "    print(worker.ask(('double', 3)))\n"
        "    worker.close()\n"
    )
    path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")]).rstrip(os.pathsep)
    words = [sys.executable, script]
    run = subprocess.run(
        words, cwd=tmp_path, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True
    )
    assert (run.stdout, run.stderr) == ("6\n", "")
    assert not list(tmp_path.glob("ran *"))
