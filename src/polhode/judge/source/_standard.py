"""Macros that LaTeX and its usual packages define, whether or not the reader knows them."""

from polhode.judge.source._macros import Macro

#: Those of plain TeX and of packages that stand for other LaTeX; a text may define them anew.
PACKAGE_MACROS = {
    r"\cdotp": Macro(r"\cdot"),
    r"\vcentcolon": Macro(":"),
    r"\MoveEqLeft": Macro("", ("[]",)),
    r"\require": Macro("", (None,)),
    r"\color": Macro("", ("[]", None)),
    r"\textcolor": Macro("{#3}", ("[]", None, None)),
    r"\odif": Macro("d^{#2} #3", ("*", "[]", None)),
    r"\tensor": Macro("{}#1#2#3", ("[]", None, None)),
    r"\indices": Macro("#1", (None,)),
    r"\underaccent": Macro(r"\underset{#1}{#2}", (None, None)),
    **{rf"\{name}": Macro("#1", (None,)) for name in ("eqalign", "eqalignno", "displaylines")},
    **{
        rf"\{name}": Macro(rf"\begin{{{name}}}#1\end{{{name}}}", (None,))
        for name in ("matrix", "pmatrix", "cases")
    },
}

_NAMES = """
sum prod coprod int iint iiint iiiint oint oiint bigcup bigcap bigoplus bigotimes bigodot
biguplus bigsqcup bigvee bigwedge lim limsup liminf sup inf max min arg det dim ker hom deg gcd
Pr mod bmod pmod pod log ln lg exp injlim projlim varlimsup varliminf in ni notin subset supset
subseteq supseteq subsetneq nsubseteq cup cap setminus emptyset varnothing forall exists nexists
neg lnot land lor wedge vee top bot vdash dashv models perp parallel nparallel mid nmid smile
frown asymp bowtie prec succ preceq succeq sqsubset sqsupset oplus ominus otimes oslash odot
circ bullet ast star dagger ddagger amalg uplus sqcap sqcup diamond wr div triangleleft
triangleright bigtriangleup bigtriangledown triangle square Box blacksquare lozenge boxplus
boxtimes boxdot rtimes ltimes intercal barwedge veebar to gets mapsto longmapsto rightarrow
leftarrow longrightarrow longleftarrow Rightarrow Leftarrow Longrightarrow Longleftarrow
leftrightarrow Leftrightarrow longleftrightarrow Longleftrightarrow uparrow downarrow Uparrow
Downarrow updownarrow nearrow searrow swarrow nwarrow hookrightarrow hookleftarrow
rightharpoonup rightharpoondown leftharpoonup leftharpoondown rightleftharpoons rightleftarrows
leadsto rightsquigarrow curvearrowleft curvearrowright circlearrowleft circlearrowright
xrightarrow xleftarrow implies impliedby iff therefore because triangleq coloneqq eqqcolon doteq
doteqdot approxeq thickapprox propto varpropto lesssim gtrsim lessgtr ll gg lll ggg nless ngtr
nleq ngeq leqslant geqslant dots ldots cdots vdots ddots dotsc dotsb dotsm dotsi dotso iddots
hdotsfor overbrace underbrace overline underline overset underset stackrel atop above choose
binom dbinom tbinom genfrac over overrightarrow overleftarrow overleftrightarrow underrightarrow
hat check breve acute grave tilde bar vec dot ddot dddot ddddot mathring widehat widetilde aleph
beth hbar hslash imath jmath ell wp Re Im partial nabla infty prime angle measuredangle
sphericalangle surd flat natural sharp clubsuit diamondsuit heartsuit spadesuit eth Bbbk
complement backprime bigstar digamma langle rangle lfloor rfloor lceil rceil lgroup rgroup
lmoustache rmoustache ulcorner urcorner left right middle big Big bigg Bigg bigl bigr Bigl Bigr
biggl biggr Biggl Biggr bigm mathrm mathbf mathit mathsf mathtt mathcal mathbb mathfrak mathscr
mathnormal boldsymbol bm pmb text textbf textit textrm textsf texttt textsc textup textnormal
textsuperscript textsubscript mbox hbox vbox fbox boxed tag label ref eqref cite pageref
footnote nonumber notag intertext shortintertext displaystyle textstyle scriptstyle
scriptscriptstyle quad qquad hspace vspace hskip kern mkern mskip hfill phantom hphantom
vphantom smash rm bf it sf tt sc em cal mit bfseries itshape normalfont footnotesize small tiny
large Large begin end frac dfrac tfrac cfrac sqrt root operatorname mathop mathbin mathrel
mathord mathopen mathclose mathpunct mathchoice limits nolimits substack sideset prescript
leftidx tensor indices cancel bcancel xcancel cancelto color textcolor colorbox not dv pdv fdv
dd pderivative derivative abs norm qty eval order comm acomm pb bra ket braket ketbra dyad
expval matrixel vb va vu grad divergence curl laplacian cross vdot tr Tr rank mqty pmqty bmqty
vmqty smqty matrixquantity identitymatrix imat xmat zmat dmat admat qq qcomma qc qif qthen qelse
qotherwise qunless qgiven qusing qassume qsince qlet qfor qall qeven qodd qinteger qand qor qas
qin variation var differential SI si num qtylist unit ang per meter metre second kilogram gram
newton joule watt hertz radian degree kilo milli micro centi nano mega giga celsius kelvin
ampere volt pascal minute hour squared cubed tothe cubic hline cline multicolumn multirow
toprule midrule bottomrule newline linebreak pagebreak noindent par centering item caption
includegraphics url href hyphen textdegree textmu mho varGamma varDelta varTheta varLambda varXi
varPi varSigma varUpsilon varPhi varPsi varOmega upalpha upmu upomega displaylimits strut
mathstrut relax ensuremath protect xspace def let newcommand lvert rvert lVert rVert vert Vert
lbrace rbrace lbrack
rbrack backslash ooalign SIrange SIlist numrange numlist qtyrange qtyproduct utilde
expectationvalue innerproduct outerproduct principalvalue mathpalette splitfrac adjustlimits Aboxed
"""

STANDARD = frozenset(_NAMES.split())
