"""Serving the lab on this machine, and opening it in the browser."""

from __future__ import annotations

import threading
import webbrowser
from contextlib import closing

from polhode.base import extra
from polhode.base.http import listening_socket
from polhode.lab._offer import Own

HOST = "127.0.0.1"
PORT = 8650
_MOST = 64  # connections at a time


def serve(own: Own | None = None, *, port: int | None = None, browser: bool = True) -> None:
    """Serve the lab until it is interrupted; it is reachable from this machine only.

    Args:
        own: the user's own system, offered first.
        port: to listen at; by default 8650, or any free one if that is taken.
        browser: whether to open it in the browser.

    Raises:
        StoreError: if the packages that the lab needs are not installed, or the port is taken.
    """
    with extra("uvicorn or starlette", "lab"):
        from polhode.base.http_server import serve_application
        from polhode.lab._app import app_of
    ports = [PORT, 0] if port is None else [port]
    with closing(listening_socket(HOST, ports)) as listener:
        listener.listen(_MOST)
        chosen = listener.getsockname()[1]
        address = f"http://{HOST}:{chosen}/"
        print(f"The lab is at {address} (Ctrl-C ends it)", flush=True)
        if browser:
            threading.Timer(0.5, webbrowser.open, [address]).start()
        serve_application(app_of(chosen, own), listener, _MOST)
