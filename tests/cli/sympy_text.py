"""SymPy's expressions out of the documents of the command line."""

import sympy


def from_srepr(text: str):
    """The expression of which `srepr` gives this text, with only the names of SymPy in reach."""
    return eval(text, {"__builtins__": {}}, vars(sympy))
