"""Worked solutions of the systems that the documents declare, against what is known of each."""

import runpy
from pathlib import Path

import pytest

import polhode as ph

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / "docs/examples/solutions").glob("*.py"))


@pytest.fixture(scope="module", params=FILES, ids=lambda file: file.stem)
def documented(request):
    system = runpy.run_path(str(request.param))[request.param.stem]
    return request.param.stem, ph.derive(system)


#: Results of textbooks, as claims about the declared systems.
KNOWN = {
    "spherical_pendulum": (r"\ddot\theta = \dot\phi^2\sin\theta\cos\theta + \frac gl\sin\theta",),
    "physical_pendulum": (r"\ddot\theta = -\frac{m g l}{I_2 + m l^2}\sin\theta",),
    "foucault_pendulum": (r"F_z = F_z",),
    "double_pendulum": (
        r"(m_1 + m_2)l_1\ddot\alpha + m_2 l_2(\ddot\beta\cos(\alpha - \beta)"
        r" + \dot\beta^2\sin(\alpha - \beta)) + (m_1 + m_2)g\sin\alpha = 0",
    ),
    "chaplygin_sleigh": (r"\dot v = a\omega^2", r"(I + m a^2)\dot\omega = -m a v\omega"),
    "sliding_ladder": (r"\ddot\theta = \frac{3g}{4l}\sin\theta",),
    "bead_on_hoop": (r"\ddot\theta = \Omega^2\sin\theta\cos\theta - \frac ga\sin\theta",),
    "two_wheeled_axle": (r"\ddot\phi = 0",),
    "ball_in_bowl": (
        r"\frac75\left(\ddot\theta - \dot\phi^2\sin\theta\cos\theta\right) = "
        r"-\frac{g\sin\theta}{R - a} - \frac25\frac{a}{R - a}\omega_3\dot\phi\sin\theta",
    ),
}
