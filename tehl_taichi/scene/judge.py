"""What is doubtful in a scene although it can be simulated, a sentence each: the warnings that are known before a run."""

from tehl_taichi.scene import oil_range, passing


def warnings(scene):
    """Sentences with the value, the unit and what would be better; [] for a scene without doubts."""
    return [sentence for check in CHECKS for sentence in check(scene)]


CHECKS = (passing.warnings, oil_range.warnings)  # functions of a scene that give its sentences
