"""Every campaign enters its figures in a ledger; all of them are told as one table at the end."""

from collections.abc import Iterator

import pytest

from proof.ledger import Ledger, table

PROPERTY = "ledger"


@pytest.fixture
def ledger(request: pytest.FixtureRequest, record_property) -> Iterator[Ledger]:
    """The ledger of one campaign; an error beyond what is allowed fails it."""
    opened = Ledger(request.node.originalname.removeprefix("test_").replace("_", " "))
    yield opened
    record_property(PROPERTY, opened.row())
    if opened.failures:
        shown = "\n".join(opened.failures[:20])
        pytest.fail(f"{len(opened.failures)} of {opened.cases} cases:\n{shown}", pytrace=False)


@pytest.fixture(autouse=True)
def _examples_counted(request: pytest.FixtureRequest, record_property) -> Iterator[None]:
    """Tells how many examples a widened property held for."""
    held = getattr(request.function, "held", None)
    before = len(held or ())
    yield
    if held is not None:
        what = request.node.originalname.removeprefix("test_").partition("__")[0]
        module = request.function.__module__.partition("test_")[2]
        record_property(
            PROPERTY,
            Ledger(module.replace("_", " "), what.replace("_", " "), len(held) - before).row(),
        )


def pytest_terminal_summary(terminalreporter) -> None:
    """The table, after the last test."""
    reports = [report for found in terminalreporter.stats.values() for report in found]
    properties = (p for report in reports for p in getattr(report, "user_properties", ()))
    rows = {tuple(value) for name, value in properties if name == PROPERTY}
    if rows:
        terminalreporter.section("what was tried, and the worst of it")
        terminalreporter.write_line("\n".join(table(list(rows))))
