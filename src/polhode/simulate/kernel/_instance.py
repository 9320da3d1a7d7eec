"""A WebAssembly module in memory: by wasmtime, or by the browser that Python itself runs in."""

from __future__ import annotations

import atexit
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any, Protocol

from polhode.base import cache as cache_on_disk
from polhode.simulate.kernel._assembly import PAGE
from polhode.simulate.kernel._steps import kernel_binary


class Instance(Protocol):
    """The kernel with a memory of its own."""

    def call(self, name: str, *given: int) -> Any:
        """Call an exported function."""

    def read(self, address: int, size: int) -> bytes:
        """Bytes of its memory."""

    def write(self, address: int, content: bytes) -> None:
        """Replace bytes of its memory."""


def instance(size: int) -> Instance:
    """The kernel with a memory of so many bytes.

    Raises:
        MemoryError: where there is no such memory.
    """
    if sys.platform == "emscripten":
        return _InBrowser(size)
    return _InWasmtime(size)


def _pages(size: int, there: int) -> int:
    """Pages by which a memory has to grow."""
    return max(0, -(-size // PAGE) - there)


# -- wasmtime -------------------------------------------------------------------------------------

_FOLDER = "kernel"


@cache
def _key() -> str:
    """Under which the kernel is kept: a digest of the code that makes it."""
    digest = blake2b(digest_size=20)
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


@cache
def _compiled(process: int) -> tuple[Any, Any]:
    """The kernel, compiled once for a process: the threads of an engine do not cross a fork."""
    import wasmtime

    config = wasmtime.Config()
    # By default every memory reserves gigabytes of the address space, which processes with a bound
    # on it do not have; the kernel's memory grows once, to a size that is known by then. The module
    # is small: threads would take longer to start than to compile it.
    config.parallel_compilation = False
    config.memory_reservation = 0
    config.memory_guard_size = 0
    config.memory_reservation_for_growth = 0
    engine = wasmtime.Engine(config)
    kept = cache_on_disk.read(_FOLDER, _key())
    if kept is not None:
        with suppress(wasmtime.WasmtimeError):  # not a module: made anew
            return engine, wasmtime.Module(engine, kept)
    binary = kernel_binary()
    cache_on_disk.write(_FOLDER, _key(), binary)
    return engine, wasmtime.Module(engine, binary)


# freed before the interpreter takes wasmtime apart, which would complain
atexit.register(_compiled.cache_clear)


class _InWasmtime:
    def __init__(self, size: int) -> None:
        import wasmtime

        engine, module = _compiled(os.getpid())
        self._store = wasmtime.Store(engine)
        exports = wasmtime.Instance(self._store, module, []).exports(self._store)
        memory: Any = exports["memory"]
        self._functions: Any = exports
        try:
            memory.grow(self._store, _pages(size, memory.size(self._store)))
        except wasmtime.WasmtimeError as error:
            raise MemoryError from error
        # A view of the memory is valid until it grows: it has its final size from here on.
        self._bytes = memoryview(memory.get_buffer_ptr(self._store)).cast("B")

    def call(self, name: str, *given: int) -> Any:
        return self._functions[name](self._store, *given)

    def read(self, address: int, size: int) -> bytes:
        return bytes(self._bytes[address : address + size])

    def write(self, address: int, content: bytes) -> None:
        self._bytes[address : address + len(content)] = content


# -- a browser, or Node ---------------------------------------------------------------------------


@cache
def _compiled_in_browser() -> Any:
    # modules of Pyodide, which is what Python in a browser is
    import js  # type: ignore[import-not-found]

    binary = kernel_binary()
    content = js.Uint8Array.new(len(binary))
    content.assign(binary)
    return js.WebAssembly.Module.new(content)


class _InBrowser:
    def __init__(self, size: int) -> None:
        import js
        from pyodide.ffi import JsException  # type: ignore[import-not-found]

        self._exports: Any = js.WebAssembly.Instance.new(_compiled_in_browser()).exports
        memory = self._exports.memory
        try:
            memory.grow(_pages(size, memory.buffer.byteLength // PAGE))
        except JsException as error:
            raise MemoryError from error
        self._view: Callable[[int, int], Any] = lambda address, size: js.Uint8Array.new(
            memory.buffer, address, size
        )

    def call(self, name: str, *given: int) -> Any:
        return getattr(self._exports, name)(*given)

    def read(self, address: int, size: int) -> bytes:
        found: bytes = self._view(address, size).to_bytes()
        return found

    def write(self, address: int, content: bytes) -> None:
        self._view(address, len(content)).assign(content)
