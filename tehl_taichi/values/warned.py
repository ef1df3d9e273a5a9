"""A warning: its sentence, and a short word for scripts that look for its kind."""


class Warned(str):
    """The sentence; code: the word of its kind."""

    def __new__(cls, text, code):
        made = super().__new__(cls, text)
        made.code = code
        return made

    def __getnewargs__(self):
        return str(self), self.code


def warned(checks, *args):
    """What {function(*args) -> sentences: code of them} say, each sentence once (of features that are alike every one says the
    same)."""
    return once(Warned(text, code) for check, code in checks.items() for text in check(*args))


def once(sentences):
    """A list of them without repetition."""
    return list(dict.fromkeys(sentences))
