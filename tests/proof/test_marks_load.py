"""Answers sent to the service of marks, half of them mutants or garbage: none is lost.

With ``POLHODE_ANSWERS`` the number of answers is chosen; latencies and memory are told, not judged.
"""

import asyncio
import os
import random
import time
from collections import Counter
from pathlib import Path

from polhode.catalogue import CATALOGUE
from polhode.judge.service import ServiceSettings
from polhode.judge.service._answer import AnswerTask
from polhode.judge.service._pool import MarksPool

COUNT = int(os.environ.get("POLHODE_ANSWERS", "10000"))
AT_A_TIME = 4
SEED = 21
RIGHT = (
    (r"V = m g a \sin\theta", "V"),
    (r"T = \tfrac12 m v^2 + \tfrac12 I_1 (\omega_1^2+\omega_2^2) + \tfrac12 I_3\omega_3^2", "T"),
    (r"\omega_1 = \dot\theta", r"\omega_1"),
    (r"\omega_2 = \dot\phi\sin\theta", r"\omega_2"),
    (r"v^2 = a^2(\omega_1^2+\omega_3^2)", "v^2"),
    (r"\dot\omega_3 = \tfrac23\dot\theta\dot\phi\sin\theta", r"\dot\omega_3"),
    (r"I_3 = \tfrac12 m a^2", "I_3"),
)
SLIPS = ((r"\sin", r"\cos"), ("+", "-"), (r"\tfrac12", r"\tfrac13"), ("_1", "_3"), ("^2", "^3"))
GARBAGE = (
    "", "x", "I do not know", "$", "=", r"\frac{", r"V = \foo{bar}", "{" * 300, "1 = 1", r"V =",
    r"\text{<script>}", "V = V", "9" * 400 + "= V", r"\sum_{i=0}^\infty x_i = \int f", "\x00 = 1",
)  # fmt: skip


def drawn(seed):
    """An answer, what is asked for, and whether it is right."""
    draw = random.Random(f"{SEED} {seed}")
    text, asked = draw.choice(RIGHT)
    if draw.random() < 0.5:
        return text, asked, True
    if draw.random() < 0.3:
        return draw.choice(GARBAGE), asked, False
    before, after = draw.choice([slip for slip in SLIPS if slip[0] in text] or [("=", "= 2 +")])
    return text.replace(before, after, 1), asked, False


def memory(pids):
    """Bytes that the processes hold."""
    pages = (int(Path(f"/proc/{pid}/statm").read_text().split()[1]) for pid in pids)
    return sum(pages) * os.sysconf("SC_PAGE_SIZE")


async def campaign():
    pool = MarksPool(CATALOGUE["rolling-disk"].build(), ServiceSettings(waiting=COUNT))
    await pool.begin()
    waiting = iter(range(COUNT))
    seconds, found, held = [], Counter(), []

    async def platform():
        for number in waiting:
            text, asked, is_right = drawn(number)
            began = time.perf_counter()
            answer = await pool.marked(AnswerTask(text, asked))
            seconds.append(time.perf_counter() - began)
            kind = "lost" if answer.record.problem.startswith("it took") else "told"
            found[kind, is_right, answer.is_correct] += 1
            if number % max(COUNT // 10, 1) == 0:
                held.append(memory(pool.pids) / 2**20)

    await asyncio.gather(*(platform() for _ in range(AT_A_TIME)))
    pool.end()
    return seconds, found, held


def test_marks_under_load(ledger):
    seconds, found, held = asyncio.run(campaign())
    ledger.cases = len(seconds)
    warm = sorted(seconds[len(seconds) // 20 :])
    quantile = {q: warm[int(q * (len(warm) - 1))] for q in (0.5, 0.95, 0.99, 1.0)}
    told = ", ".join(f"{q:.0%} {value:.2f} s" for q, value in quantile.items())
    memory_told = ", ".join(str(round(m)) for m in held)
    # No answer is lost, no mutant and no garbage passes, and every right answer does.
    wrong = found["lost", True, False] + found["lost", False, False]
    wrong += found["told", False, True] + found["told", True, False]
    ledger.error(
        wrong / COUNT,
        0.0,
        1.0,
        f"answers lost or marked wrongly; {AT_A_TIME} at a time, warm: {told}; "
        f"memory of the workers on the way: {memory_told} MiB",
    )
    assert sum(found.values()) == COUNT
    assert not wrong, dict(found)
