"""All that the systems of the catalogue are declared with."""

from polhode.catalogue import CATALOGUE

PARTS = {
    f"{name}: {type(part).__name__}": part
    for name in sorted(CATALOGUE)
    for system in [CATALOGUE[name].build()]
    for part in (*system.bodies, *system.elements, *system.loads)
}
