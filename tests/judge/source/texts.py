"""Texts about a heavy top in every format, for the tests of reading documents."""

import json

TEX = r"""\documentclass{article}
\newcommand{\om}{\boldsymbol{\omega}}
\newcommand{\rate}[2][t]{\frac{d #2}{d #1}}   % optional argument
\def\half{\tfrac12}
\def\sq#1{#1^2}
\let\angle\theta
\DeclareMathOperator{\sech}{sech}
\newcommand{\beq}{\begin{equation}}
\newcommand{\eeq}{\end{equation}}
\newenvironment{law}{\begin{equation}}{\end{equation}}
\begin{document}
\section{A heavy top}
The rate is $\rate{\mathbf L} = \boldsymbol\tau$, and $\angle$ is the tilt; it costs \$5.
% a comment with $a = b$
\begin{verbatim}
$c = d$
\end{verbatim}
\begin{align}
  T &= \half I_1 \sq{\dot\angle} \label{eq:T} \\
  V &= M g l \cos\angle,
\end{align}
\beq E = T + V \eeq
\begin{law} \om = \omega_3 \hat{\mathbf 3} \end{law}
\[ I_3 \omega_3
   = L_3 \]
\end{document}
"""

MARKDOWN = r"""# A heavy top

The torque is $\tau = M g l \sin\theta$, `code $a = b$` is code, and \\( p = L_z \\) as well.

```python
x = "$a = b$"
```

$$
\dot\phi = \frac{M g l}{I_3 \omega_3}
$$

\\[ E = T + V \\]
"""

NOTEBOOK = json.dumps(
    {
        "cells": [
            {"cell_type": "markdown", "source": ["$\\newcommand{\\w}{\\omega}$ é 🜚\n", "text"]},
            {"cell_type": "code", "source": ["y = '$a = b$'"]},
            {"cell_type": "markdown", "source": ["Then\n", "$$ L_3 = I_3 \\w_3 $$\n"]},
            {"cell_type": "markdown", "source": "one string with $p = q$"},
        ],
        "nbformat": 4,
    },
    indent=1,
)

RESTRUCTURED = r"""
A heavy top
===========

The torque is :math:`\tau = M g l \sin\theta`.

.. math::
   :label: energy

   E = T + V

   L_3 = I_3 \omega_3

.. code:: python

   x = ":math:`a = b`"

As follows::

   :math:`c = d`

.. math:: p = L_z
"""

LEAN = r"""/-! The torque is $\tau = M g l \sin\theta$. -/
def f := g $ h = k $ 3  -- and $p = L_z$
"""

TEXTS = {
    ".tex": TEX,
    ".md": MARKDOWN,
    ".ipynb": NOTEBOOK,
    ".rst": RESTRUCTURED,
    ".lean": LEAN,
}
