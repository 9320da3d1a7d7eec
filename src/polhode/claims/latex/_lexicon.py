"""The words of LaTeX that mechanics texts use, and what each is read as."""


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


def _pairs(text: str) -> dict[str, str]:
    """Each spelling with what it is read as, from words that alternate."""
    words = text.split()
    return dict(zip(words[::2], words[1::2], strict=True))


def _same(words: frozenset[str]) -> dict[str, str]:
    return {word: word for word in words}


GREEK = _words(
    """
    alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma
    tau upsilon phi chi psi omega varepsilon vartheta varkappa varpi varrho varsigma varphi
    Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega
    """
)
LETTERS = _same(GREEK | _words("ell hbar infty partial degree")) | _pairs("imath i jmath j")
LABELS = _pairs("perp perp bot perp parallel parallel")
WORDS_IN_LABELS = _pairs("max max min min")

FUNCTIONS = _same(
    _words(
        """
        sin cos tan sec csc cot arcsin arccos arctan sinh cosh tanh sech csch coth
        arsinh arcosh artanh exp ln log
        """
    )
) | _pairs(
    """
    cosec csc cotan cot tg tan ctg cot asin arcsin acos arccos atan arctan arcsinh arsinh
    arccosh arcosh arctanh artanh asinh arsinh acosh arcosh atanh artanh
    """
)
COUNTS = _words("n k pi")  # letters that stand before an angle: sin nθ
RATES = _words("omega Omega nu kappa")  # and, with the Latin ones, before a time: cos Ωt
INVERSES = _pairs("sin arcsin cos arccos tan arctan sinh arsinh cosh arcosh tanh artanh")

SIGNS = _pairs(
    """
    approx ≈ simeq ≈ cong ≈ doteq ≈ sim ≈ equiv ≡ ne ≠ neq ≠ lt < gt > le ≤ leq ≤ leqslant ≤
    ge ≥ geq ≥ geqslant ≥ ll ≪ gg ≫ propto ∝ to → rightarrow → longrightarrow → leftrightarrow ↔
    """
)
ARROWS = _pairs(
    """
    Rightarrow ⇒ Longrightarrow ⇒ implies ⇒ Leftrightarrow ⇔ Longleftrightarrow ⇔ iff ⇔
    therefore ∴
    """
)
MARKS = _pairs(
    r"""
    pm ± mp ∓ times × cross × cdot · bullet · ast * star * prime ' circ ° over over
    lbrace \{ rbrace \} lbrack [ rbrack ] lvert bar( rvert bar) lVert bar( rVert bar)
    vert | mid | Vert |
    """
)

DIFFERENTIALS = _pairs("d d partial ∂ Delta Δ delta δ")  # letters that may be differentials
DOTS = {"dot": 1, "ddot": 2, "dddot": 3}
DECORATIONS = _pairs(
    """
    hat hat widehat hat bar bar overline bar tilde tilde widetilde tilde
    mathbf vector boldsymbol vector mathbfit vector bm vector pmb vector bf vector
    bfseries vector vec arrow overrightarrow arrow underline arrow
    vb vector vectorbold vector va arrow vectorarrow arrow vu hat vectorunit hat
    """
)
DECORATED = {  # what a decoration makes of a letter that has one already
    ("hat", ""): "hat",
    ("hat", "vector"): "hat",
    ("vector", "hat"): "hat",
    ("vector", ""): "vector",
    ("vector", "vector"): "vector",
    ("bar", ""): "bar",
    ("tilde", ""): "tilde",
    ("bar", "vector"): "bar vector",
    ("vector", "bar"): "bar vector",
    ("tilde", "vector"): "tilde vector",
    ("vector", "tilde"): "tilde vector",
}
ALPHABETS = _pairs("mathcal cal cal cal mathscr cal mathbb bb mathfrak frak")
FRACTIONS = _words("frac dfrac tfrac cfrac")
DERIVATIVES = _pairs("dv d derivative d pdv partial partialderivative partial")

CONSTANTS = {"constant", "const", "a constant", "constant vector", "a constant vector"}
WORDS = _words("text textrm textnormal textit textbf textsf mbox hbox")
UPRIGHT = _words("mathrm operatorname mathop mathsf mathit")
UPRIGHT_FROM_HERE = _words("rm it sf")
SILENT = _words(
    """
    displaystyle textstyle scriptstyle scriptscriptstyle limits nolimits nonumber notag
    thinspace medspace thickspace negthinspace boxed left right big Big bigg Bigg bigl Bigl biggl
    Biggl bigr Bigr biggr Biggr bigm Bigm normalsize small noindent hfill ensuremath boldmath
    unboldmath normalfont strut centering qty
    """
)
SILENT_WITH_ARGUMENT = _words("label hspace vspace phantom hphantom vphantom")
GAPS = _words("quad qquad enspace")
ROWS = _words("n cr newline par")  # "n" is a line end that a transcript spelled out

LAYOUTS = _words(
    """
    align aligned alignat alignedat split gather gathered equation eqnarray multline multlined
    displaymath math flalign
    """
)
STACKS = _words("matrix pmatrix bmatrix Bmatrix vmatrix smallmatrix array")
CASES = _words("cases dcases rcases")

CHARACTERS = _pairs("− - – - × × · · ⋅ · ∙ · ± ± ∓ ∓ ′ ' ’ ' ° °")
SIGN_CHARACTERS = _same(frozenset("=<>≈≡≠≤≥≪≫∝→↔")) | _pairs("≃ ≈ ≅ ≈ ∼ ≈")
ARROW_CHARACTERS = _words("⇒ ⇔ ∴")
POWER_CHARACTERS = _pairs("² 2 ³ 3")
LETTER_CHARACTERS = _pairs(
    """
    α alpha β beta γ gamma δ delta ε varepsilon ϵ epsilon ζ zeta η eta θ theta ϑ vartheta ι iota
    κ kappa λ lambda μ mu µ mu ν nu ξ xi ο omicron π pi ρ rho ϱ varrho σ sigma ς varsigma τ tau
    υ upsilon φ varphi ϕ phi χ chi ψ psi ω omega
    Γ Gamma Δ Delta ∆ Delta Θ Theta Λ Lambda Ξ Xi Π Pi Σ Sigma Υ Upsilon Φ Phi Ψ Psi Ω Omega
    Ω Omega ∂ partial ∞ infty ℓ ell ℏ hbar
    """
)
