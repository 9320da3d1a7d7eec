"""The force of a load has a letter of its own, also where a user defined the load."""

import pytest

import polhode as ph
from own_classes import planet


@pytest.fixture(scope="module")
def equations():
    return ph.derive(planet())


@pytest.mark.parametrize(
    ("claim", "answer"),
    [
        (r"\mathbf F_{\rm attraction} = -\frac{k\mathbf r}{|\mathbf r|^3}", "holds"),
        (r"\mathbf F_{\rm attraction} = \frac{k\mathbf r}{|\mathbf r|^3}", "fails"),
        (r"F_{{\rm attraction},x} = -\frac{kx}{(x^2+y^2+z^2)^{3/2}}", "holds"),
        (r"V = -\frac{k}{\sqrt{x^2+y^2+z^2}}", "holds"),
    ],
)
def test_a_load_that_a_user_defined(equations, claim, answer):
    assert ph.check(claim, equations).answer.value == answer


@pytest.mark.parametrize(("sign", "answer"), [("-", "holds"), ("", "fails")])
def test_a_spring_acts_on_the_body_named_first(sign, answer):
    m, k = ph.symbols("m k", positive=True)
    lab = ph.Frame("lab")
    block = ph.point_mass("block", mass=m, axes=lab)
    spring = ph.Spring(block.point(), lab.vector(0, 0, 0), stiffness=k)
    system = ph.System(ph.Pivot(block, only="y z"), spring)
    claim = rf"\mathbf F_{{\rm spring}} = {sign}k\mathbf r"
    assert ph.check(claim, ph.derive(system)).answer.value == answer
