"""Who follows a motion: within one contact mode as declared, or through all of them."""

from __future__ import annotations

from functools import lru_cache

from polhode.base import DeclarationError
from polhode.derive import Automaton, automaton
from polhode.model import System
from polhode.simulate._as_declared import AsDeclared
from polhode.simulate._dynamics import EquationsOfMotion
from polhode.simulate._memory import Same
from polhode.simulate._task import Prepared, Task, timed


def prepared(subject: System | Automaton | EquationsOfMotion, task: Task) -> Prepared:
    """All that does not depend on the numbers, done once for every motion of a kind.

    Raises:
        DeclarationError: for what has no equations of motion.
    """
    if isinstance(subject, System):
        subject = _modes(Same(subject))
    if isinstance(subject, Automaton):
        if subject.contacts:  # contacts are a room of their own: not entered where none is watched
            from polhode.simulate.contact._checks import can_be_followed
            from polhode.simulate.contact._through import ThroughModes

            if can_be_followed(subject):
                return ThroughModes(subject, task)
        with timed(task, "derive"):
            subject = subject.together.equations
    if not hasattr(subject, "kinematics"):
        raise DeclarationError(
            f"a motion of {subject!r}",
            expected="a System, its automaton, or equations derived from it",
            advice="put bodies, contacts and loads together in a System(...) first",
        )
    return AsDeclared(subject, task)


@lru_cache(maxsize=8)
def _modes(declared: Same[System]) -> Automaton:
    """The modes of a system, derived once however often it is simulated."""
    return automaton(declared.thing)
