"""What is doubtful in a scene although it can be simulated, a sentence each: the warnings that are known before a run."""

from tehl_taichi.scene import map_judge, oil_range, passing, route


def warnings(scene):
    """Sentences with the value, the unit and what would be better; [] for a scene without doubts."""
    return [sentence for check in CHECKS for sentence in check(scene)]


def cut_passage(scene):
    """A passage that ends although the feature still is in the contact."""
    end = route.cut_at(scene)
    if end is not None:
        yield (f"passage cut at {end:.2f} a: its extremes and its fatigue are those of a part, a whole one ends at "
               f"{route.uncut(scene).path[1]:.2f} a; `tehl resume STORE` goes on")


CHECKS = (passing.warnings, oil_range.warnings, cut_passage, map_judge.doubts)  # functions of a scene that give its sentences
