"""Warnings of a sequence of contacts, each kind once with its places."""

from tehl_taichi.values.coded_warning import by_kind

MANY = 3  # places that are named one by one


def of(rows, words, spelled=str):
    """List of sentences. rows: (position, Hertz pressure, summary or None); words(position): its text; spelled(warning): its
    sentence.

    Warnings of one kind with different numbers become one sentence: that of the first place, followed by the other places.
    """
    count = sum(1 for *_, summary in rows if summary)
    return [_sentence(found, count) for found in by_kind(((words(at), summary) for at, _, summary in rows), spelled)]


def _sentence(found, count):
    """One sentence of a kind of warning. found: {sentence: its places}; count: of all places."""
    (first, places), *rest = found.items()
    others = list(dict.fromkeys(place for more in (places for _, places in rest) for place in more if place not in places))
    if len(places) == count > MANY:
        return f"everywhere: {first}"
    where = "everywhere else" if len(places) + len(others) == count > MANY else f"at {', '.join(others)}"
    return f"{', '.join(places)}: {first}{f' (likewise, with other numbers, {where})' if others else ''}"
