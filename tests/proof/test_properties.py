"""The property tests of the suite over many more examples: worlds, units, the algebra, documents.

Nothing is stated here that is not stated there; what is run is listed, with how often.
"""

import pytest

from algebra import test_calculus as calculus
from algebra import test_elimination as elimination
from algebra import test_expression as expressions
from algebra import test_functions as functions
from algebra import test_half_angles as half_angles
from algebra import test_layout as printing
from algebra import test_program as programs
from algebra import test_reading as reading
from algebra import test_sympy as sympy
from algebra import test_vector as vectors
from base import test_quantity as quantities
from base import test_units as units
from catalogue import test_symmetries as symmetries
from derive import test_descriptions as descriptions
from derive import test_worlds as worlds
from judge.source import test_damaged_documents as documents
from model import test_bodies as bodies
from model import test_frames as frames
from proof.ledger import Ledger
from proof.states import Comparison, Watched
from proof.widened import widened

#: How often the properties in each of these modules are tried.
EXAMPLES = {
    worlds: 150,
    symmetries: 400,
    bodies: 3000,
    frames: 1500,
    quantities: 3000,
    units: 3000,
    calculus: 1000,
    expressions: 1500,
    functions: 1500,
    half_angles: 1000,
    elimination: 800,
    printing: 1000,
    programs: 1000,
    reading: 3000,
    sympy: 800,
    vectors: 800,
    documents: 1000,
}


def properties() -> dict[str, object]:
    """Every test of these modules that draws its examples, by its name here."""
    return {
        f"{name}__{module.__name__.removeprefix(module.__package__ + '.test_')}": widened(test, n)
        for module, n in EXAMPLES.items()
        for name, test in vars(module).items()
        if name.startswith("test_") and hasattr(test, "hypothesis")
    }


globals().update(properties())


@pytest.mark.parametrize("name", descriptions.BODIES)
def test_angles_that_describe_the_attitude(name: str, ledger: Ledger, monkeypatch) -> None:
    moves_alike = descriptions.test_motion_does_not_depend_on_the_angles_that_describe_the_attitude
    body = {"pebble": descriptions.pebble, "rock": descriptions.rock}[name]
    body.cache_clear()
    comparison = Comparison(ledger)
    monkeypatch.setattr(descriptions, "Numeric", Watched)
    monkeypatch.setattr(descriptions, "agree", comparison.agree)
    comparison.system = body(descriptions.AIRCRAFT)
    ledger.part = name
    for seed in range(20_000, 22_000):
        comparison.place = f"seed {seed}"
        moves_alike(name, seed)
        ledger.cases += 1
