"""Stage of the run-in that an unfinished run has reached, as text."""


def words(store):
    """Text such as ", passage 1 of run-in (round 3)" to follow a number of steps; "" without or after run-in."""
    state = store.run_in
    if state is None or state.done:
        return ""
    if state.passages == store.scene.time.run_in:
        return ", the passage after run-in"
    return f", passage {state.passages + 1} of run-in" + f" (round {state.rounds + 1})" * (state.passages == 0)
