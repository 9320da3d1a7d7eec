"""A fixed sample of the mutation test; all of it is a campaign of tests/proof."""

from judge.mutation import tried, true_claims


def test_slips_in_true_claims_are_caught_and_put_right(capsys):
    counts = tried(true_claims(every=16), most=2, seed=5)
    with capsys.disabled():
        print(f"\nmutants: {counts}")
    assert counts.total["claims"] >= 5
    assert counts.missed == []
    assert counts.alarms == []
    assert counts.repaired >= 0.8
