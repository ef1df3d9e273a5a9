"""Self-test of this installation: versions, the entries of plugins, and a contact with a known film."""

import importlib
import importlib.metadata
import math
import time

from tehl_taichi import __version__
from tehl_taichi.commit import commit
from tehl_taichi.engine import cores, runtime
from tehl_taichi.scene import scene
from tehl_taichi.values import plugins
from tehl_taichi.values.registry import entries_of

LIBRARIES = ("numpy", "pyfftw", "zarr", "rich", "typer")
REGISTRIES = ("laws.choices", "laws.criteria", "laws.hardness", "laws.hardening", "scene.feature", "scene.named_oils",
              "scene.named_steels")
FILM = 0.42e-6, 0.45e-6  # m, of the self-test, whose grid is good to 1 %


def installation():
    """{item: version or value as text}; starts Taichi."""
    info = {"tehl_taichi": __version__, "commit": commit(), **{name: importlib.metadata.version(name) for name in LIBRARIES}}
    return info | {key: str(value) for key, value in runtime.start_or_join().items()} | {"cores": str(cores.available())}


def plugins_checked():
    """[(file, name of entry, known value, computed value as text, whether they agree)] of the entries of plugins."""
    for registry in REGISTRIES:
        importlib.import_module(f"tehl_taichi.{registry}")
    return [(module.__file__, entry.name, *_checked(known)) for module in plugins.loaded_modules()
            for entry in entries_of(module) for known in entry.checked]


def _checked(known):
    """(known value, computed value, whether they agree); an error of the user's function is the computed value."""
    where = f"{known.where}: {known.expected:.6g}"
    try:
        computed = float(known.compute())
    except Exception as error:  # noqa: BLE001  whatever a function of the user raises
        return where, f"{type(error).__name__}: {error}", False
    return where, f"{computed:.6g}", math.isclose(computed, known.expected, rel_tol=known.rel)


def self_test():
    """Solve a steady line contact: (central film in m, whether it is right, seconds)."""
    from tehl_taichi.march import march

    began = time.perf_counter()
    line = scene("smooth-line").replace(**{"grid.nx": 128, "thermal.on": False})
    film = next(march(line)).scalars["h_c_m"]
    return film, FILM[0] < film < FILM[1], time.perf_counter() - began
