"""Exit codes."""

FAILED, BAD_INPUT, NOT_CONVERGED, INTERRUPTED = 1, 2, 3, 4


class Interrupted(Exception):
    """Ctrl-C in the middle of a run; the store can be resumed."""
