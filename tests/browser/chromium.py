"""A Chromium for the tests: the one of this machine, or the one that npm brings."""

from __future__ import annotations

import fcntl
import os
import re
import shutil
import subprocess
from pathlib import Path

HERE = Path(__file__).parent
INSTALLED = ("chromium", "chromium-browser", "google-chrome")
ARGUMENTS = (
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-gpu-rasterization",  # without a GPU, plots and text are drawn faster so
    "--disable-accelerated-2d-canvas",
    "--no-sandbox",
    "--lang=en-US",
)


class NoBrowserError(Exception):
    """No Chromium can be started; says what is lacking."""


def find_chromium() -> Path:
    """An executable Chromium.

    Raises:
        NoBrowserError: where there is none, or where a library it needs is not on this machine.
    """
    for name in INSTALLED:
        found = shutil.which(name)
        if found:
            return Path(found)
    return from_npm()


def from_npm() -> Path:
    """Chromium out of the npm package that the lock file beside this file names."""
    node = shutil.which("node")
    if not node or not (HERE / "node_modules").is_dir():
        raise NoBrowserError(
            f"no {', '.join(INSTALLED)} on this machine, and none from npm; expected either; "
            "install Node.js and run `make test`, which fetches one"
        )
    path = _unpacked(node)
    lacking = lacking_libraries(path)
    if lacking:
        raise NoBrowserError(
            f"{path} lacks {', '.join(lacking)}; expected these system libraries; "
            "install them (libnss3 and its kin) or a Chromium of the system"
        )
    return path


def _unpacked(node: str) -> Path:
    """Unpacked once, whichever of several workers comes first."""
    folder = HERE / "node_modules" / ".chromium"
    folder.mkdir(exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        unpacked = subprocess.run(
            [node, "unpack.mjs"],
            cwd=HERE,
            env={**os.environ, "TMPDIR": os.fspath(folder)},
            check=True,
            capture_output=True,
            text=True,
            timeout=600,
        )
    return Path(unpacked.stdout.strip())


def lacking_libraries(program: Path) -> list[str]:
    """Shared libraries that the loader does not find."""
    ldd = subprocess.run(
        ["ldd", os.fspath(program)], capture_output=True, text=True, check=False, timeout=600
    )
    return re.findall(r"(\S+) => not found", ldd.stdout)
