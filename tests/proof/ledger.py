"""What a campaign has looked at: how many cases, and the worst of them with its circumstances."""

from collections.abc import Callable
from dataclasses import dataclass, field

Record = Callable[[str, object], None]

COLUMNS = ("campaign", "part", "cases", "set aside", "worst", "allowed", "condition", "where")


@dataclass
class Ledger:
    """Counts of one campaign, and the largest of its errors in units of what is allowed.

    An error is relative; `condition` is by how much the problem itself magnifies a relative change
    of what it is given. Of an error that the condition explains the condition is told with it.
    """

    campaign: str
    part: str = ""
    cases: int = 0
    aside: int = 0
    worst: float = 0.0
    allowed: float = 0.0
    condition: float = 1.0
    where: str = ""
    failures: list[str] = field(default_factory=list)

    def error(self, size: float, allowed: float, condition: float, where: str) -> None:
        """Enter the relative error of one case."""
        if not size <= allowed:
            self.failures.append(
                f"{where}: {size:.2g}, allowed {allowed:.2g}, condition {condition:.2g}"
            )
        if not self.where or not size * self.allowed <= self.worst * allowed:
            self.worst, self.allowed = size, allowed
            self.condition, self.where = condition, where

    def row(self) -> tuple[str, ...]:
        """As a line of the table."""
        if not self.where:
            return (self.campaign, self.part, str(self.cases), str(self.aside), *[""] * 4)
        figures = (f"{f:.1e}" for f in (self.worst, self.allowed, self.condition))
        return (self.campaign, self.part, str(self.cases), str(self.aside), *figures, self.where)


def table(rows: list[tuple[str, ...]]) -> list[str]:
    """Lines of a table, its columns aligned."""
    everything = [COLUMNS, *sorted(rows)]
    widths = [max(map(len, column)) for column in zip(*everything, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in everything
    ]
