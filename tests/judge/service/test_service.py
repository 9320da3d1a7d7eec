"""The service as platforms see it: their JSON in, their JSON out, whatever stands in it."""

import asyncio
import base64
import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time

import jsonschema
import pytest
from starlette.testclient import TestClient

from polhode.catalogue import PROBLEM_SET
from polhode.judge import Hints
from polhode.judge.service import ServiceSettings
from polhode.judge.service._answer import AnswerTask
from polhode.judge.service._app import ServiceGuard, app_of
from polhode.judge.service._pool import TRIAL, MarksPool

SYSTEM = PROBLEM_SET["rolling-disk"].build()
SETTINGS = ServiceSettings(Hints.CORRECTION, workers=2, waiting=4, body=50_000, characters=20_000)

# What lambdafeedback's platform demands of replies (lambda-feedback/shimmy, runtime/schema), in
# words of our own: a result with the command, or an error with a message, and nothing else.
_ERROR = {"type": "object", "required": ["message"], "properties": {"message": {"type": "string"}}}


def reply_schema(command, required, properties):
    result = {"type": "object", "required": required, "properties": properties}
    return {
        "type": "object",
        "additionalProperties": False,
        "properties": {"command": {"const": command}, "result": result, "error": _ERROR},
        "oneOf": [{"required": ["command", "result"]}, {"required": ["error"]}],
    }


EVAL = reply_schema(
    "eval",
    ["is_correct"],
    {"is_correct": {"type": "boolean"}, "feedback": {"type": ["object", "array", "string"]}},
)
PREVIEW = reply_schema("preview", ["preview"], {"preview": {"not": {"type": "null"}}})
HEALTH = reply_schema(
    "healthcheck",
    ["tests_passed", "successes", "failures", "errors"],
    {"tests_passed": {"type": "boolean"}, "successes": {"type": "array"}},
)
#: "External grading" of PrairieLearn's documentation: score or gradable, and tests with points.
_TEST = {
    "type": "object",
    "required": ["name", "points", "max_points"],
    "properties": {
        "name": {"type": "string"},
        "message": {"type": "string"},
        "points": {"type": "number", "minimum": 0},
        "max_points": {"type": "number", "minimum": 0},
    },
}
RESULTS = {
    "type": "object",
    "properties": {
        "gradable": {"type": "boolean"},
        "score": {"type": "number", "minimum": 0, "maximum": 1},
        "message": {"type": "string"},
        "output": {"type": "string"},
        "tests": {"type": "array", "items": _TEST},
        "format_errors": {"type": ["string", "array"], "items": {"type": "string"}},
    },
    "if": {"properties": {"gradable": {"const": False}}, "required": ["gradable"]},
    "else": {"required": ["score"]},
}

T = r"T = \tfrac12 m v^2 + \tfrac12 I_1 (\omega_1^2+\omega_2^2) + \tfrac12 I_3\omega_3^2"


@pytest.fixture(scope="module")
def client():
    with TestClient(app_of(SYSTEM, SETTINGS)) as speaking:
        yield speaking


@pytest.fixture
def evaluated(client):
    """The result for an answer, as lambdafeedback asks for it."""

    def ask(response, answer="", **params):
        reply = client.post("/", json={"response": response, "answer": answer, "params": params})
        assert reply.status_code == 200, reply.text
        jsonschema.validate(reply.json(), EVAL)
        return reply.json()["result"]

    return ask


@pytest.fixture
def graded(client):
    """The results for a submission, as PrairieLearn asks for them."""

    def ask(submitted, **options):
        body = {"submitted_answers": submitted, "params": {"polhode": options}}
        reply = client.post("/", json=body)
        assert reply.status_code == 200, reply.text
        jsonschema.validate(reply.json(), RESULTS)
        return reply.json()

    return ask


# -- is it right? ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "response",
    [
        r"V = m g a \sin\theta",
        r"m g a \sin\theta",  # its right side alone
        r"mga\sin\theta = V",
        r"The height of the centre is $a\sin\theta$, hence $V = m g a \sin\theta$.",
        "$\\omega_1 = \\dot\\theta$\n\n$$V = a m g \\sin\\theta$$",
    ],
)
def test_a_right_answer(evaluated, response):
    found = evaluated(response, "V")
    assert found["is_correct"], found
    assert found["feedback"].startswith("Correct.")


@pytest.mark.parametrize(
    ("response", "says"),
    [
        (r"V = m g a \cos\theta", "line 1"),
        (r"m g a \cos\theta", "where sin is right"),
        (r"V = V", "no true line gives V"),
        (r"0 = 0", "Nothing in it could be judged"),
        (r"E = T + V", "no true line gives V"),
        (r"T = E - V", "no true line gives V"),
        (r"V = mgh", "no meaning"),
        (r"V =", "V"),
        (r"Assume $\theta = \pi/2$. Then $V = m g a$.", "only with what the answer itself assumes"),
        (r"$V = m g a \cos\theta$, that is, $V = m g a\sin\theta$.", "line 1"),
        ("I do not know", ""),
        ("", "no relation"),
    ],
)
def test_an_answer_that_is_not_right(evaluated, response, says):
    found = evaluated(response, "V")
    assert found["is_correct"] is False
    assert says in found["feedback"]


def test_a_trivial_truth_is_no_answer_where_letters_are_given(evaluated):
    letters = ["m", "a", "g", r"\theta"]
    assert evaluated(r"V = E - T", "V")["is_correct"]  # nothing forbids it
    found = evaluated(r"V = E - T", "V", letters=letters)
    assert not found["is_correct"]
    assert "line 1 gives V in letters that were not asked for: E, T" in found["feedback"]
    assert evaluated(r"V = m g a \sin\theta", r"V = \text{?}"[:1], letters=letters)["is_correct"]


def test_without_a_question_every_line_must_hold(evaluated):
    assert evaluated(rf"${T}$ and $\omega_1 = \dot\theta$")["is_correct"]
    assert not evaluated(rf"${T}$ and $\omega_1 = \dot\phi$")["is_correct"]
    assert not evaluated(rf"${T}$ and $\omega_1 = \Xi$")["is_correct"]
    assert not evaluated("only words")["is_correct"]


def test_what_the_problem_states_belongs_to_it(evaluated):
    given = r"Let $h = a\sin\theta$ be the height of the centre."
    found = evaluated(r"V = m g h", "V", given=given)
    assert found["is_correct"], found
    assert [line["line"] for line in found["lines"]] == [1]
    assert not evaluated(r"V = m g h", "V")["is_correct"]


def test_hints_are_those_of_the_teacher():
    with TestClient(app_of(SYSTEM, ServiceSettings(Hints.WHERE, workers=1))) as strict:
        body = {
            "response": r"V = m g a \cos\theta",
            "answer": "V",
            "params": {"hints": "correction"},
        }
        reply = strict.post("/", json=body).json()
        assert "line 1" in reply["result"]["feedback"]
        assert "sin" not in json.dumps(reply)
        assert reply["result"]["lines"][0]["correction"] is None


# -- the platforms ---------------------------------------------------------------------------------


def test_commands_of_lambdafeedback(client):
    reply = client.post("/", json={"response": r"\frac12 v"}, headers={"command": "preview"}).json()
    jsonschema.validate(reply, PREVIEW)
    assert r"\frac12 v" in reply["result"]["preview"]["latex"]
    reply = client.post("/", headers={"command": "healthcheck"}).json()
    jsonschema.validate(reply, HEALTH)
    assert reply["result"]["tests_passed"] is True
    reply = client.post("/", json={"response": "x"}, headers={"command": "chat"})
    jsonschema.validate(reply.json(), EVAL)
    assert reply.status_code == 400


def test_prairielearn_gives_points_for_lines(graded):
    found = graded({"derivation": r"$\omega_1 = \dot\theta$ and $\omega_2 = \dot\phi\cos\theta$"})
    assert found["gradable"] is True
    assert found["score"] == 0.5
    assert [test["points"] for test in found["tests"]] == [1, 0]
    assert "line 1" in found["message"]


def test_an_error_that_is_carried_forward_costs_once(graded):
    text = (
        "The potential energy is $V = mga\\cos\\theta$, hence\n\n"
        r"$\mathcal L = T - mga\cos\theta$."
    )
    found = graded({"derivation": text})
    assert [test["name"].split(": ")[1] for test in found["tests"]] == [
        "error",
        "follows from an error",
    ]
    assert [test["points"] for test in found["tests"]] == [0, 1]


def test_a_submission_that_cannot_be_read_costs_no_attempt(graded):
    for text in ("no formula", r"$\omega_1 = \Xi$", r"$\frac{1$"):
        found = graded({"derivation": text})
        assert found["gradable"] is False
        assert found["format_errors"]


def test_a_file_submitted_to_prairielearn(graded):
    contents = base64.b64encode(b"# Part\n\n$$V = m g a \\sin\\theta$$").decode()
    files = [{"name": "notes.md", "contents": contents}]
    assert graded({"_files": files}, asked="V")["score"] == 1.0
    assert graded({"_files": files, "x": "1"}, asked="V", answer_name="notes.md")["score"] == 1.0


def test_the_answer_asked_for_counts_half(graded):
    found = graded({"derivation": r"$\omega_1 = \dot\theta$"}, asked="V")
    assert found["score"] == 0.5
    assert found["tests"][-1]["name"] == "final answer"


def test_a_request_of_our_own(client):
    reply = client.post("/", json={"text": rf"${T}$", "asked": "T"}).json()
    assert reply["is_correct"] is True
    assert reply["lines"][0]["mark"] == "true"


# -- hostile requests ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "body",
    [
        b"", b"[]", b"null", b"{", b'{"response": 1, "answer": 2}', b'{"text": null}', b"\xff",
        b'{"text": "a", "text": "b"}', b'{"text": NaN}', b'{"response": {"a": 1}, "answer": "V"}',
        b'{"text": "a", "format": ".exe"}', b'{"text": "a", "letters": {"a": 1}}',
        b'{"text": "a", "asked": "\\\\frac{"}', b'{"response": "a", "answer": "V", "params": [1]}',
        b'{"submitted_answers": 1}', b'{"submitted_answers": {"_files": [1]}}',
        b'{"submitted_answers": {"_files": [{"name": "a.tex", "contents": "?"}]}}',
        b'{"submitted_answers": {}, "params": {"polhode": 3}}', b"[" * 20_000,
    ],
)  # fmt: skip
def test_bad_requests_are_refused_in_words(client, body):
    reply = client.post("/", content=body)
    assert reply.status_code in (200, 400), reply.text
    if reply.status_code == 400:
        jsonschema.validate(reply.json(), EVAL)
    else:
        assert not reply.json().get("is_correct", False)
        assert not reply.json().get("result", {}).get("is_correct", False)
    assert "Traceback" not in reply.text


def test_large_bodies_and_long_answers(client):
    assert client.post("/", content=b"x" * 60_000).status_code == 413
    assert client.post("/", json={"text": "x" * 30_000}).status_code == 400

    def of_no_stated_length():
        for _ in range(10):
            yield b"x" * 10_000

    assert client.post("/", content=of_no_stated_length()).status_code == 413


@pytest.mark.parametrize(
    "text",
    [
        "$" + "{" * 4000 + "x" + "}" * 4000 + " = 1$",
        "$" + "\\frac{1}{" * 500 + "x" + "}" * 500 + " = 1$",
        r"\newcommand{\a}{\a\a} $\a = 1$",
        r"\input{/etc/passwd} \include{../../secret} $1 = 1$",
        r"$\text{</script><script>alert(1)</script>} = 1$",
        "$x = " + "9" * 5000 + "$",
        r"$\theta^{\theta^{\theta^{9999999999}}} = 1$",
        r"$(1+\theta)^{100000} = 1$",
        "\x00\x1b[31m$a = b$\ud800".encode("utf-8", "replace").decode(),
        "import os; os.system('true')",
    ],
)
def test_hostile_answers_do_no_harm(client, text):
    for body in (
        {"text": text},
        {"response": text, "answer": "V"},
        {"submitted_answers": {"x": text}},
    ):
        reply = client.post("/", json=body)
        assert reply.status_code == 200, reply.text
        assert "<script" not in json.dumps(reply.json().get("result", {}).get("feedback", ""))
        assert not re.search(r"root:|\\u001b|\\u0000", reply.text)
    assert client.post("/", json={"response": r"V = mga\sin\theta", "answer": "V"}).json()[
        "result"
    ]["is_correct"]


def test_web_pages_may_not_ask(client):
    for headers in ({"origin": "http://evil.example"}, {"sec-fetch-site": "cross-site"}):
        reply = client.post("/", json={"text": "$1 = 1$"}, headers=headers)
        assert reply.status_code == 403


def test_other_paths_and_methods(client):
    assert client.get("/").status_code == 405
    assert client.get("/etc/passwd").status_code == 404
    assert client.get("/health").json()["status"] == "ok"


def test_a_key_is_asked_for_where_there_is_one():
    with TestClient(app_of(SYSTEM, ServiceSettings(workers=1, key="secret ü"))) as locked:
        assert locked.get("/health").status_code == 401
        wrong = {"authorization": "Bearer other"}
        assert locked.get("/health", headers=wrong).status_code == 401
        right = {"authorization": "Bearer secret ü".encode()}
        assert locked.get("/health", headers=right).status_code == 200


# -- limits ----------------------------------------------------------------------------------------


def test_an_answer_that_takes_too_long_ends_and_the_next_is_marked():
    settings = ServiceSettings(workers=1, seconds=1.0, characters=200_000, body=400_000)
    many = "\n\n".join(rf"$V = m g a \sin\theta + {n} - {n}$" for n in range(3000))
    with TestClient(app_of(SYSTEM, settings)) as service:
        reply = service.post("/", json={"text": many}).json()
        assert "more than the 1 s" in reply["message"]
        assert service.post("/", json={"text": r"$V = mga\sin\theta$"}).json()["is_correct"]


def test_more_answers_than_may_wait_are_turned_away():
    settings = ServiceSettings(workers=1, waiting=1, seconds=5.0, characters=200_000)
    many = "\n\n".join(rf"$V = m g a \sin\theta + {n} - {n}$" for n in range(60))
    with TestClient(app_of(SYSTEM, settings)) as service:
        found = []

        def ask():
            found.append(service.post("/", json={"text": many}).status_code)

        threads = [threading.Thread(target=ask) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert set(found) == {200, 503}
        assert service.get("/health").json()["waiting"] == 0


def test_a_killed_worker_is_replaced():
    async def marked():
        pool = MarksPool(SYSTEM, ServiceSettings(workers=1))
        pool.begin()
        (before,) = pool.pids
        os.kill(before, signal.SIGKILL)
        # Its end may be noticed only while it is asked; the next answer has a worker again.
        answers = [await pool.marked(TRIAL), await pool.marked(TRIAL)]
        after = pool.pids
        pool.end()
        return before, after, answers

    before, after, answers = asyncio.run(marked())
    assert after != [before]
    assert answers[-1].is_judged


def test_a_platform_that_hangs_up_leaves_the_worker_to_the_next():
    async def marked():
        pool = MarksPool(SYSTEM, ServiceSettings(workers=1, seconds=20.0))
        pool.begin()
        text = "\n\n".join(rf"$V = m g a \sin\theta + {n} - {n}$" for n in range(30))
        gone = asyncio.create_task(pool.marked(AnswerTask(text)))
        await asyncio.sleep(0.1)
        gone.cancel()
        answer = await pool.marked(TRIAL)
        pool.end()
        return answer

    assert asyncio.run(marked()).is_judged


# -- the command -----------------------------------------------------------------------------------


def test_the_command_serves_until_it_is_interrupted():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "polhode", "serve-marks", "--system", "rolling-disk"]
    command += ["--port", str(port), "--workers", "1"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as run:
        assert f"http://127.0.0.1:{port}/" in run.stdout.readline()
        body = json.dumps({"response": r"V = mga\sin\theta", "answer": "V"}).encode()
        request = b"POST / HTTP/1.1\r\nhost: x\r\nconnection: close\r\ncontent-length: %d\r\n\r\n%s"
        reply = b""
        for _ in range(600):
            try:
                with socket.create_connection(("127.0.0.1", port)) as line:
                    line.sendall(request % (len(body), body))
                    while part := line.recv(65536):
                        reply += part
                break
            except ConnectionError:
                time.sleep(0.1)
        assert b'"is_correct":true' in reply
        run.send_signal(signal.SIGINT)
        assert run.wait(60) == 0


@pytest.mark.parametrize(
    "wrong", [["--port", "70000"], ["--workers", "0"], ["--seconds", "nan"], ["--hints", "all"]]
)
def test_bad_options_exit_2(wrong):
    command = [sys.executable, "-m", "polhode", "serve-marks", "--system", "rolling-disk", *wrong]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "Traceback" not in done.stderr


def test_health_answers_while_slow_requests_fill_the_service():
    settings = ServiceSettings(workers=1, waiting=0, arriving=30.0)

    async def never():
        await asyncio.sleep(60)

    async def app(scope, receive, send):
        await send({"type": "reached", "path": scope["path"]})

    async def statuses():
        guard, sent = ServiceGuard(app, settings), []

        async def send(message):
            sent.append(message.get("status") or message.get("path"))

        def asking(method, path):
            scope = {"type": "http", "method": method, "path": path, "headers": []}
            return guard(scope, never, send)

        slow = [asyncio.create_task(asking("POST", "/")) for _ in range(2)]
        await asyncio.sleep(0)
        await asking("POST", "/")
        await asking("GET", "/health")
        for task in slow:
            task.cancel()
        return [each for each in sent if each]

    assert asyncio.run(statuses()) == [503, "/health"]


@pytest.mark.parametrize(
    ("response", "correct"),
    [
        (r"V - m g a \sin\theta = 0", True),
        (r"2 m g a \sin\theta = 2 V", True),
        (r"V/m = g a \sin\theta", True),
        (r"V^2 = m^2 g^2 a^2 \sin^2\theta", False),  # of which the sign is open
        (r"E = T + V", False),
        (r"V - m g a \cos\theta = 0", False),
        (r"V - V = 0", False),
    ],
)
def test_terms_may_be_moved_where_the_letters_are_given(evaluated, response, correct):
    """The centre of the disk is at the height a sin θ."""
    letters = ["m", "g", "a", r"\theta"]
    assert evaluated(response, "V", letters=letters)["is_correct"] is correct


def test_a_derivative_needs_no_letter_for_time(evaluated):
    letters = ["m", "a", r"\theta", r"\phi", r"\omega_3", r"\hat{\mathbf 1}"]
    letters += [r"\hat{\mathbf 2}", r"\hat{\mathbf 3}"]
    written = r"\frac{d\theta}{dt}\hat{\mathbf 1} + \frac{d\phi}{dt}\sin\theta\,\hat{\mathbf 2}"
    response = rf"\boldsymbol\omega = {written} + \omega_3\hat{{\mathbf 3}}"
    assert evaluated(response, r"\boldsymbol\omega", letters=letters)["is_correct"]
