"""The command line prints documents of schema 3; what was saved under schema 2 still opens."""

import gzip
import json
import tarfile
from pathlib import Path

import polhode as ph
from polhode.base import SCHEMA as SAVED
from polhode.cli._printing import SCHEMA as PRINTED
from polhode.cli._printing import document
from polhode.judge import read_document
from polhode.study._store import dataset

#: Written on 2026-11-28 by `polhode run spinning-coin --duration 0.05s --save coin.h5` and by
#: `polhode sweep spinning-coin --axis theta=40deg:80deg:2 --duration 0.05s --out sweep.zarr`.
OLD = Path(__file__).parents[1] / "data" / "schema-2"

CLAIMS = r"""schema = 2

[document]
title = "A coin"
source = "by hand"

[[part]]
id = "coin"
system = "spinning-coin"

[[claim]]
id = "psi"
part = "coin"
latex = 'P_\psi = I_3\omega_3'
"""


def test_the_command_line_has_a_schema_of_its_own() -> None:
    assert (PRINTED, SAVED) == (3, 2)
    assert json.loads(document({"schema": SAVED, "claims": []}))["schema"] == 3


def test_a_motion_saved_under_schema_2_opens(tmp_path: Path) -> None:
    path = tmp_path / "coin.h5"
    path.write_bytes(gzip.decompress((OLD / "coin.h5.gz").read_bytes()))
    run = ph.load(path)
    assert run.drift.energy < 1e-13
    assert abs(run.duration - 0.05) < 1e-12


def test_a_store_of_schema_2_opens(tmp_path: Path) -> None:
    with tarfile.open(OLD / "sweep.zarr.tar.gz") as archive:
        archive.extractall(tmp_path, filter="data")
    assert dataset(tmp_path / "s.zarr").sizes["theta"] == 2


def test_a_document_of_claims_of_schema_2_is_judged(tmp_path: Path) -> None:
    path = tmp_path / "claims.toml"
    path.write_text(CLAIMS, "utf-8")
    report = ph.audit(read_document(path))
    assert {answer: count for answer, count in report.counts.items() if count} == {"holds": 1}
