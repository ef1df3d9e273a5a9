"""Memory of the run-in of a run."""


def run_in_bytes(scene):
    """Bytes that a run of the scene needs for its run-in; 0 without run-in, of which nothing is then imported."""
    if not scene.runs_in:
        return 0.0
    from tehl_taichi.plastic import memory

    return memory.needed_bytes(scene)
