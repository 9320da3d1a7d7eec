"""The published schema of `review --json`, and documents that have to obey it."""

import json
from pathlib import Path

import jsonschema
import pytest

from judge.review_schema import FILE, SCHEMA, written
from polhode.cli import main

EXAMPLES = FILE.parent / "examples" / "review"


def test_the_published_schema_is_that_of_the_code() -> None:
    assert FILE.read_text("utf-8") == written(), f"run {__package__}/review_schema.py"
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("hints", ["where", "correction"])
def test_documents_obey_it(hints: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Lines of every mark but one, in files with and without an error."""
    other = tmp_path / "other.md"
    other.write_text(r"So $I_3 = 1/2 m a^2$, $k = $ and $\alpha = %$. $v = a\omega_3$.", "utf-8")
    files = [EXAMPLES / "disk.tex", other]
    main(["review", *map(str, files), "--system", "rolling-disk", "--hints", hints, "--json"])
    document = json.loads(capsys.readouterr().out)
    jsonschema.validate(document, SCHEMA)
    marks = {line["mark"] for line in document["lines"]}
    assert {"true", "error", "follows", "not-judged"} <= marks
    assert any("read as" in (line["reason"] or "") for line in document["lines"])


def test_it_refuses_what_is_not_in_it() -> None:
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"lines": []}, SCHEMA)
