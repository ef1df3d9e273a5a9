"""What is doubtful in the results of a run, a sentence each: the scene's own warnings and what its store shows."""


def warnings(store, summary):
    """All warnings of a run, without repetition. store: of the run; summary: its numbers so far (see io.summary)."""
    found = [*store.scene.warnings(), *(sentence for check in CHECKS for sentence in check(store, summary))]
    return list(dict.fromkeys(found))


def worst_below(store, summary):
    """The surface is not where the body is worst loaded."""
    fatigue = summary.get("fatigue", {})
    deep = fatigue.get("below")
    if not deep or deep["Fi_max"] <= fatigue["Fi_max"]:
        return []
    said = (f"the worst point lies below the surface: Fi {deep['Fi_max']:.2f} at {deep['depth_m'] * 1e6:.0f} um, "
            f"{fatigue['Fi_max']:.2f} at the surface")
    alone = deep.get("contact_alone")
    if alone and alone["Fi_max"] > fatigue["Fi_max"]:
        said += f"; the contact without its feature has {alone['Fi_max']:.2f} at {alone['depth_m'] * 1e6:.0f} um"
    if deep["depth_m"] <= 1.001 * deep.get("searched_m", [0.0])[0]:
        said += "; nearer to the surface (half a cell) this grid resolves nothing: take a finer one"
    return [said]


CHECKS = (worst_below,)  # functions of (store, summary) that give their sentences
