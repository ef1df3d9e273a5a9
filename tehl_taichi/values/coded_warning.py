"""Warnings: sentences with a short word for their kind, and the numbers in them, for scripts."""

import json

from tehl_taichi.values.coded_text import CodedText, options_of


class CodedWarning(CodedText):
    """A warning about a scene or a result."""


def with_data(text, *options, **data):
    """The sentence of a check with the values in it; options: those parts of it that are options of the command line."""
    return CodedWarning(text, data=data | options_of(*options))


def coded_warning(checks, *args):
    """What {function(*args) -> sentences: code of them} say, each sentence once (of features that are alike every one says the
    same)."""
    return once(CodedWarning(text, code, getattr(text, "data", {})) for check, code in checks.items() for text in check(*args))


def once(sentences):
    """A list of them without repetition."""
    return list(dict.fromkeys(sentences))


def lists(warnings):
    """{name: list} of their sentences, codes and data, as a summary and a store have them."""
    whole = [one if isinstance(one, CodedWarning) else CodedWarning(one) for one in warnings]
    return {"warnings": [str(one) for one in whole], "warning_codes": [one.code for one in whole],
            "warning_data": [one.data for one in whole]}


def texts(warnings):
    """The lists of :func:`lists` as JSON texts."""
    return {name: json.dumps(values) for name, values in lists(warnings).items()}


def of_lists(sentences, codes, data):
    """The warnings that such lists are of; without codes where older versions wrote them."""
    if not len(sentences) == len(codes) == len(data):
        return [CodedWarning(text) for text in sentences]
    return [CodedWarning(*one) for one in zip(sentences, codes, data)]
