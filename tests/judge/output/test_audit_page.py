"""The page of an audit: every answer that a verdict may have, with how letters were read."""

import re

import pytest

import polhode as ph
from polhode.judge import Answer, audit_html
from polhode.tour._claims import _WORDS

DOCUMENT = r"""
[document]
title = "Letters"
[[part]]
id = "top"
system = "gyroscope"
[[claim]]
id = "1"
part = "top"
latex = '\dot L_z = 0'
[[claim]]
id = "2"
part = "top"
latex = '\dot L_{p,z} = 0'
[[claim]]
id = "3"
part = "top"
latex = 'Q = L_{p,z}'
[[claim]]
id = "4"
part = "top"
latex = '\dot L_{p,z} = M'
[[claim]]
id = "5"
part = "top"
latex = 'L_{p,z} = '
"""


@pytest.fixture(scope="module")
def report():
    return ph.audit(DOCUMENT)


def test_every_answer_has_its_word(report):
    answers = [judged.answer for judged in report.judged]
    assert answers == [
        Answer.AMBIGUOUS,
        Answer.HOLDS,
        Answer.DEFINITION,
        Answer.FAILS,
        Answer.UNREAD,
    ]
    page = audit_html(report)
    for answer in answers:
        assert f'<span class="verdict {answer.value}">' in page
    assert set(_WORDS) == {answer.value for answer in Answer}


def test_what_letters_were_taken_to_mean_stands_beside_the_verdict(report):
    seen = re.sub("<details>.*?</details>", "", audit_html(report), flags=re.DOTALL)
    assert "to choose, state the reading" in seen
    words = " ".join(re.sub("<[^>]*>", "", seen).split())
    assert "letters𝐋p as angular momentum about pivot; 𝐳^ as axis z of lab" in words
