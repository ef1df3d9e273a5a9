"""Warnings: sentences with a code for their kind and their numbers, for scripts."""

import json

from tehl_taichi.values.coded_text import CodedText, code_of, for_reader, options_of


class CodedWarning(CodedText):
    """A warning about a scene or a result."""


def with_data(text, *options, **data):
    """Sentence of a check with its values; options: parts of it that are command-line options."""
    return CodedWarning(text, data=data | options_of(*options))


def coded_warning(checks, *args):
    """Warnings of checks {function(*args) -> sentences: code}, each sentence once (equal features give equal sentences)."""
    return unique(CodedWarning(text, code, getattr(text, "data", {}))
                  for check, code in checks.items() for text in check(*args))


def unique(sentences):
    """List of the sentences without repetition."""
    return list(dict.fromkeys(sentences))


class Kinds:
    """Kinds of the warnings of one run: those of one kind differ in their numbers only, between runs."""

    def __init__(self):
        self.found: dict[tuple, list] = {}

    def of(self, warning):
        """Kind of a warning: its code and the key that it is about, and which of several such it is (one per feature, body)."""
        kind = code_of(warning) or str(warning), getattr(warning, "data", {}).get("key", "")
        same = self.found.setdefault(kind, [])
        if warning not in same:
            same.append(warning)
        return *kind, same.index(warning)


def by_kind(summaries, spelled=str, leave=()):
    """[{sentence: its places}] of the kinds of warnings of several runs. summaries: (place, summary or None); spelled(warning):
    its sentence; leave: warnings that are left out.
    """
    kinds: dict[tuple, dict[str, list]] = {}
    for place, summary in summaries:
        own = Kinds()
        for one in unique(warnings_of(summary or {})):
            if one not in leave:
                kinds.setdefault(own.of(one), {}).setdefault(spelled(one), []).append(place)
    return list(kinds.values())


def counted(summaries, every, leave=()):
    """Sentences of several cases: the first of every kind, with the number of its cases; every: text such as "7 cases"; see
    :func:`by_kind`.
    """
    return [f"{[*one][0]} ({sum(map(len, one.values()))} of {every}{', numbers of the first' * (len(one) > 1)})"
            for one in by_kind(summaries, leave=leave)]


def lists(warnings):
    """{name: list} of the sentences, codes and data of warnings, for summaries and stores."""
    whole = [one if isinstance(one, CodedWarning) else CodedWarning(one) for one in warnings]
    return {"warnings": [str(one) for one in whole], "warning_codes": [one.code for one in whole],
            "warning_data": [one.data for one in whole]}


def texts(warnings):
    """The lists of :func:`lists` as JSON texts."""
    return {name: json.dumps(values) for name, values in lists(warnings).items()}


def warnings_of_lists(sentences, codes, data):
    """Warnings from such lists; without codes if older versions wrote them."""
    if not len(sentences) == len(codes) == len(data):
        return [CodedWarning(text) for text in sentences]
    return [CodedWarning(*one) for one in zip(sentences, codes, data)]


def summary_for_reader(summary):
    """Copy of a summary (or None) whose sentences have the options as their reader types them."""
    if not summary:
        return summary
    left_out = [for_reader(what) for what in summary.get("left_out", [])]
    found = lists(map(for_reader, warnings_of(summary))) if "warning_codes" in summary else {}
    return {**summary, **({"left_out": left_out} if left_out else {}), **found}


def warnings_of(summary):
    """Warnings of a summary."""
    sentences, codes = summary.get("warnings", []), summary.get("warning_codes", [])
    return warnings_of_lists(sentences, codes, summary.get("warning_data", [{} for _ in codes]))
