"""Sentences with a code for their kind and their numbers as data: programs read these, not the sentence."""

from tehl_taichi import errors


class CodedText(str):
    """A sentence. code: of its kind, "" if unknown; data: {name with its SI unit: value}.

    "options" in the data: {a command-line option in the sentence: words for a report}.
    """

    code: str
    data: dict

    def __new__(cls, text, code="", data=None):
        made = super().__new__(cls, text)
        made.code, made.data = code, data or {}
        return made

    def __getnewargs__(self):
        return str(self), self.code, self.data



class Reason(CodedText):
    """Reason why a number or its error is not known."""


def for_reader(sentence):
    """The sentence with its options as its reader types them, see :func:`tehl_taichi.errors.for_reader`."""
    if not isinstance(sentence, CodedText):
        return errors.for_reader(sentence)
    options = {errors.for_reader(option): words for option, words in sentence.data.get("options", {}).items()}
    return type(sentence)(errors.for_reader(str(sentence)), sentence.code,
                          sentence.data | ({"options": options} if options else {}))


def code_of(text):
    """Code of a sentence, "" of one without."""
    return getattr(text, "code", "")


def unknown_of(reasons):
    """{"unknown": {name: reason}, "unknown_codes": {name: code}}, as a summary has them."""
    return {"unknown": dict(reasons), "unknown_codes": {name: code_of(reason) for name, reason in reasons.items()}}


def reasons_of(part):
    """{name: Reason} of a part of a summary; without codes if an older version wrote it."""
    codes = part.get("unknown_codes", {})
    return {name: Reason(text, codes.get(name, code_of(text))) for name, text in part.get("unknown", {}).items()}


class Option(str):
    """Command-line options inside a sentence; words: text for a report, which has no command line."""

    words: str

    def __new__(cls, text, words):
        made = super().__new__(cls, text)
        made.words = words
        return made


def grid_option(scene, nx, ny):
    """Option --grid with these cells; ny does not count in a scene without variation along y."""
    if scene.one_dimensional:
        return Option(f"--grid {nx}", f"a grid of {nx} columns")
    return Option(f"--grid {nx}x{ny}", f"a grid of {nx} × {ny} cells")


def options_of(*parts):
    """{"options": {text: words}} of the parts that are options; {} without any."""
    found = {str(part): part.words for part in parts if isinstance(part, Option)}
    return {"options": found} if found else {}


def without_options(sentence):
    """The sentence with its options in words."""
    text = str(sentence)
    for option, words in getattr(sentence, "data", {}).get("options", {}).items():
        text = text.replace(option, words)
    return text
