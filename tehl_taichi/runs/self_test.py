"""Self-test of this installation: versions, and a contact with a known film."""

import importlib.metadata
import time

from tehl_taichi import __version__
from tehl_taichi.commit import commit
from tehl_taichi.scene import scene

LIBRARIES = ("numpy", "pyfftw", "zarr", "rich", "typer")
FILM = 0.42e-6, 0.45e-6  # m, of the self-test, whose grid is good to 1 %


def installation():
    """{what: version or value as text}; starts Taichi."""
    from tehl_taichi.engine import cores, runtime

    info = {"tehl_taichi": __version__, "commit": commit(), **{name: importlib.metadata.version(name) for name in LIBRARIES}}
    return info | {key: str(value) for key, value in runtime.start_or_join().items()} | {"cores": str(cores.available())}


def self_test():
    """(central film of a steady line contact in m, whether it is right, seconds that it took)."""
    from tehl_taichi.march import march

    began = time.perf_counter()
    line = scene("smooth-line").replace(**{"grid.nx": 128, "thermal.on": False})
    film = next(march(line)).scalars["h_c_m"]
    return film, FILM[0] < film < FILM[1], time.perf_counter() - began
