import pytest


@pytest.fixture(scope="session")
def taichi_cpu():
    """Taichi started once for the whole session, on two threads."""
    from tehl_taichi import runtime

    return runtime.start(threads=2)
