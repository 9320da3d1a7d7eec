import json

import pytest

from polhode.cli import main


@pytest.fixture(autouse=True)
def _no_traceback(monkeypatch):
    monkeypatch.delenv("POLHODE_DEBUG", raising=False)


@pytest.fixture
def polhode(capsys):
    """Runs a command in this process; returns its exit code, output and error output."""

    def run(*words):
        code = main(words)
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return run


@pytest.fixture
def document(polhode):
    """Runs a command with --json; returns its document."""

    def run(*words):
        code, out, err = polhode(*words, "--json")
        assert (code, err) == (0, "")
        return json.loads(out)

    return run
