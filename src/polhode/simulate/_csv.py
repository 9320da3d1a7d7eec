"""Tables of samples as text."""

from __future__ import annotations

import csv
import json
import os
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from polhode.base import StoreError, provenance
from polhode.simulate._integrators import Array


def write_csv(path: Path, columns: Mapping[str, Array], origin: Mapping[str, Any]) -> None:
    """Write columns of equal length under their names, to the last digit.

    The first line is a comment: # and a JSON document that says what the table was made with.

    Raises:
        StoreError: where the file cannot be written; what was there before is kept.
    """
    header = json.dumps({**provenance(), **origin}, sort_keys=True)
    part = None
    try:
        descriptor, part = tempfile.mkstemp(suffix=".part", dir=path.parent)
        with os.fdopen(descriptor, "w", encoding="utf-8", newline="") as stream:
            stream.write(f"# polhode {header}\n")
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows(np.array(list(columns.values())).T.tolist())
        os.replace(part, path)
    except OSError as error:
        raise StoreError(
            f"{path} cannot be written ({error.strerror})",
            expected="a file in a folder that exists and can be written",
        ) from error
    finally:
        if part is not None:
            with suppress(FileNotFoundError):
                os.unlink(part)
