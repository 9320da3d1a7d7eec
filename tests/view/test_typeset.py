"""LaTeX of a text as MathML, as a text would print it."""

from polhode.view import typeset


def test_functions_stand_apart_from_what_they_are_of():
    thin = '<mspace width="0.17em"></mspace>'
    assert typeset(r"\sin\theta\cos\theta") == (
        '<math display="inline"><mrow>'
        f"<mi>sin</mi>{thin}<mi>θ</mi>{thin}<mi>cos</mi>{thin}<mi>θ</mi>"
        "</mrow></math>"
    )
    assert thin not in typeset(r"a + b\omega")
