"""The JSON Schema of `review --json`, from the names in the code; run it to write the file anew."""

import json
from pathlib import Path
from typing import Any

from polhode.cli._printing import SCHEMA as VERSION
from polhode.judge import Mark
from polhode.judge.contexts._contexts import CONTEXTS

FILE = Path(__file__).parents[2] / "docs" / "review.schema.json"

TEXT = {"type": "string"}


def _or_null(schema: dict[str, Any], description: str) -> dict[str, Any]:
    return {"anyOf": [schema, {"type": "null"}], "description": description}


def _object(properties: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": list(properties),
        "additionalProperties": False,
        **more,
    }


LINE = _object(
    {
        "file": {**TEXT, "description": "by the name it was given or included under"},
        "line": {"type": "integer", "minimum": 1},
        "column": {"type": "integer", "minimum": 1},
        "latex": {**TEXT, "description": "what stands there, with the macros of its text"},
        "mark": {"enum": [mark.value for mark in Mark]},
        "first": {
            "type": "boolean",
            "description": "for error, whether it is the first one of its document",
        },
        "of": _or_null(
            {"type": "integer", "minimum": 0},
            "for follows and unlinked, the index of the wrong line that is meant; for a doubt "
            "that is drawn from another, that of the other",
        ),
        "needs": _or_null(TEXT, "for needs, the condition as LaTeX, or that a reading is missing"),
        "context": _or_null(
            {"enum": list(CONTEXTS)}, "in which it was judged; null where it was not"
        ),
        "readings": {
            "type": "array",
            "items": _object({"letter": TEXT, "meaning": TEXT}),
            "description": "the meanings that letters were given",
        },
        "correction": _or_null(
            _object({"what": TEXT, "latex": TEXT}), "for an error or a doubt, the smallest change"
        ),
        "counterexample": _or_null(
            _object(
                {
                    "values": {"type": "object", "additionalProperties": TEXT},
                    "left": TEXT,
                    "right": TEXT,
                }
            ),
            "a state at which both sides differ, exactly, in SI units",
        ),
        "reason": _or_null(TEXT, "how it was read, and why it has its mark"),
        "tried": {
            "type": "array",
            "items": TEXT,
            "description": "for a doubt, the hypotheses under which it fails too",
        },
    }
)

SCHEMA = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "polhode review --json",
    **_object(
        {
            "schema": {"const": VERSION},
            "versions": {"type": "object", "additionalProperties": TEXT},
            "seed": {"type": "null"},
            "system": TEXT,
            "lines": {"type": "array", "items": LINE},
            "summary": _object({mark.value: {"type": "integer", "minimum": 0} for mark in Mark}),
            "judged": {
                "type": "number",
                "minimum": 0,
                "maximum": 1,
                "description": "the share of the relations that are true, errors, or follow",
            },
            "final": _or_null(
                {"type": "integer", "minimum": 0}, "the index of the final answer among the lines"
            ),
            "notes": {"type": "array", "items": TEXT},
            "seconds": {"type": "number", "minimum": 0},
        }
    ),
}


def written() -> str:
    """The schema as its file has it."""
    return json.dumps(SCHEMA, indent=2) + "\n"


if __name__ == "__main__":
    FILE.write_text(written(), "utf-8")
