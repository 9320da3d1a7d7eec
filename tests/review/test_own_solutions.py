"""No line of a solution that polhode writes itself is doubted; the campaign takes them all."""

import pytest

from review.own_solutions import doubted


@pytest.mark.parametrize(
    ("name", "format"),
    [("marble-on-turntable", ".tex"), ("gyrocompass", ".md"), ("ball-on-paper", ".tex")],
)
def test_no_line_is_doubted(name: str, format: str) -> None:
    assert doubted(name, format) == []
