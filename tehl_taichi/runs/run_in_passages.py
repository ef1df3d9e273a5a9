"""Run with run-in: the passage is repeated in its store, each time on the surface that the last one left.

The last passage is assessed. A killed run resumes inside its current passage.
"""

from tehl_taichi.plastic.run_in import repeat_passages
from tehl_taichi.store import run_in_file


def march(saved, state, progress, once):
    """Run every passage of the store `saved` from a checkpoint's `state`; once(state, changes): marches one to its end. Returns
    the RunInState.
    """
    start, known, left = run_in_file.start_of(saved, state), run_in_file.read(saved.path), [state]

    def passage(changes):
        once(left.pop() if left else start, changes)
        return saved

    def keep(found):
        if not found.done:
            progress.say(_words(found))
            saved.rewind(start)
        with saved.safely():
            run_in_file.write(saved.path, found)

    if known.done:
        passage(known.changes)
        return known
    return repeat_passages(saved.scene, passage, known, keep)[1]


def _words(state):
    """Text of the next passage."""
    if state.rounds:
        rest = abs(state.rest).max()
        return f"run-in: first passage, round {state.rounds + 1} (the surface moved by {rest * 1e9:.1f} nm in the last one)"
    last = state.records[-1]
    return (f"run-in: passage {last['passage']} changed the surface by {last['surface_change_m'] * 1e9:.1f} nm (plastic strain "
            f"{last['new_plastic_strain']:.1e} more)")
