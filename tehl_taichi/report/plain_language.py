"""Warnings as a reader has them who did not run the command: the facts stay, options of the command line become words."""

import re

WORDS = ((re.compile(r"(--set \S+) --grid"), r"\1 and --grid"), (re.compile(r"--grid (\d+)x(\d+)"), r"a grid of \1 × \2 cells"),
         (re.compile(r"--set (\S+=\S+)"), r"\1"), (re.compile(r"; `tehl resume[^`]*` continues"), ""),
         (re.compile(r"; --thermal computes them"), ""))


def plain_sentence(sentence):
    """The sentence without what only a terminal takes."""
    for pattern, words in WORDS:
        sentence = pattern.sub(words, sentence)
    return sentence
