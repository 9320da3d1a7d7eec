"""The lab's server, spoken to without a network."""

import json

import numpy as np
import pytest
from starlette.testclient import TestClient

from polhode.lab._app import app_of
from polhode.lab._guard import Limits

PORT = 8650
HERE = f"http://127.0.0.1:{PORT}"
SMALL = Limits(body=20_000, motion=100.0, thought=100.0, waiting=4)


@pytest.fixture(scope="session")
def client():
    """A server that takes little at a time, with its workers."""
    with TestClient(app_of(PORT, limits=SMALL), base_url=HERE) as speaking:
        yield speaking


@pytest.fixture(scope="session")
def ask(client):
    """Asks for a task with a JSON object; the response."""

    def asked(task, /, **question):
        return client.post(f"/api/{task}", json=question)

    return asked


def opened(response):
    """What a packet tells, every array with its numbers."""
    assert response.status_code == 200, response.text
    assert response.headers["content-type"] == "application/octet-stream"
    length = 4 + int.from_bytes(response.content[:4], "little")
    numbers = np.frombuffer(response.content, "<f4", offset=length)

    def filled(found):
        if "float32" in found:
            begin, end = found["float32"]
            return numbers[begin:end].reshape(found["shape"])
        return found

    return json.loads(response.content[4:length], object_hook=filled, parse_constant=pytest.fail)
