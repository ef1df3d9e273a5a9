"""What is doubtful in the results of a run, a sentence each: the scene's own warnings and what its store shows."""


def warnings(store, summary):
    """All warnings of a run, without repetition. store: of the run; summary: its numbers so far (see io.summary)."""
    found = [*store.scene.warnings(), *(sentence for check in CHECKS for sentence in check(store, summary))]
    return list(dict.fromkeys(found))


def unknown_errors(store, summary):
    """Numbers of which no error can be told, with the reason; one sentence for all that share it."""
    for part, when in (("steady", "steady "), ("transient", "passage "), ("fatigue", "")):
        reasons = {}
        for name, why in summary.get(part, {}).get("unknown", {}).items():
            reasons.setdefault(why, []).append(when + name)
        yield from (f"the error of {', '.join(names)} is not known: {why}" for why, names in reasons.items())


CHECKS = (unknown_errors,)  # functions of (store, summary) that give their sentences
