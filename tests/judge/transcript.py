"""Proof that the problem set's document quotes the transcript byte for byte.

`transcript.sha256` holds the digest of every quoted formula, made from the transcript itself by

    python tests/judge/transcript.py FOLDER_OF_THE_TRANSCRIPT

which refuses a formula that does not occur there. Its first line is the digest of the transcript.
"""

import sys
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

from polhode.catalogue import problem_set
from polhode.judge.document._document import Document
from polhode.judge.document._read_document import read_document

PROOF = Path(__file__).with_name("transcript.sha256")
#: Where a checkout may have the transcript beside it.
NEARBY = Path(__file__).parents[3] / "shared" / "problem-set"


def document() -> Document:
    return read_document(problem_set())


def digest(text: str) -> str:
    return sha256(text.encode("utf-8")).hexdigest()


def quoted() -> dict[str, str]:
    """Every formula that the document says is printed, by the id of its claim."""
    return {claim.id: claim.latex for claim in document().claims if claim.latex}


def transcript(folder: Path) -> str | None:
    """The text of the transcript, if the folder has it."""
    files = sorted(folder.glob("*.txt")) if folder.is_dir() else []
    return "".join(path.read_bytes().decode("utf-8") for path in files) or None


def proof(text: str) -> Iterator[str]:
    """Digests of the transcript and of every formula found in it."""
    yield f"{digest(text)}  transcript"
    for name, latex in quoted().items():
        if latex not in text:
            sys.exit(f"the formula of claim {name} does not occur in the transcript")
        yield f"{digest(latex)}  {name}"


def proven() -> dict[str, str]:
    """The digests on file, by claim."""
    lines = PROOF.read_text("utf-8").splitlines()
    return {name: found for found, name in (line.split("  ") for line in lines)}


if __name__ == "__main__":
    source = transcript(Path(sys.argv[1]))
    if source is None:
        sys.exit(f"no transcript in {sys.argv[1]}")
    PROOF.write_text("\n".join(proof(source)) + "\n", "utf-8")
