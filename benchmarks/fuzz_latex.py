"""Look for text that makes the LaTeX reader fail, guided by the code it reaches (atheris).

Whatever comes, it must be read or refused with a ParseError, in a few seconds of processor time;
what is read must be written and read again as the same tree. The search starts from the displays of
the problem set. It ends with libFuzzer's own account, and with exit code 0 if nothing was found.

    python benchmarks/fuzz_latex.py [SECONDS]
"""

import signal
import sys
import tempfile
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["polhode.claims"]):
    from polhode.base import ParseError
    from polhode.claims.latex import read_latex, write_latex
    from polhode.claims.latex._tree import Words, walk

DISPLAYS = Path(__file__).parents[1] / "tests" / "claims" / "latex" / "displays.txt"
LONGEST = 2000  # bytes
PATIENCE = 5.0  # s of processor time, whatever else the machine does
STUCK = 300  # s after which even what does not come back to Python is ended


def within_patience(data: bytes) -> None:
    """Read a text, and write what was read, in good time."""
    signal.setitimer(signal.ITIMER_VIRTUAL, PATIENCE)
    try:
        read_and_write(data)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)


def too_slow(*_: object) -> None:
    """Fail over the text at hand."""
    raise AssertionError(f"more than {PATIENCE:g} s of processor time")


def read_and_write(data: bytes) -> None:
    """Read a text, and write what was read."""
    try:
        statement = read_latex(data.decode("utf-8", errors="replace"))
    except ParseError:
        return
    if any(isinstance(piece, Words) for piece in walk(statement)):
        return
    for relation in statement.relations:
        if read_latex(write_latex(relation)).relations != (relation,):
            raise AssertionError(write_latex(relation))


def main() -> None:
    seconds = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    with tempfile.TemporaryDirectory() as corpus:
        for place, block in enumerate(DISPLAYS.read_text("utf-8").split("%% ")[1:]):
            Path(corpus, str(place)).write_text(block.split("\n", 1)[1], "utf-8")
        options = [f"-max_total_time={seconds}", f"-max_len={LONGEST}", f"-timeout={STUCK}", corpus]
        signal.signal(signal.SIGVTALRM, too_slow)
        atheris.Setup([sys.argv[0], *options], within_patience)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
