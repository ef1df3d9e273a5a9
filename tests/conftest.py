import signal

import pytest


def pytest_configure():
    """A shell leaves what it starts with `&` deaf to Ctrl-C, `nohup` to a closed terminal, and so would be the commands that
    tests interrupt."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


@pytest.fixture(scope="session")
def taichi_cpu():
    """Taichi started once for the whole session, on two threads."""
    from tehl_taichi.engine import runtime

    return runtime.start(threads=2)


@pytest.fixture(params=("f32", "f64"))
def linear(request):
    """Changes of a scene for linear solves in single and in double precision."""
    return {"numerics.precision": request.param}


@pytest.fixture(scope="session")
def thermal(tmp_path_factory):
    """A finished run with temperatures and fatigue, made up."""
    import made_results

    return made_results.run(tmp_path_factory.mktemp("report") / "made.zarr", search=made_results.fatigue())
