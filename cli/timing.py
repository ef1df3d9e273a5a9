"""Table of the parts of a command's time."""

import contextlib

from tehl_cli.entry import CLOCK
from tehl_cli.tables import list_table


@contextlib.contextmanager
def time_budget(live):
    """The TimeBudget of a command whose progress `live` shows; None without --timing."""
    if live is None:
        yield None
        return
    from tehl_taichi.runs.time_budget import TimeBudget

    budget, shown = TimeBudget(CLOCK["began"]), live.stage

    def stage(name, done, total):
        budget.stage(name, done, total)
        shown(name, done, total)

    live.stage = stage
    with budget.watching():
        yield budget


def print_budget(budget):
    """Print the parts, longest first."""
    list_table("where the time went", ("part", "s", "share"),
               [(name, f"{seconds:.2f}", f"{100 * share:.0f} %") for name, seconds, share in budget.rows()])
