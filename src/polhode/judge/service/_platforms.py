"""Requests and replies of learning platforms, and of polhode's own kind.

Sources: the JSON schemas of lambdafeedback's evaluation functions (lambda-feedback/shimmy,
runtime/schema), and "External grading" in PrairieLearn's documentation.
"""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import PurePath
from typing import Any

from polhode.base import ParseError
from polhode.judge._reviewed import Mark
from polhode.judge.output._messages import TITLES
from polhode.judge.service._answer import AnswerTask, MarkedAnswer, as_document
from polhode.judge.service._settings import ServiceSettings

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")
_OPTIONS = ("asked", "given", "letters", "format")
_FORMATS = (".tex", ".md", ".ipynb", ".typ", ".rst", ".txt")
_BAD = ("error", "follows", "unlinked", "needs")
_GOOD = (Mark.TRUE.value, Mark.FOLLOWS.value)  # an error that is carried forward costs once


# -- requests --------------------------------------------------------------------------------------


def task_of(body: Mapping[str, Any], settings: ServiceSettings) -> AnswerTask:
    """The answer in a request of any of the three kinds, told apart by their members.

    Raises:
        ParseError: for a member that is missing, of the wrong type, or too long.
    """
    if "response" in body:
        options = _object(body.get("params"), "params")
        asked = _text(body.get("answer", ""), "answer", settings)
        return _task("response", body["response"], {"asked": asked, **_chosen(options)}, settings)
    if "submitted_answers" in body:
        options = _object(_object(body.get("params"), "params").get("polhode"), "params.polhode")
        text, format = _submitted(body, str(options.get("answer_name", "")), settings)
        return _task("submitted_answers", text, {"format": format, **_chosen(options)}, settings)
    if "text" in body:
        return _task("text", body["text"], _chosen(body), settings)
    raise ParseError(
        "a request without an answer", expected="one of response, submitted_answers and text in it"
    )


def _chosen(options: Mapping[str, Any]) -> dict[str, Any]:
    return {name: options[name] for name in _OPTIONS if options.get(name)}


def _task(
    name: str, text: Any, options: Mapping[str, Any], settings: ServiceSettings
) -> AnswerTask:
    letters = options.get("letters", [])
    if not isinstance(letters, list) or len(letters) > 100:
        raise ParseError("'letters' in the request", expected="a list of letters")
    format = _text(options.get("format", ".tex"), "format", settings)
    if format not in _FORMATS:
        raise ParseError("'format' in the request", expected=f"one of {', '.join(_FORMATS)}")
    return AnswerTask(
        _text(text, name, settings),
        _text(options.get("asked", ""), "asked", settings).strip(),
        _text(options.get("given", ""), "given", settings),
        tuple(_text(letter, "letters", settings) for letter in letters),
        format,
        settings.hints,
        0.0 if settings.hints.value == "where" else settings.correcting,
    )


def _submitted(body: Mapping[str, Any], name: str, settings: ServiceSettings) -> tuple[str, str]:
    """The text that a student submitted to PrairieLearn, in a field or as a file; its format."""
    answers = _object(body["submitted_answers"], "submitted_answers")
    files = answers.get("_files", [])
    texts = {key: value for key, value in answers.items() if isinstance(value, str)}
    if name in texts or (not files and len(texts) == 1):
        return texts[name] if name in texts else next(iter(texts.values())), ".tex"
    for file in files if isinstance(files, list) else []:
        found = _object(file, "_files")
        if not name or found.get("name") == name:
            return _decoded(found), PurePath(str(found.get("name", ""))).suffix or ".tex"
    raise ParseError(
        "a submission without the answer",
        expected=f"{name or 'one field'} in submitted_answers, or a file",
        advice="name it in params.polhode.answer_name",
    )


def _decoded(file: Mapping[str, Any]) -> str:
    try:
        return b64decode(str(file.get("contents", "")), validate=True).decode("utf-8-sig")
    except ValueError as error:
        raise ParseError("a file that is no text", expected="UTF-8 in Base64") from error


def _object(value: Any, name: str) -> Mapping[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise ParseError(f"{name!r} in the request", expected="a JSON object")
    return value


def _text(value: Any, name: str, settings: ServiceSettings) -> str:
    if isinstance(value, str) and len(value) <= settings.characters:
        return value
    what = f"of {len(value)} characters" if isinstance(value, str) else "that is no text"
    raise ParseError(
        f"{name!r} {what}", expected=f"a text of at most {settings.characters} characters"
    )


# -- replies ---------------------------------------------------------------------------------------


def reply_to(body: Mapping[str, Any], answer: MarkedAnswer) -> dict[str, Any]:
    """The reply to a request, in the JSON of its kind."""
    if "response" in body:
        return {"command": "eval", "result": _evaluated(answer)}
    if "submitted_answers" in body:
        return _graded(answer)
    return {
        "is_correct": answer.is_correct,
        "is_judged": answer.is_judged,
        "message": summary(answer),
        "lines": [_plain(line) for line in answer.record.lines],
    }


def previewed(body: Mapping[str, Any], settings: ServiceSettings) -> dict[str, Any]:
    """What the platform shows while a student types: the answer as LaTeX, not judged."""
    text = as_document(_text(body.get("response"), "response", settings))
    return {"command": "preview", "result": {"preview": {"latex": _clean(text)}}}


def _evaluated(answer: MarkedAnswer) -> dict[str, Any]:
    # Platforms show feedback as Markdown, in which HTML would stay HTML.
    told = [f"- line {line['line']}: {_message(line)}" for line in _worth_telling(answer)]
    feedback = escape("\n".join([summary(answer), *told]), quote=False)
    lines = [_plain(line) for line in answer.record.lines]
    return {
        "is_correct": answer.is_correct,
        "is_judged": answer.is_judged,
        "feedback": feedback,
        "lines": lines,
    }


def _graded(answer: MarkedAnswer) -> dict[str, Any]:
    """Results of PrairieLearn; an answer that only could not be read costs no attempt."""
    is_wrong = answer.asked or any(line["mark"] in _BAD for line in answer.record.lines)
    if not answer.is_judged or not (answer.is_correct or is_wrong):
        reasons = [f"line {line['line']}: {_message(line)}" for line in answer.record.lines]
        return {"gradable": False, "format_errors": [summary(answer), *reasons[:20]]}
    tests = [_test(line) for line in answer.record.lines if line["mark"] != "not-judged"]
    score = sum(test["points"] for test in tests) / len(tests)
    if answer.asked:
        # The answer asked for counts as much as the way there.
        why = _clean(answer.asked)
        tests.append(
            {"name": "final answer", "points": 0, "max_points": len(tests), "message": why}
        )
        score /= 2
    unread = [f"line {line['line']}: {_message(line)}" for line in _worth_telling(answer)]
    return {
        "gradable": True,
        "score": 1.0 if answer.is_correct else round(score, 4),
        "message": summary(answer),
        "output": "\n".join(unread),
        "tests": tests,
    }


def _test(line: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "name": f"line {line['line']}: {TITLES[Mark(line['mark'])]}",
        "points": int(line["mark"] in _GOOD),
        "max_points": 1,
        "message": _message(line),
    }


def summary(answer: MarkedAnswer) -> str:
    """What is said of the whole answer, in a sentence."""
    record = answer.record
    if record.problem:
        return _clean(f"Not judged: {record.problem}.")
    if answer.is_correct:
        return "Correct."
    wrong = [line["line"] for line in record.lines if line["mark"] == Mark.ERROR.value]
    if wrong:
        return f"The first error is in line {wrong[0]}."
    if not answer.is_judged:
        return "Nothing in it could be judged."
    if answer.asked:
        return _clean(f"Nothing in it is wrong by itself, but {answer.asked}.")
    return "Not all of it holds as it stands, or could be judged."


def _worth_telling(answer: MarkedAnswer) -> Iterator[Mapping[str, Any]]:
    return (line for line in answer.record.lines if line["mark"] != Mark.TRUE.value)


def _message(line: Mapping[str, Any]) -> str:
    return _clean(line["message"])


def _plain(line: Mapping[str, Any]) -> dict[str, Any]:
    names = ("line", "column", "mark", "of", "needs", "context", "correction", "message")
    return {name: line[name] for name in names}


def _clean(text: str) -> str:
    """Text without control characters, which some platforms take for colours."""
    return _CONTROL.sub("\ufffd", text)
