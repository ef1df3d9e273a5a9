"""What is doubtful in the results of a run, a sentence each: the scene's own warnings and what its store shows."""

from tehl_taichi.io import film_judge


def warnings(store, summary):
    """All warnings of a run, without repetition. store: of the run; summary: its numbers so far (see io.summary)."""
    found = [*store.scene.warnings(), *(sentence for check in CHECKS for sentence in check(store, summary))]
    return list(dict.fromkeys(found))


CHECKS = (*film_judge.CHECKS,)  # functions of (store, summary) that give their sentences
