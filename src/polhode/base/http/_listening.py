"""A socket to listen at."""

from __future__ import annotations

import socket
from collections.abc import Iterable

from polhode.base._errors import StoreError


def listening_socket(host: str, ports: Iterable[int]) -> socket.socket:
    """A socket bound to the first of these ports that is free; 0 is any free one.

    Raises:
        StoreError: where none is.
    """
    reason, port = "", 0
    for port in ports:
        listener = socket.socket()
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((host, port))
            return listener
        except OSError as error:
            listener.close()
            reason = error.strerror or str(error)
    where = "this machine" if host == "127.0.0.1" else host
    raise StoreError(
        f"port {port} of {where} ({reason})",
        expected="a free port",
        advice="choose another one, or leave it out",
        option="port",
    )
