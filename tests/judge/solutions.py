"""A solution with every mark, its lines marked by hand and judged by `check`."""

from dataclasses import dataclass
from functools import cache

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.derive import derive
from polhode.judge import Answer, Correction, Mark, Review, ReviewedLine, Verdict, read_source

NAME = "disk.tex"
TEXT = r"""\documentclass{article}
\newcommand{\rate}[1]{\dot{#1}} % a time derivative
\begin{document}
\section*{Problem 2 (a): the rolling disk}
A thin disk of mass $m$ and radius $a$ rolls on a \emph{level} table, at \textbf{constant} energy.
Along its own axes, of which the third is its axis of symmetry,
\begin{align}
  \omega_1 &= \rate\theta, \\
  \omega_2 &= \rate\phi\cos\theta. \label{eq:second}
\end{align}
The moments of inertia are $I_1 = \tfrac14 m a^2$ and $I_3 = \tfrac12 m a^2$, so that
with~\eqref{eq:second}
\[ T = \tfrac12 m v^2 + \tfrac12 I_1
  (\dot\theta^2 + \dot\phi^2\cos^2\theta) + \tfrac12 I_3\omega_3^2 . \]
\begin{itemize}
  \item The potential energy is $V = m g a \sin\theta$;
  \item the energy is constant: $\dot E = 0$.
\end{itemize}

\subsection*{Part (b)}
For a small tilt, 5\% say, we drop the last term:
\[ V = m g l \sin\theta . \]
It rolls upright where
\[ \boxed{\omega_2^2 = \dot\phi^2 \sin^2\theta} \]
and $v = a \omega_3$ as well, or $v = 3 a \omega_3$.
\end{document}
"""


@dataclass(frozen=True)
class Marked:
    """What is said by hand of a line of the text."""

    mark: Mark
    of: int | None = None
    needs: str = ""
    context: str = "identity"
    is_final: bool = False


MARKS = (
    Marked(Mark.TRUE),
    Marked(Mark.ERROR),
    Marked(Mark.TRUE),
    Marked(Mark.TRUE),
    Marked(Mark.FOLLOWS, of=1),
    Marked(Mark.TRUE),
    Marked(Mark.TRUE, context="motion"),
    Marked(Mark.NOT_JUDGED, context=""),
    Marked(Mark.UNLINKED, of=1, is_final=True),
    Marked(Mark.NEEDS, needs=r"\omega_1 = 0"),
    Marked(Mark.DOUBT, context="motion"),
)


@cache
def equations():
    """Of a disk that rolls on a table."""
    return derive(PROBLEM_SET["rolling-disk"].build())


@cache
def solution() -> Review:
    """The solution with its marks, in order."""
    relations = read_source(TEXT, ".tex", NAME)
    lines = [_line(*pair) for pair in zip(relations, MARKS, strict=True)]
    return Review("rolling-disk", (NAME,), tuple(lines), 0.5, texts={NAME: TEXT})


def _line(found, marked) -> ReviewedLine:
    verdict = _judged(found.printed, marked.context)
    reason = verdict.reason if marked.mark is Mark.NOT_JUDGED else ""
    return ReviewedLine(
        found.file,
        found.line,
        found.column,
        found.latex,
        marked.mark,
        marked.of,
        marked.needs,
        marked.context,
        reason,
        "Problem 2 (a)",
        found.is_display,
        marked.is_final,
        verdict,
    )


@cache
def _judged(latex: str, context: str) -> Verdict:
    return ph.check(latex, equations(), context=context or "motion")


def hostile(text: str) -> Review:
    """A review in which every free text is this one."""
    verdict = Verdict(Answer.UNREAD, text, text, remarks=(text,), correction=Correction(text, text))
    lines = tuple(
        ReviewedLine(text, 1, 1, text, mark, 0, text, text, text, text, verdict=verdict)
        for mark in Mark
    )
    return Review(text, (text,), lines, notes=(text,), texts={text: text})
