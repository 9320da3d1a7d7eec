"""The lab's server, spoken to without a network."""

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
