"""Values that the user gave to a scene and that a change of another key replaces: the name of an oil, its data sheet."""

from tehl_taichi.scene import aliases, idle_keys, keys
from tehl_taichi.values.automatic import AutomaticValue
from tehl_taichi.values.coded_warning import with_data

WRITTEN = ("oil.source", "fatigue.source", "fatigue.table_rows", "fatigue.table_rows_b")  # by tehl, beside what they belong to


def with_changes(before, after, changes):
    """`after`, which is `before` with changes {full key: value}, with a record of the keys that the user gave and of those
    that the changes replaced.
    """
    own, named = idle_keys.user_keys(before), idle_keys.changed_keys(after, changes)
    lost = _replaced(before, after, own - named, changes)
    return after.with_user_keys(own - lost.keys() | named, (*before.replaced, *_sentences(after, lost, changes)))


def warnings(scene):
    """Warnings about values of the user that changes of other keys replaced."""
    return scene.replaced


def _replaced(before, after, own, changes):
    """{full key: former value} of the user's `own` keys that have another value after changes of other keys."""
    written = {*changes, *_described_anew(changes), *WRITTEN}
    values = {key: value for key, _, value in keys.every(after)}
    return {key: value for key, _, value in keys.every(before) if key in own and key in values and values[key] != value
            and not isinstance(value, AutomaticValue) and not key.endswith(".sha256")
            and not any(key == one or key.startswith(f"{one}.") for one in written)}


def _described_anew(changes):
    """Keys that say the same as a changed one in another way: a load, say, in place of a Hertz pressure."""
    for groups in aliases.EXCLUSIVE:
        if any(key in changes for group in groups for key in group):
            yield from (key for group in groups for key in group if not changes.keys() & set(group))


def _sentences(scene, lost, changes):
    """One sentence for each part of the scene that lost values."""
    for part in dict.fromkeys(key.rpartition(".")[0] for key in lost):
        former = {key: value for key, value in lost.items() if key.startswith(f"{part}.")}
        new = {key: value for key, value in changes.items() if key.startswith(f"{part}.")} or changes
        yield with_data(f"replaced by {_words(scene, new)}: {_words(scene, former)}", keys=[*former])


def _words(scene, values):
    return ", ".join(f"{idle_keys.short_key(key, scene)} = {f'{value:g}' if isinstance(value, float) else value}"
                     for key, value in values.items())
