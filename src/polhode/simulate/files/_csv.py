"""Tables of samples as text."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from polhode.base import provenance, write_whole
from polhode.simulate.integrate._stepping import Array


def write_csv(path: Path, columns: Mapping[str, Array], origin: Mapping[str, Any]) -> None:
    """Write columns of equal length under their names, to the last digit.

    The first line is a comment: # and a JSON document that says what the table was made with.

    Raises:
        StoreError: where the file cannot be written; what was there before is kept.
    """
    header = json.dumps({**provenance(), **origin}, sort_keys=True)
    stream = io.StringIO(newline="")
    stream.write(f"# polhode {header}\n")
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(np.array(list(columns.values())).T.tolist())
    write_whole(path, stream.getvalue().encode())
