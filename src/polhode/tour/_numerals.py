"""Small numbers as a text prints them."""

import re

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(value: float, unit: str = "") -> str:
    """Two digits and a power of ten, such as 1.4 × 10⁻¹⁷ m; plain 0 for zero."""
    shown = scientific(f"{value:.1e}") if value else "0"
    return f"{shown} {unit}".strip()


def scientific(text: str) -> str:
    """Text in which numbers such as 1.4e-17 are set as 1.4 × 10⁻¹⁷."""
    return re.sub(r"(?<=\d)e([-+]?\d+)\b", _power, text)


def _power(found: re.Match[str]) -> str:
    return f" × 10{str(int(found[1])).translate(_RAISED)}"
