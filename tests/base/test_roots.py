"""Changes of sign to the last bit."""

import math

from hypothesis import given
from hypothesis import strategies as st

from polhode.base import zero_between


@given(st.floats(-10, 10), st.floats(0.01, 5), st.floats(0.01, 5), st.booleans())
def test_the_sign_changes_between_neighbours(root, before, after, rises):
    sign = 1 if rises else -1

    def function(x):
        return sign * math.sinh(x - root)

    found = zero_between(function, root - before, root + after)
    assert abs(found - root) <= 2 * math.ulp(max(1.0, abs(root), before, after))


def test_a_zero_at_the_beginning_is_found_there():
    assert zero_between(lambda x: x - 1.0, 1.0, 2.0) == 1.0
