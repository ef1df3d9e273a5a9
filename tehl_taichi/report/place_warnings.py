"""Warnings of contacts along something, each kind once with its places."""

from tehl_taichi.values.coded_warning import of_lists

MANY = 3  # places that are named one by one


def of(rows, words, spelled=str):
    """A list of sentences. rows: (position, Hertz pressure, summary or None) each; words(position): how a sentence calls it;
    spelled(warning): its sentence.

    Warnings of one kind with other numbers are one sentence, that of the first place; the others follow as places.
    """
    kinds: dict[str, dict[str, list[str]]] = {}
    count = sum(1 for *_, summary in rows if summary)
    for at, _, summary in rows:
        for one in _warnings(summary or {}):
            kinds.setdefault(one.code or str(one), {}).setdefault(spelled(one), []).append(words(at))
    return [_sentence(found, count) for found in kinds.values()]


def _warnings(summary):
    return of_lists(summary.get("warnings", []), summary.get("warning_codes", []), summary.get("warning_data", []))


def _sentence(found, count):
    """found: {sentence: its places} of one kind; count: of all places."""
    (first, places), *rest = found.items()
    others = list(dict.fromkeys(place for more in (places for _, places in rest) for place in more if place not in places))
    if len(places) == count > MANY:
        return f"everywhere: {first}"
    where = "everywhere else" if len(places) + len(others) == count > MANY else f"at {', '.join(others)}"
    return f"{', '.join(places)}: {first}{f' (likewise, with other numbers, {where})' if others else ''}"
