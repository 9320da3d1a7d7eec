"""Very small numbers as a text prints them."""

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(value: float, unit: str = "", digits: int = 2) -> str:
    """A few digits and a power of ten, such as 1.4 × 10⁻¹⁷ m; plain 0 for zero."""
    if not value:
        return f"0 {unit}".strip()
    leading, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    return f"{leading} × 10{str(int(exponent)).translate(_RAISED)} {unit}".strip()
