"""End of a command some of whose contacts have no result."""

from tehl_taichi.errors import NotConverged
from tehl_taichi.values.digits import part_of


def refuse_missing(missing, count, noun, folder, others="the others are"):
    """Raise NotConverged if some of `count` contacts have no result; missing: these; others: text about the rest."""
    if missing:
        raise NotConverged(f"{part_of(len(missing), count, noun, 'has', 'have')} no result; {others} in {folder}. Try another "
                           "--grid or --set with a new --out")
