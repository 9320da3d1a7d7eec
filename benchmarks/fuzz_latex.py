"""Look for text that makes the LaTeX reader fail, guided by the code it reaches (atheris).

Whatever comes, it must be read or refused with a ParseError, in a few seconds of processor time;
what is read must be written and read again as the same tree. The search starts from the displays of
the problem set and from the notations that the tests know; libFuzzer is given the macros as words.
It ends with libFuzzer's own account, and with exit code 0 if nothing was found. What a run comes
upon is kept in a folder, if one is named, so that the next begins where it ended; texts of one's
own can be put there beforehand.

    python benchmarks/fuzz_latex.py [SECONDS [FOLDER]]
"""

import signal
import sys
import tempfile
from pathlib import Path

import atheris

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))

with atheris.instrument_imports(include=["polhode.judge"]):
    from polhode.base import ParseError
    from polhode.judge.latex import _lexicon as lexicon
    from polhode.judge.latex import read_latex, write_latex
    from polhode.judge.latex._tree import Words, walk

from judge.latex.displays import DISPLAYS  # noqa: E402
from judge.latex.test_notations import NOTATIONS  # noqa: E402

MACROS = (
    lexicon.REWRITTEN
    | lexicon.SILENT
    | lexicon.SILENT_WITH_ARGUMENT
    | lexicon.OMITTED
    | lexicon.BRACES
    | lexicon.FRACTIONS
    | lexicon.DECORATIONS.keys()
    | lexicon.DERIVATIVES.keys()
    | lexicon.SUMS.keys()
    | lexicon.INTEGRALS.keys()
    | lexicon.SIGNS.keys()
    | lexicon.ARROWS.keys()
    | {f"begin{{{name}}}" for name in lexicon.STACKS | lexicon.CASES | lexicon.LAYOUTS}
    | {f"end{{{name}}}" for name in lexicon.STACKS | lexicon.CASES | lexicon.LAYOUTS}
    | {"SI", "qty", "num", "unit", "sqrt", "left(", "right)", "left.", "right|", "left\\\\{"}
)
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
    with tempfile.TemporaryDirectory() as folder:
        corpus = Path(sys.argv[2] if len(sys.argv) > 2 else folder, "corpus")
        corpus.mkdir(parents=True, exist_ok=True)
        for place, latex in enumerate([*DISPLAYS.values(), *NOTATIONS]):
            (corpus / str(place)).write_text(latex, "utf-8")
        words = Path(folder, "words")
        words.write_text("".join(f'"\\\\{macro}"\n' for macro in sorted(MACROS)), "utf-8")
        options = [f"-max_total_time={seconds}", f"-max_len={LONGEST}", f"-timeout={STUCK}"]
        options += [f"-dict={words}", str(corpus)]
        signal.signal(signal.SIGVTALRM, too_slow)
        atheris.Setup([sys.argv[0], *options], within_patience)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
