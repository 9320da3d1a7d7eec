"""Hostile requests are refused or escaped, each in words, and the server stays up."""

import json
from itertools import count

import pytest
from starlette.testclient import TestClient

from lab.conftest import HERE, PORT, SMALL, opened
from polhode.lab._app import app_of
from polhode.lab._guard import Limits

JSON = {"content-type": "application/json"}
RUN = "/api/run"
DURATIONS = count(100)
SCRIPT = "</script><img src=x onerror=alert(1)>"


@pytest.fixture(autouse=True)
def stays_up(ask):
    """Whatever was asked, the next motion is computed."""
    yield
    duration = next(DURATIONS)  # a new one, as the last motion is kept
    answer = ask("run", system="gyroscope", duration=f"{duration} ms")
    assert answer.status_code == 200
    assert opened(answer)["duration"] == pytest.approx(duration / 1000)


def refused(response, *, status=(400, 422), says=""):
    assert response.status_code in status
    error = response.json()
    assert set(error) == {"given", "expected", "advice"}
    assert says in " ".join(error.values())
    assert "Traceback" not in response.text
    return error


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "https://127.0.0.1:8650", "http://127.0.0.1:9999"]
)
def test_foreign_origins(client, origin):
    body = {"system": "gyroscope"}
    refused(client.post(RUN, json=body, headers={"origin": origin}), status=[403], says="origin")
    refused(client.get("/", headers={"origin": origin}), status=[403], says="origin")


def test_own_origin_is_welcome(client):
    response = client.post(RUN, json={"system": "gyroscope"}, headers={"origin": HERE})
    assert response.status_code == 200


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8650", "127.0.0.1:80", "127.0.0.1.evil.example:8650", ""]
)
def test_foreign_hosts(client, host):
    refused(client.get("/", headers={"host": host}), status=[403], says="host")
    refused(client.post(RUN, json={}, headers={"host": host}), status=[403], says="host")


def test_requests_that_another_site_made_the_browser_send(client):
    headers = {"sec-fetch-site": "cross-site"}
    refused(client.get("/", headers=headers), status=[403], says="another site")


def test_forms_of_other_pages_cannot_post(client):
    response = client.post(
        RUN, content=b'{"system": "gyroscope"}', headers={"content-type": "text/plain"}
    )
    refused(response, status=[415], says="not JSON")


def test_huge_bodies(client):
    body = json.dumps({"system": "x" * (SMALL.body + 1)})
    refused(client.post(RUN, content=body, headers=JSON), status=[413], says="bytes")


def test_huge_bodies_of_unknown_length(client):
    def pieces():
        for _ in range(30):
            yield b"[" * 1000

    refused(client.post(RUN, content=pieces(), headers=JSON), status=[413], says="bytes")


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"[]",
        b'"gyroscope"',
        b"\xff\xfe",
        b"[" * 15_000,
        b'{"system": "gyroscope", "system": "rolling-disk"}',
        b'{"system": NaN}',
        b'{"system": ' + b"9" * 10_000 + b"}",
    ],
)
def test_malformed_json(client, body):
    refused(client.post(RUN, content=body, headers=JSON), status=[400])


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999", "1e5", "true", '"1"'])
def test_numbers_that_are_none(client, number):
    body = f'{{"system": "ball-on-paper", "sheet": [[0, 0, 0], [1, {number}, 0]]}}'
    refused(client.post(RUN, content=body.encode(), headers=JSON))


@pytest.mark.parametrize(
    "question",
    [
        {"start": {"theta": "nan"}},
        {"start": {"theta": "inf"}},
        {"start": {"theta": "1e400"}},
        {"start": {"theta": "80 lightyears"}},
        {"start": {"theta": "2 kg"}},
        {"start": {"nonsense": "1"}},
        {"settings": {"m": "-1 kg"}},
        {"settings": {"m": "9**9**9**9"}},
        {"settings": {"m": "__import__('os').system('true')"}},
        {"settings": {"m": "(" * 290}},
        {"settings": "m"},
        {"settings": {"m": 1}},
        {"settings": {f"m{i}": "1" for i in range(500)}},
        {"duration": "-1 s"},
        {"duration": "1e9 s"},
        {"contact": "velcro"},
        {"color": "blue"},
        {"sheet": [[0, 0, 0], [0, 0, 0]]},
        {"sheet": [[0, 0]] * 4},
        {"sheet": [[i, 0, 0] for i in range(1700)]},
        {"sheet": [[0, 0, 0], [1, 0, 0]]},
    ],
)
def test_values_that_cannot_be(ask, question):
    refused(ask("run", system="rolling-disk", **question))


def test_a_million_steps():
    """They are given up after the time that a motion may take, and the worker is free again."""
    start = {"theta": "80 deg", "omega_3": "9000000 rad/s", "phi_dot": "1 rad/s"}
    long = {"system": "rolling-disk", "start": start, "duration": "900 s"}
    with TestClient(app_of(PORT, limits=Limits(motion=2.0)), base_url=HERE) as client:
        client.post("/api/describe", json={"system": "rolling-disk"})
        refused(client.post(RUN, json=long), status=[503], says="takes longer than 2 s")
        described = client.post("/api/describe", json={"system": "rolling-disk"})
        assert described.status_code == 200


@pytest.mark.parametrize(
    "path",
    [
        "/../pyproject.toml",
        "/..%2f..%2fetc/passwd",
        "/%2e%2e/lab.js",
        "/built/page.js",
        "//etc/passwd",
        "/lab.js/..",
        "/api/../lab.js",
        "/api/eval",
        "/api/__class__",
        "/api/",
        "/lab.js%00.txt",
    ],
)
def test_paths_that_lead_elsewhere(client, path):
    response = client.post(path, json={"system": "gyroscope"})
    assert response.status_code in (404, 405)
    response = client.get(path)
    harmless = [client.get(own).content for own in ("/", "/lab.js")]  # where dots lead to these
    assert response.status_code in (404, 405) or response.content in harmless


@pytest.mark.parametrize(
    "system", ["../../etc/passwd", "x.py:y", SCRIPT, "gyroscope\x00", "", "é" * 200]
)
def test_systems_that_are_not_on_offer(ask, system):
    error = refused(ask("run", system=system))
    assert "rolling-disk" in error["expected"]


@pytest.mark.parametrize(
    "task", ["describe", "run", "read", "standing", "claims", "judge", "check", "review", "export"]
)
def test_script_in_names_stays_text(ask, task):
    response = ask(task, system="gyroscope", **{SCRIPT: SCRIPT})
    refused(response)
    assert response.headers["content-type"] == "application/json"
    assert response.headers["x-content-type-options"] == "nosniff"


def test_files_of_another_kind(ask):
    for kind in ("exe", "../x", "", SCRIPT):
        refused(ask("export", system="gyroscope", kind=kind))


@pytest.mark.parametrize(
    "latex",
    ["\\" * 3000, "{" * 3500, r"\def\x{\x\x}\x = 1", r"\input{/etc/passwd}", SCRIPT, "", "é"],
)
def test_latex_that_is_no_equation(ask, latex):
    response = ask("check", system="gyroscope", latex=latex)
    assert response.status_code == 200
    assert response.json()["verdict"] == "unread"
    assert "root:" not in response.text


def test_latex_without_end(ask):
    refused(ask("check", system="gyroscope", latex="x" * 5000), says="latex")


def test_other_methods(client):
    for method in ("PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"):
        assert client.request(method, RUN).status_code in (404, 405)


def test_every_answer_forbids_what_the_page_does_not_need(client, ask):
    for response in (client.get("/"), client.get("/lab.js"), ask("run", system="nothing")):
        policy = response.headers["content-security-policy"]
        assert policy.startswith("default-src 'none'; script-src 'self'; style-src 'self'; ")
        assert "unsafe" not in policy
        assert "http" not in policy
        assert response.headers["cache-control"] == "no-store"
