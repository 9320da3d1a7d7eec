import io

from polhode.base import SilentProgress, terminal_progress
from polhode.base._progress import TerminalProgress


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def work(progress):
    progress.begin("deriving", 3)
    progress.advance()
    progress.advance(2)
    progress.finish()


def test_a_terminal_sees_one_line_and_is_left_clean(monkeypatch):
    monkeypatch.setattr(TerminalProgress, "_INTERVAL", 0.0)
    terminal = Terminal()
    work(terminal_progress(terminal))
    lines = terminal.getvalue().split("\r\x1b[K")
    assert lines == ["", "deriving 0/3", "deriving 1/3", "deriving 3/3", ""]


def test_steps_that_come_too_fast_to_read_are_not_shown(monkeypatch):
    monkeypatch.setattr(TerminalProgress, "_INTERVAL", 3600.0)
    terminal = Terminal()
    work(terminal_progress(terminal))
    assert terminal.getvalue().split("\r\x1b[K") == ["", "deriving 0/3", ""]


def test_a_total_that_is_not_known_is_not_shown():
    terminal = Terminal()
    terminal_progress(terminal).begin("searching")
    assert terminal.getvalue().endswith("searching 0")


def test_a_pipe_sees_nothing():
    pipe = io.StringIO()
    work(terminal_progress(pipe))
    assert pipe.getvalue() == ""


def test_it_is_standard_error_that_is_used(capsys):
    assert isinstance(terminal_progress(), SilentProgress)
    work(terminal_progress())
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ("", "")
