"""The shapes of the documents that scripts rely on, and a check that a document has one.

A shape is a type, a list of one shape, a dict of shapes by key, or a dict `{str: shape}` for any
keys. Documents may hold more than their shape tells.
"""

from collections.abc import Iterator

EXPRESSION = {"latex": str, "sympy": str}
EVENT = {"time": float, "kind": str, "from": (str, type(None)), "to": (str, type(None))}
PARAMETER = {"name": str, "unit": str, "default": str, "meaning": str}
LISTED = {
    "name": str,
    "title": str,
    "coordinates": [str],
    "speeds": [str],
    "reactions": [str],
    "parameters": [PARAMETER],
}
MADE_WITH = {"schema": int, "versions": {"polhode": str, "python": str}, "seed": type(None)}

LIST = MADE_WITH | {"systems": [LISTED]}
DERIVE = MADE_WITH | {
    "system": str,
    "coordinates": [str],
    "speeds": [str],
    "motion": [EXPRESSION],
    "reactions": {str: EXPRESSION},
    "lengths": {str: EXPRESSION},
    "seconds": float,
}
RUN = MADE_WITH | {
    "system": str,
    "duration": float,
    "final": {str: (float, str), "mode": str},
    "drift": {"energy": float, "constraint": float, "invariants": {str: float}},
    "events": [EVENT],
    "files": [str],
    "seconds": {"derive": float, "compile": float, "integrate": float},
    "assumed": {str: float},
    "parameters": {str: float},
}


def misshapen(value, shape, place="document") -> Iterator[str]:
    """Everything in which a value differs from its shape."""
    match shape:
        case dict():
            yield from _misshapen_object(value, shape, place)
        case [inner]:
            if not isinstance(value, list):
                yield f"{place} is no list"
                return
            for position, item in enumerate(value):
                yield from misshapen(item, inner, f"{place}[{position}]")
        case _:
            if not isinstance(value, shape):
                yield f"{place} = {value!r} is no {shape}"


def _misshapen_object(value, shape, place) -> Iterator[str]:
    if not isinstance(value, dict):
        yield f"{place} is no object"
        return
    for key in shape.keys() - {str} - value.keys():
        yield f"{place} has no {key}"
    for key, item in value.items():
        if key in shape or str in shape:
            yield from misshapen(item, shape.get(key, shape.get(str)), f"{place}.{key}")
