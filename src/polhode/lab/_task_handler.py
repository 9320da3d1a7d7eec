"""The tasks of a worker, which keeps the equations and compiled code of every system."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

from polhode.base import Progress
from polhode.lab._claims import answered, claims_about, judged
from polhode.lab._controls import with_usual_numbers
from polhode.lab._describe import (
    description_of,
    exported,
    picture_of,
    poses_of,
    speeds_at_ends,
    summary_of,
)
from polhode.lab._files import KINDS
from polhode.lab._offer import Own, entry_of
from polhode.lab._requests import CONTACTS, Fields, question_of, run_request, solution_of
from polhode.lab._reviews import reviewed
from polhode.lab._steady import SteadyFamily, families_of, invariants_of
from polhode.lab._system_session import SystemSession, VariantRun, variant
from polhode.view import Array, plain, single_precision

_WORD = 4  # bytes of a number (float32) in a packet, and of the length of its JSON, little-endian
_RUN_FIELDS = ("system", "contact", "settings", "start", "duration", "sheet")


class TaskHandler:
    """The tasks a worker can do.

    Args:
        own: the user's own system.
        progress: called at every step of a simulation.
    """

    def __init__(self, own: Own | None, progress: Progress) -> None:
        self._own = own
        self._progress = progress
        self._sessions: dict[str, SystemSession] = {}
        self._families: dict[tuple[str, str], list[SteadyFamily]] = {}
        self._invariants: dict[tuple[str, str], list[dict[str, Any]]] = {}

    def do(self, task: str, body: bytes) -> bytes:
        """The reply to a request: a JSON document, a packet with numbers, or a file.

        Raises:
            PolhodeError: for an invalid request.
        """
        return self._tasks[task](Fields.read(body))

    @cached_property
    def _tasks(self) -> Mapping[str, Callable[[Fields], bytes]]:
        return {
            "describe": self._describe,
            "run": self._run,
            "read": self._read,
            "follow": self._follow,
            "standing": self._standing,
            "claims": self._claims,
            "judge": self._judge,
            "check": self._check,
            "review": self._review,
            "export": self._export,
        }

    def _session(self, name: str) -> SystemSession:
        if name not in self._sessions:
            entry = entry_of(name, self._own)
            bare = variant(entry, "")
            self._sessions[name] = SystemSession(with_usual_numbers(entry, bare.equations))
        return self._sessions[name]

    def _motion(self, fields: Fields) -> VariantRun:
        request = run_request(fields.only(*_RUN_FIELDS))
        return self._session(request.system).simulate(request, self._progress)

    def _describe(self, fields: Fields) -> bytes:
        fields.only("system", "contact")
        session = self._session(fields.text("system"))
        chosen = session.variant(fields.one_of("contact", CONTACTS))
        return _json(description_of(chosen, session.variant("")))

    def _run(self, fields: Fields) -> bytes:
        motion = self._motion(fields)
        return packet(picture_of(motion.variant, motion.run))

    def _read(self, fields: Fields) -> bytes:
        motion = self._motion(fields)
        account = summary_of(motion.variant, motion.run)
        return packet({"account": account, "outcome": speeds_at_ends(motion.run)})

    def _follow(self, fields: Fields) -> bytes:
        return packet(poses_of(self._motion(fields).run))

    def _standing(self, fields: Fields) -> bytes:
        request = run_request(fields.only(*_RUN_FIELDS))
        session = self._session(request.system)
        chosen = session.variant(request.contact)
        key = (request.system, request.contact)
        if key not in self._families:
            self._families[key] = families_of(chosen.equations, chosen.system)
            self._invariants[key] = invariants_of(chosen.equations)
        numbers = session.numbers(request)
        state = {**numbers.parameters, **numbers.start}
        return _json(
            {
                "families": [family.standing(state) for family in self._families[key]],
                "invariants": self._invariants[key],
            }
        )

    def _claims(self, fields: Fields) -> bytes:
        return _json({"claims": claims_about(fields.only("system").text("system"))})

    def _judge(self, fields: Fields) -> bytes:
        return _json(judged(fields.only("system", "id").text("id")))

    def _check(self, fields: Fields) -> bytes:
        question = question_of(fields)
        equations = self._session(question.system).variant(question.contact).equations
        return _json(answered(question, equations))

    def _review(self, fields: Fields) -> bytes:
        solution = solution_of(fields)
        equations = self._session(solution.system).variant(solution.contact).equations
        return _json(reviewed(solution, equations))

    def _export(self, fields: Fields) -> bytes:
        fields.only(*_RUN_FIELDS, "kind")
        kind = fields.one_of("kind", tuple(KINDS))
        request = run_request(fields)
        return exported(kind, self._session(request.system).simulate(request, self._progress))


def _json(document: Mapping[str, Any]) -> bytes:
    return json.dumps(document, ensure_ascii=False, allow_nan=False).encode("utf-8")


# -- packets ---------------------------------------------------------------------------------------


def packet(document: Any) -> bytes:
    """The length of the JSON, the JSON, and the numbers of all its arrays one after the other.

    An array becomes {"shape": [...], "float32": [begin, end]}, its range among the numbers.
    """
    numbers = bytearray()

    def placed(values: Array) -> dict[str, list[int]]:
        begin = len(numbers) // _WORD
        numbers.extend(single_precision(values))
        return {"float32": [begin, len(numbers) // _WORD]}

    text = json.dumps(plain(document, placed), ensure_ascii=False, allow_nan=False).encode("utf-8")
    text += b" " * (-len(text) % _WORD)  # typed arrays in JavaScript must be aligned
    return len(text).to_bytes(_WORD, "little") + text + numbers
