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
LETTERS = _same(GREEK | _words("ell hbar infty partial degree nabla"))
LETTER_SYNONYMS = (
    _pairs("imath i jmath j top T intercal T triangle Delta dd d differential d variation delta")
    | _pairs("grad nabla gradient nabla")
    | {f"var{name}": name for name in GREEK if name[0].isupper()}
    | {f"up{name.lower()}": name for name in GREEK if name[0].islower()}
)
LABELS = _pairs("perp perp bot perp parallel parallel dagger dagger")

FUNCTIONS = _same(
    _words(
        """
        sin cos tan sec csc cot arcsin arccos arctan sinh cosh tanh sech csch coth
        arsinh arcosh artanh exp ln log
        """
    )
) | _pairs(
    """
    cosec csc cotan cot tg tan ctg cot arctg arctan asin arcsin acos arccos atan arctan
    arcsinh arsinh arccosh arcosh arctanh artanh asinh arsinh acosh arcosh atanh artanh
    """
)
ELLIPTIC = _words("E F K Pi")  # integrals, as in K(sin(θ₀/2)), besides other quantities
#: What French and Russian texts call them, as operators; as labels they are words.
SHORT_FUNCTIONS = _pairs("sh sinh ch cosh th tanh cth coth")
#: Operators that are known, so that they are not taken for words, but have no place in a tree.
OPERATORS = _words(
    """
    sgn sign Sign signum floor ceil tr Tr trace det rank Re Im div curl rot grad atan2 arg mod lim
    dim sinc span max min sup inf
    """
)
COUNTS = _words("n k pi")  # letters that stand before an angle: sin nθ
RATES = _words("omega Omega nu kappa gamma")  # and, with the Latin ones, before a time: cos Ωt
ANGLES = _words("theta vartheta phi varphi psi alpha beta gamma delta chi")
INVERSES = _pairs("sin arcsin cos arccos tan arctan sinh arsinh cosh arcosh tanh artanh")

SIGNS = _pairs(
    """
    approx ≈ simeq ≈ cong ≈ doteq ≈ sim ≈ equiv ≡ ne ≠ neq ≠ lt < gt > le ≤ leq ≤ leqslant ≤
    ge ≥ geq ≥ geqslant ≥ ll ≪ gg ≫ propto ∝ to → rightarrow → longrightarrow → leftrightarrow ↔
    approxeq ≈ thickapprox ≈ leqq ≤ geqq ≥ longleftrightarrow ↔ in ∈ mapsto ↦
    rightharpoonup → coloneqq ≡ coloneq ≡ triangleq ≡ eqdef ≡ defeq ≡ eqqcolon ≡
    """
)
ARROWS = _pairs(
    """
    Rightarrow ⇒ Longrightarrow ⇒ implies ⇒ Leftrightarrow ⇔ Longleftrightarrow ⇔ iff ⇔
    therefore ∴ because ∵ Leftarrow ⇐ impliedby ⇐ forall ∀
    """
)
MARKS = _pairs(
    r"""
    pm ± mp ∓ times × cross × crossproduct × cp × wedge ×
    otimes ⊗ vdot · dotproduct · dp · cdot · bullet · ast * star * prime ' circ ° over over
    lbrace \{ rbrace \} lbrack [ rbrack ] lvert bar( rvert bar) lVert bar( rVert bar)
    vert | mid | Vert |
    lparen ( rparen ) colon : qcomma , qc ,
    """
)

#: Words that students set in italics, where nobody means the product of their letters.
NOUNS = _words(
    """
    mass force torque energy momentum velocity speed acceleration time length height radius angle
    work power weight friction inertia distance
    """
)
ITALIC_WORDS = NOUNS | _words("total initial final and for where with while when then constant")
ENERGIES = _words("KE PE GPE EPE")  # words that stand for a quantity as letters do
INDICES = _words("i j k l")  # above a coordinate
DIFFERENTIALS = _pairs("d d partial ∂ Delta Δ delta δ")  # letters that may be differentials
DOTS = {"dot": 1, "ddot": 2, "dddot": 3, "ddddot": 4}
DECORATIONS = _pairs(
    """
    hat hat widehat hat bar bar overline bar tilde tilde widetilde tilde breve breve check check
    mathbf vector boldsymbol vector mathbfit vector bm vector pmb vector bf vector
    bfseries vector symbf vector vec arrow overrightarrow arrow underline arrow underbar arrow
    overleftrightarrow arrow vv arrow
    vb vector vectorbold vector va arrow vectorarrow arrow vu hat vectorunit hat
    """
)
DECORATED = {  # what a decoration makes of a letter that has one already
    (kind, there): made
    for accent in ("bar", "tilde", "breve", "check")
    for kind, there, made in (
        (accent, "", accent),
        (accent, "vector", f"{accent} vector"),
        ("vector", accent, f"{accent} vector"),
        (accent, "hat", f"{accent} hat"),
        ("vector", f"{accent} hat", f"{accent} hat"),
    )
} | {("hat", ""): "hat", ("hat", "vector"): "hat", ("vector", "hat"): "hat"}
DECORATED |= {("vector", ""): "vector", ("vector", "vector"): "vector", ("bar", "bar"): "vector"}
ACCENTS = frozenset(kind.partition(" ")[0] for kind, _ in DECORATED) - {"vector"}
ALPHABETS = _pairs("mathcal cal cal cal mathscr cal mathbb bb mathfrak frak")
FRACTIONS = _words("frac dfrac tfrac cfrac nicefrac sfrac flatfrac")
DERIVATIVES = _pairs("dv d derivative d odv d pdv partial partialderivative partial")
INTEGRALS = _pairs("int 1 oint 1 iint 2 iiint 3")
SUMS = _pairs("sum sum prod product")
OMITTED = _words(
    "cdots ldots dots dotsb dotsc dotsi dotsm dotso vdots ddots iddots hdots mathellipsis"
)
REWRITTEN = _words(  # macros with arguments, see `_rewriting`
    """
    abs absolutevalue norm order eval mqty pmqty bmqty matrixquantity overset stackrel
    underset xrightarrow mathring prescript leftidx leftexp
    """
)
BRACES = _words("underbrace overbrace underbracket overbracket")
FRAMES = _words(  # labels of a derivative that name the triad in which it is taken
    """
    rot rotating rotated body space inertial fixed lab laboratory rel relative moving in s b S B N
    """
)

CONSTANTS = {"constant", "const", "a constant", "constant vector", "a constant vector"} | _words(
    "konst konstant konstante cste constante"
)
WORDS = _words(
    "text textrm textnormal textit textbf textsf textsc texttt textup mbox hbox qq"
    " intertext shortintertext"
)
WORDS_OF_MACROS = _pairs(
    "qand and qor or qif if qwhere where qfor for qthen then qwhen when qgiven given qsince since"
)
UPRIGHT = _words("mathrm operatorname mathop mathsf mathit mathtt mathnormal symup")
UPRIGHT_FROM_HERE = _words("rm it sf")
SILENT = _words(
    """
    displaystyle textstyle scriptstyle scriptscriptstyle limits nolimits nonumber notag
    thinspace medspace thickspace negthinspace boxed left right big Big bigg Bigg bigl Bigl biggl
    Biggl bigr Bigr biggr Biggr bigm Bigm normalsize small noindent ensuremath boldmath
    unboldmath normalfont strut mathstrut centering middle displaylimits hline relax protect
    cancel bcancel fbox smash mathclap mathrlap mathllap mathrel mathbin mathord mathopen mathclose
    mathinner mathpunct tiny scriptsize footnotesize large Large LARGE huge Huge allowbreak
    IEEEyesnumber IEEEnonumber xspace
    """
)
SILENT_WITH_ARGUMENT = _words(
    "label hspace vspace phantom hphantom vphantom color textcolor mspace"
)
GAPS = _words("quad qquad enspace hfill hfil")
ROWS = _words("n cr newline par")  # "n" is a line end that a transcript spelled out

LAYOUTS = _words(
    """
    align aligned alignat alignedat split gather gathered equation eqnarray multline multlined
    displaymath math flalign subequations dmath IEEEeqnarray empheq
    """
)
STACKS = _words("matrix pmatrix bmatrix Bmatrix vmatrix Vmatrix smallmatrix psmallmatrix array")
DETERMINANTS = _words("vmatrix Vmatrix")
CASES = _words("cases dcases rcases")

CHARACTERS = _pairs("− - – - × × ⊗ ⊗ · · ⋅ · ∙ · ± ± ∓ ∓ ′ ' ’ ' ° °")
SIGN_CHARACTERS = _same(frozenset("=<>≈≡≠≤≥≪≫∝→↔∈↦")) | _pairs("≃ ≈ ≅ ≈ ∼ ≈ := ≡ =: ≡ <= ≤ >= ≥")
ARROW_CHARACTERS = _words("⇒ ⇔ ∴ ∵ ⇐ ∀")
POWER_CHARACTERS = _pairs("² 2 ³ 3")
LETTER_CHARACTERS = _pairs(
    """
    α alpha β beta γ gamma δ delta ε varepsilon ϵ epsilon ζ zeta η eta θ theta ϑ vartheta ι iota
    κ kappa λ lambda μ mu µ mu ν nu ξ xi ο omicron π pi ρ rho ϱ varrho σ sigma ς varsigma τ tau
    υ upsilon φ varphi ϕ phi χ chi ψ psi ω omega
    Γ Gamma Δ Delta ∆ Delta Θ Theta Λ Lambda Ξ Xi Π Pi Σ Sigma Υ Upsilon Φ Phi Ψ Psi Ω Omega
    Ω Omega ∂ partial ∇ nabla ∞ infty ℓ ell ℏ hbar
    """
)
