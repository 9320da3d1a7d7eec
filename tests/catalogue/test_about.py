"""What a run is said to be of, by the contacts that it has."""

import pytest

from polhode.catalogue import CATALOGUE, about_with, contact_numbers
from polhode.model import Contact, Coulomb, with_edge, with_friction

# A superball's impacts exclude friction, and those with friction as declared are as declared.
TOUCHING = [
    n
    for n, e in CATALOGUE.items()
    if n != "superball" and any(isinstance(c, Contact) for c in e.build().elements)
    if not any(isinstance(c, Coulomb) for c in e.build().elements)
]


@pytest.mark.parametrize("name", CATALOGUE)
def test_as_declared_the_words_of_the_entry(name: str) -> None:
    entry = CATALOGUE[name]
    assert about_with(entry, entry.build()) == entry.about


@pytest.mark.parametrize("name", TOUCHING)
def test_with_friction_it_is_not_said_to_roll_throughout(name: str) -> None:
    entry = CATALOGUE[name]
    about = about_with(entry, with_friction(entry.build(), 0.1))
    assert "μ = 0.1" in about
    assert entry.whatever_touches
    assert about.startswith(entry.whatever_touches)
    assert not any(words in about for words in ("without slipping", "throughout", "frictionless"))


def test_numbers_of_the_declaration() -> None:
    system = with_friction(with_edge(CATALOGUE["ball-on-paper"].build(), 0.4), 0.2, 0.25)
    assert contact_numbers(system) == {"mu": 0.2, "mu_static": 0.25, "edge": 0.4}
    assert contact_numbers(CATALOGUE["gyroscope"].build()) == {}
