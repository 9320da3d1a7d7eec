"""Saved motions, altered thousands of times with a right checksum: each is refused, or a motion."""

import os
import random
import warnings
from pathlib import Path

from polhode.base import NumericError, PolhodeError, StoreError, within
from polhode.simulate import load
from proof.ledger import Ledger
from simulate.files.alterations import altered
from simulate.files.test_altered import pulled, rolled, used

COUNT = int(os.environ.get("POLHODE_ALTERATIONS", "3000"))
LOADING = 5.0  # s of computing that a file may take, unless that is allowed for
ALL = 20.0  # s for that and for all that is read from it: beyond, it hangs


def outcome(path: Path) -> str:
    """What becomes of a file, in a process that may be ended by it."""

    def judged(tell: object) -> str:
        warnings.simplefilter("ignore")
        try:
            used(load(path, seconds=LOADING))
        except StoreError:
            return "refused"
        except PolhodeError:
            return "read, and in parts without a value"
        except Exception as error:
            return f"{type(error).__name__}: {error}"
        return "read"

    try:
        return within(ALL, judged, advice="")
    except NumericError as error:
        return f"ended ({error})"


def test_saved_motions_altered_with_a_right_checksum(tmp_path: Path, ledger: Ledger) -> None:
    rng, path = random.Random(1), tmp_path / "motion.h5"
    files = []
    for run in (rolled(), pulled()):
        run.save(path)
        files.append(path.read_bytes())
    told: dict[str, int] = {}
    for number in range(COUNT):
        what, content = altered(rng, rng.choice(files))
        path.write_bytes(content)
        found = outcome(path)
        told[found] = told.get(found, 0) + 1
        if not found.startswith(("refused", "read")):
            ledger.failures.append(f"{number}, {what}: {found}")
    ledger.cases = COUNT
    ledger.part = ", ".join(f"{count} {found}" for found, count in sorted(told.items())[:3])
