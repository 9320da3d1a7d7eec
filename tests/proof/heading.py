"""What stands above the log of a campaign: when, of which commit, on which machine."""

import os
import platform
import subprocess
import sys
from datetime import UTC, datetime
from importlib.metadata import version

PACKAGES = ("polhode", "python-flint", "heyoka", "wasmtime", "numpy", "scipy", "hypothesis")


def commit() -> str:
    """The commit of the working tree, and whether files in it have been changed since."""
    described = subprocess.run(
        ["git", "describe", "--always", "--dirty", "--abbrev=12"],
        capture_output=True,
        text=True,
        check=True,
    )
    return described.stdout.strip()


def heading(campaign: str) -> str:
    """Title of a campaign with what a reader needs to repeat it."""
    cores = os.cpu_count()
    return "\n".join(
        [
            f"===== {campaign}",
            f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC, commit {commit()}",
            f"{platform.system()} {platform.machine()}, {cores} cores, "
            f"Python {platform.python_version()}",
            ", ".join(f"{name} {version(name)}" for name in PACKAGES),
            "",
        ]
    )


if __name__ == "__main__":
    print(heading(sys.argv[1]), flush=True)
