"""Serving marks until the process is interrupted."""

from __future__ import annotations

from contextlib import closing

from polhode.base import DeclarationError
from polhode.base.http import listening_socket
from polhode.derive import derive
from polhode.judge.service._settings import ServiceSettings
from polhode.model import System

HOST = "127.0.0.1"
PORT = 8651
_BACKLOG = 128  # connections that wait to be accepted
_MOST = 512  # connections at a time


def serve_marks(
    system: System,
    settings: ServiceSettings | None = None,
    *,
    host: str = HOST,
    port: int | None = None,
) -> None:
    """Serve marks for answers about a system until the process is interrupted.

    Args:
        system: that every answer is about.
        settings: limits, and how much is shown.
        host: address to listen at; by default this machine alone can reach it.
        port: to listen at; by default 8651.

    Raises:
        DeclarationError: if the packages that a server needs are not installed.
        NumericError: for a system that cannot be derived.
        StoreError: if the port is taken.
    """
    try:
        from polhode.base.http_server import serve_application
        from polhode.judge.service._app import app_of
    except ModuleNotFoundError as error:
        raise DeclarationError(
            f"a server of marks without {error.name}",
            expected="its packages to be installed",
            advice="pip install 'polhode[lab]'",
        ) from error
    derive(system)  # so that what is wrong with it is said here, and not by every worker
    with closing(listening_socket(host, [PORT if port is None else port])) as listener:
        listener.listen(_BACKLOG)
        chosen = listener.getsockname()[1]
        print(
            f"Marks for {system.name} are served at http://{host}:{chosen}/ (Ctrl-C ends it)",
            flush=True,
        )
        serve_application(app_of(system, settings), listener, _MOST)
