"""Cases of a plan that repeat others, because the keys in which they differ have no effect there: sentences before a sweep."""

from tehl_taichi.scene import aliases, idle_keys
from tehl_taichi.values.digits import part_of


def sentences(plan):
    """Sentences about the cases that repeat earlier ones; of a large plan, about the keys of the cases looked at."""
    if plan.is_large:
        return list(_by_key(plan))
    equal = list(plan.equal().items())
    if len(equal) < 2:
        return [f"case {number} equals case {first}: the keys that differ have no effect there" for number, first in equal]
    number, first = equal[0]
    return [f"{len(equal)} of {plan.count} cases repeat earlier ones (case {number} equals case {first}): the keys that differ "
            f"have no effect there{_reasons(plan, equal)}"]


def _reasons(plan, equal):
    """Text ': key (why)' of the keys without effect in the repeated cases, "" if none has a reason."""
    found: dict[str, str] = {}
    for number, first in equal:
        idle, other = idle_keys.idle(plan.case(number)), plan.changes(first)
        found |= {key: idle[aliases.full_name(key)] for key, value in plan.changes(number).items()
                  if value != other[key] and aliases.full_name(key) in idle and key not in found}
    return ": " * bool(found) + "; ".join(f"{key} ({why})" for key, why in found.items())


def _by_key(plan):
    """Generator of sentences about swept keys without effect in some of the cases looked at."""
    scenes = list(plan.scenes_looked_at())
    for key in plan.keys:
        reasons = [why for scene in scenes if (why := idle_keys.idle(scene).get(aliases.full_name(key), ""))]
        if reasons:
            yield (f"{key} has no effect in {part_of(len(reasons), len(scenes), 'case')} looked at ({reasons[0]}): cases that "
                   "differ in it alone repeat each other there")
