"""Warnings of contacts along something, each once with its places."""


def of(rows, words):
    """A list of sentences. rows: (position, Hertz pressure, summary or None) each; words(position): how a sentence calls it."""
    places: dict[str, list[str]] = {}
    for at, _, summary in rows:
        for sentence in (summary or {}).get("warnings", []):
            places.setdefault(sentence, []).append(words(at))
    return [f"{', '.join(names)}: {sentence}" for sentence, names in places.items()]
