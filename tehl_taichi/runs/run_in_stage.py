"""Passage of its run-in that an unfinished run has reached, in words."""


def words(store):
    """As ", passage 1 of run-in (round 3)", for text behind a number of steps; "" of a run without run-in, or after it."""
    state = store.run_in
    if state is None or state.done:
        return ""
    if state.passages == store.scene.time.run_in:
        return ", the passage after run-in"
    return f", passage {state.passages + 1} of run-in" + f" (round {state.rounds + 1})" * (state.passages == 0)
