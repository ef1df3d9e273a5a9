"""The public functions. Importing this file costs nothing: each function loads what it needs when it is called.

>>> import tehl_taichi as tehl
>>> tehl.scene("gear").replace(srr=-0.12).operation.u_a < 8.5
True
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

if TYPE_CHECKING:
    import numpy as np

    from tehl_taichi.crack.analysis import CrackResult
    from tehl_taichi.fatigue.given_histories import Points
    from tehl_taichi.fatigue.search_result import SearchResult
    from tehl_taichi.march.snapshot import Snapshot
    from tehl_taichi.runs.bearing.rolling_bearing import RollingBearing
    from tehl_taichi.runs.bearing.stored_bearing import Bearing
    from tehl_taichi.runs.cam.stored_cam import Cam
    from tehl_taichi.runs.compare import Comparison
    from tehl_taichi.runs.compare_places import PlaceComparison
    from tehl_taichi.runs.contact_set import ContactSet
    from tehl_taichi.runs.flank.stored_flank import Flank
    from tehl_taichi.runs.progress import Progress
    from tehl_taichi.runs.stored_run import Run
    from tehl_taichi.runs.sweep.study_table import Study
    from tehl_taichi.runs.traction.traction_rows import Traction
    from tehl_taichi.scene.description import Scene
    from tehl_taichi.scene.feature import Feature
    from tehl_taichi.scene.gear_pair import GearPair

Name = str | PathLike
FUNCTIONS = ("animate", "bearing", "cam", "compare", "crack", "export", "fatigue", "flank", "march", "open", "report", "resume",
             "run", "scene", "simulate", "stresses", "sweep", "traction", "zoom")


def _use_plugins(*names):
    """The plugins of scene files, before any registry is read."""
    files = [name for name in names if str(name).lower().endswith(".toml")]
    if files:
        from tehl_taichi.values import plugins

        for name in files:
            plugins.use_plugins_of(name)


def _opened(of):
    """The run of a path; anything else unchanged."""
    if not isinstance(of, (str, PathLike)):
        return of
    from tehl_taichi.runs.open_results import open_run

    return open_run(of)


def _loaded(of):
    """The scene of a name, a path or a Run; anything else unchanged."""
    return scene(of) if isinstance(of, (str, PathLike)) or hasattr(of, "scene") else of


def scene(name: "Name | Scene | Run" = "gear") -> "Scene":
    """Load a scene: a built-in one, a TOML file, or the scene of a stored run.

    Parameters
    ----------
    name : str, path, Scene or Run
        Name of a built-in scene (`tehl scenes` lists them), path of a TOML file or of a store. A Scene is returned unchanged,
        a Run gives its scene.

    Returns
    -------
    Scene
        Change it with :meth:`Scene.replace`.

    Raises
    ------
    SceneError
        The name is unknown (the message proposes the nearest one), or the file is invalid.
    StoreError
        The store is damaged.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> fast = tehl.scene("gear").replace(srr=-0.12, **{"grid.nx": 128})
    >>> f"{fast.operation.u_a:.2f} m/s, {fast.grid.nx} cells"
    '7.99 m/s, 128 cells'
    """
    _use_plugins(name)
    from tehl_taichi.store.load_scene import find

    return find(name)


def run(scene: "Scene | Name", path: Name | None = None, *, force: bool = False, threads: int | None = None,
        arch: str | None = None, progress: "Progress | None" = None) -> "Run":
    """Run a scene into a new store, as `tehl run` does: steady start, passage, stresses, fatigue, error bars, summary.

    Parameters
    ----------
    scene : Scene, str or path
        A Scene, or a name that :func:`tehl_taichi.scene` loads.
    path : path, optional
        Folder of the store; default: runs/NAME-N.zarr with the first free N.
    force : bool
        Replace the store at `path`, once the new one has its first entry.
    threads : int, optional
        Threads of the CPU; default: those of an earlier start in this process, otherwise all.
    arch : str, optional
        "cpu"; "cuda" and "vulkan" are experimental. Default: the environment variable TEHL_ARCH, otherwise "cpu".
    progress : Progress, optional
        Receives stages, steps and warnings while the run lasts; default: silent.

    Returns
    -------
    Run
        The finished run.

    Raises
    ------
    SceneError, StoreError
        The input is invalid; nothing was written.
    RuntimeUnavailable
        This process already uses another number of threads.
    NotConverged
        A step failed; the steps before it are stored.
    Interrupted
        The disk is full or cannot be written; the store can be resumed.
    KeyboardInterrupt
        Ctrl-C; the message says what is stored.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
    >>> tehl.run(scene, "line.zarr")
    <tehl.Run smooth-line: 0 steps, finished, line.zarr>
    >>> run = tehl.run(scene, "line.zarr", force=True)
    >>> f"{run.summary['steady']['h_c_m'] * 1e6:.2f} um"
    '0.43 um'
    """
    _use_plugins(scene)
    from tehl_taichi.runs import single_run

    return single_run.run(scene, path, force=force, threads=threads, arch=arch, progress=progress)


def resume(path: Name, *, steps: int | None = None, threads: int | None = None, progress: "Progress | None" = None) -> "Run":
    """Resume an interrupted run, or extend a run that was stopped with `time.steps`.

    The run restarts from the last checkpoint, at most two seconds of work before its last stored step. Stresses, the fatigue
    search and the coarse-grid runs restart from their beginning.

    Parameters
    ----------
    path : path
        Folder of the store.
    steps : int, optional
        Number of further steps; default: to the end that the run was given, for a finished run to the end of its passage.
    threads, progress
        As for :func:`tehl_taichi.run`.

    Returns
    -------
    Run
        The finished run; unchanged where no step is left.

    Raises
    ------
    StoreError
        No store, a damaged store, a store of another version, or another process writes it. Further errors as for
        :func:`tehl_taichi.run`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 1})
    >>> tehl.run(scene, "begun.zarr")
    <tehl.Run gear: 1 step, finished, begun.zarr>
    >>> tehl.resume("begun.zarr", steps=1)
    <tehl.Run gear: 2 steps, finished, begun.zarr>
    """
    from tehl_taichi.runs import zoom_store

    return zoom_store.resume(path, steps=steps, threads=threads, progress=progress)


def zoom(path: Name, factor: int | str = 4, *, threads: int | None = None, progress: "Progress | None" = None) -> "Run":
    """Add a fine window that moves with the feature to a finished run; the steps of the run are kept.

    Stresses, the fatigue search and error bars are computed again with the window. Interrupted, `resume` finishes it.

    Parameters
    ----------
    path : path
        Folder of the store.
    factor : {4, 2, 8, 16, 0, "auto"}
        Cells of the window in a cell of the grid, along each axis; 0 removes the window; "auto": none where the grid resolves
        the passage, else 4, and 8 where 4 does not settle the largest pressure.
    threads, progress
        As for :func:`tehl_taichi.run`.

    Returns
    -------
    Run
        The run with the window; unchanged where it has this one already.

    Raises
    ------
    SceneError
        The scene has no passage, or not every step is stored.
    StoreError
        No store, a damaged or unfinished one, one of another version, or another process writes it.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("pitch-line").replace(**{"grid.nx": 64, "feature.length": float("inf"), "fatigue.on": False,
    ...                                            "thermal.on": False})
    >>> run = tehl.zoom(tehl.run(scene, "coarse.zarr").path, 2)
    >>> run.summary["zoom"]["factor"], run["p_max"].value > run.summary["zoom"]["base"]["p_max_Pa"]
    (2, True)
    """
    from tehl_taichi.runs import zoom_store

    return zoom_store.zoom(path, factor, threads=threads, progress=progress)


def open(path: Name) -> "Run | Study | Flank | Bearing | Cam":
    """Open stored results: the store of a run, the folder of a sweep, flank, bearing or cam, finished or not.

    Parameters
    ----------
    path : path
        The folder.

    Returns
    -------
    Run, Study, Flank, Bearing or Cam
        Depending on what the folder holds.

    Raises
    ------
    StoreError
        The folder holds none of them, or a damaged one.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> line = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
    >>> made = tehl.run(line, "made.zarr"), tehl.sweep(line, {"srr": [0.0]}, "swept.zarr", workers=1)
    >>> run, study = tehl.open("made.zarr"), tehl.open("swept.zarr")
    >>> run.finished, run.scene.name, run.store.fields(0)["pressure"].shape
    (True, 'smooth-line', (33, 1))
    >>> study
    <Study swept.zarr: 1 case, 1 converged>
    """
    from tehl_taichi.runs import open_results

    return open_results.open(path)


def march(scene: "Scene | Name", state: dict | None = None, precision: str | None = None) -> "Iterator[Snapshot]":
    """Iterate over the states of a run in memory: the steady start, then one snapshot per time step.

    Parameters
    ----------
    scene : Scene, str or path
        A Scene, or a name that :func:`tehl_taichi.scene` loads. Several scenes may be marched at the same time, in any order.
    state : dict, optional
        `snapshot.state` of the newest snapshot of an earlier march of this scene, from which to continue.
    precision : {"f32", "f64"}, optional
        Precision of the linear solves, in place of `numerics.precision` of the scene.

    Yields
    ------
    Snapshot
        Fields (nx+1, ny+1) and scalars in SI units.

    Raises
    ------
    SceneError
        At once: unknown precision, or a state of another scene (contact, oil, speeds, features, temperatures, grid).
    NotConverged
        A step failed; the snapshots before it are valid.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 2})
    >>> for snapshot in tehl.march(scene):
    ...     print(snapshot.step, snapshot.fields["film"].shape, f"{snapshot.scalars['p_max_Pa'] / 1e9:.2f} GPa")
    0 (65, 17) 1.93 GPa
    1 (65, 17) 1.93 GPa
    2 (65, 17) 1.93 GPa
    """
    of = _loaded(scene)
    from tehl_taichi.march import march

    return march(of, state, precision)


def simulate(scene: "Scene | Name", precision: str | None = None) -> "list[Snapshot]":
    """Run a scene in memory and return all its snapshots; for long runs use :func:`tehl_taichi.run`.

    Parameters
    ----------
    scene, precision
        As for :func:`tehl_taichi.march`.

    Returns
    -------
    list of Snapshot
        The steady start and every time step.

    Raises
    ------
    SceneError, NotConverged
        As for :func:`tehl_taichi.march`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> steady, = tehl.simulate(tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False}))
    >>> steady.fields["film"].shape, f"{steady.scalars['h_c_m'] * 1e6:.2f} um"
    ((33, 1), '0.43 um')
    """
    return list(march(scene, precision=precision))


@overload
def fatigue(of: "Run | Name | Sequence[Snapshot] | Iterator[Snapshot]", scene: "Scene | Name | None" = None, *,
            progress: Any = None, threads: int | None = None, until: float | None = None, **constants: Any
            ) -> "SearchResult": ...


@overload
def fatigue(of: Any, scene: "Scene | Name | None" = None, *, progress: Any = None, threads: int | None = None,
            until: None = None, **constants: Any) -> "Points": ...


def fatigue(of: Any, scene: "Scene | Name | None" = None, *, progress: Any = None, threads: int | None = None,
            until: float | None = None, **constants: Any) -> "SearchResult | Points":
    """Recompute the fatigue of a run with other constants, or compute that of snapshots or of given stress histories.

    Parameters
    ----------
    of : Run or path, sequence of Snapshot, or array
        A run (its store is not changed); snapshots of `scene`; or stresses in Pa of shape (points, times, 6), for one point
        also (times, 6): xx, yy, zz, xy, xz, yz with z normal to the surface.
    scene : Scene, str or path, optional
        Of a run: a scene that differs in [fatigue] only. Of snapshots: theirs. Of stresses: the scene whose constants are used.
    progress : Progress, optional
        Receives the parts of the search.
    threads : int, optional
        As for :func:`tehl_taichi.run`.
    until : float, optional
        Position of the feature in half-widths a: the largest index up to there is also reported, as "resolved" of the summary.
        Default for a run: where its grid no longer resolves the pressure.
    **constants
        Any key of section [fatigue]: kappa, endurance (Pa), criterion, depths (m), from_x and to_x (a), thermal_stress,
        residual_xx (Pa) ...; in place of endurance bending_limit or torsion_limit (Pa), both of them also fix kappa.

    Returns
    -------
    SearchResult or Points
        Points for given stresses.

    Raises
    ------
    SceneError
        A constant is out of range, no feature passes, or the stresses have another shape.
    StoreError
        No run at the path, or a damaged one.

    Notes
    -----
    Findley 1959; other criteria: `tehl laws`.

    Examples
    --------
    Reversed bending of 100 MPa along x, f = (sigma/2)(kappa + sqrt(1 + kappa^2)):

    >>> import numpy as np
    >>> import tehl_taichi as tehl
    >>> bending = np.zeros((3, 6))
    >>> bending[:, 0] = 100e6, -100e6, 0.0
    >>> found = tehl.fatigue(bending, kappa=0.3, endurance=400e6)
    >>> print(f"{found.f[0] / 1e6:.2f} MPa, Fi {found.Fi[0]:.3f}")
    67.20 MPa, Fi 0.168
    """
    from tehl_taichi.fatigue import fatigue

    return fatigue(_opened(of), _loaded(scene), progress=progress, threads=threads, until=until, **constants)


def stresses(pressure: Any, traction_x: Any = None, traction_y: Any = None, dx: float | None = None, dy: float | None = None,
             depths: Any = 0.0, nu: float = 0.3) -> "np.ndarray":
    """Compute the stresses in an elastic half-space under given tractions on a uniform grid of its surface.

    The half-space is z >= 0 with z into the body. Each value acts on the rectangle around its node; outside the grid nothing
    acts. One-dimensional loads act on an endless line contact (plane strain).

    Parameters
    ----------
    pressure : array (nx,) or (nx, ny)
        Pressure in Pa, positive in compression.
    traction_x, traction_y : array like `pressure`, optional
        Shear tractions on this body in Pa; default: none. A line contact has no traction_y.
    dx, dy : float
        Distances of the nodes along x and y in m, or text as "10 um"; dy of two-dimensional loads only (default: dx).
    depths : float or sequence of float
        Depths in m, or texts as "10 um"; 0 is the surface.
    nu : float
        Poisson's ratio.

    Returns
    -------
    array (nx, depths, 6) or (nx, ny, depths, 6)
        xx, yy, zz, xy, xz, yz in Pa, tension positive, at the nodes; without the axis of depths where `depths` is a number.

    Raises
    ------
    SceneError
        Shapes do not agree, a value is not finite, or a number is out of range.

    Notes
    -----
    Rectangles of Boussinesq and Cerruti (Love 1929; Johnson, Contact Mechanics, chapters 2 and 3), summed by FFT.

    Examples
    --------
    A Hertz line contact on its axis at z = a, sigma_zz = -p0/sqrt(2):

    >>> import numpy as np
    >>> import tehl_taichi as tehl
    >>> x = np.linspace(-2, 2, 401)
    >>> p = 1e9 * np.sqrt(np.maximum(1 - x**2, 0))
    >>> found = tehl.stresses(p, dx=0.01, depths=[0.0, 1.0])
    >>> found.shape, f"{found[200, 1, 2] / 1e9:.4f} GPa"
    ((401, 2, 6), '-0.7070 GPa')
    """
    from tehl_taichi.fatigue.stress import given_tractions

    return given_tractions.stresses(pressure, traction_x, traction_y, dx, dy, depths, nu)


def crack(of: Any, scene: "Scene | Name | None" = None, *, thermal_stress: bool | None = None, threads: int | None = None,
          **options: Any) -> "CrackResult":
    """Follow cracks of one body from both sides of the feature under the loads of its passage.

    Parameters
    ----------
    of : Run or path, or sequence of Snapshot
        A run (its store is not changed), or snapshots of `scene`.
    scene : Scene, str or path, optional
        Scene of the snapshots.
    thermal_stress : bool, optional
        Include the thermal stress; default: as in the scene.
    threads : int, optional
        As for :func:`tehl_taichi.run`.
    **options
        surface ("a", "b", "worse": the body of the verdict on fatigue), side ("entry", "exit", "both"), start (m), angle
        (degrees), first, step, length, distance (m), threshold (Pa sqrt(m)), residual (Pa), face_friction, oil,
        elements; see :class:`tehl_taichi.crack.crack_options.CrackOptions`.

    Returns
    -------
    CrackResult
        Its `summary` holds the numbers, `sides` the paths.

    Raises
    ------
    SceneError
        No feature passes, y = 0 is no plane of symmetry, the body is at rest, or an option is out of range.
    StoreError
        No run at the path, or a damaged one.

    Notes
    -----
    Hannes & Alfredsson 2011 (trajectories), Hills, Kelly, Dai & Korsunsky 1996 (cracks as dislocations), Erdogan & Sih 1963
    (growth).

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.crack([], tehl.scene("gear"), side="left")
    Traceback (most recent call last):
    ...
    tehl_taichi.errors.SceneError: side = 'left' is not known; allowed: entry, exit, both (did you mean 'exit'?)
    """
    from tehl_taichi.crack import crack

    return crack(_opened(of), _loaded(scene), thermal_stress=thermal_stress, threads=threads, **options)


def sweep(scene: "Scene | Name", over: Mapping, path: Name | None = None, *, samples: int | None = None,
          seed: int | None = None, workers: int | None = None, threads_per_worker: int | None = None, scheduler: Any = None,
          keep: str = "stores", progress: Callable | None = None) -> "Study":
    """Run a scene with all combinations of changes, on several processes.

    A case that does not converge, is refused or loses its worker is stored with its reason; the other cases run. The same call
    resumes an interrupted sweep and does not repeat finished cases. Workers import the calling script: put its calls below
    `if __name__ == "__main__":`.

    Parameters
    ----------
    scene : Scene, str or path
        A Scene, or a name that :func:`tehl_taichi.scene` loads.
    over : mapping
        {key: values}; values as a list, an array or a range "low:high:n". A tuple of keys with rows of values changes these
        keys together.
    path : path, optional
        Folder of the study; default: runs/NAME.zarr, the same for the same sweep.
    samples, seed : int, optional
        Draw that many cases of a Latin hypercube in place of all combinations; values are "low:high" or a list of choices.
    workers : int, optional
        Number of processes; default: one per core. 1 runs the cases in this process.
    threads_per_worker : int, optional
        Threads of each case; default: 1, or the cores that `workers` leave.
    scheduler : str or distributed.Client, optional
        Address of a Dask scheduler, in place of local processes.
    keep : {"stores", "summary"}
        "summary" keeps no store of the cases.
    progress : callable, optional
        progress(study, record): called with None at the start, then with the record of each finished case.

    Returns
    -------
    Study
        The table of all cases.

    Raises
    ------
    SceneError
        No case can run with these changes.
    StoreError
        The folder holds another study, or cannot be written.
    Interrupted
        The disk refused a result; the same call resumes.
    RuntimeUnavailable
        A scheduler is given and Dask is not installed.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> line = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
    >>> tehl.sweep(line, {"srr": [0.0, 0.2], "speed": "5:15:2"}, "study.zarr", workers=1)
    <Study study.zarr: 4 cases, 4 converged>
    >>> study = tehl.sweep(line, {"srr": [0.0, 0.2], "speed": "5:15:2"}, "study.zarr", workers=1)  # no case is left to run
    >>> study.values["steady_h_c_m"].shape, study.results()[3]["changes"]
    ((4,), {'srr': 0.2, 'speed': 15})
    """
    _use_plugins(scene)
    from tehl_taichi.runs.sweep import sweeping

    return sweeping.sweep(scene, over, path, samples=samples, seed=seed, workers=workers, threads_per_worker=threads_per_worker,
                      scheduler=scheduler, keep=keep, progress=progress)


def flank(gear: "Name | GearPair" = "fzg-c", *, torque: float | None = None, speed: float | None = None,
          on: str | None = None, positions: int | None = None, at: Sequence[str | float] = (),
          scene: "Scene | Name | None" = None, changes: dict | None = None, steady: bool = False,
          folder: Name | None = None, workers: int | None = None, threads: int | None = None,
          progress: "Progress | None" = None) -> "Flank":
    """Compute film, pressure, temperatures and fatigue along a gear flank, one run per mesh position.

    Workers import the calling script: put its calls below `if __name__ == "__main__":`.

    Parameters
    ----------
    gear : str, path or GearPair
        "fzg-c", "fzg-a", a TOML or CSV file, or a GearPair.
    torque, speed : float, optional
        Torque (N m) and speed (1/min) of the pinion, in place of those of the gear pair.
    on : {"pinion", "gear"}, optional
        The flank that carries the feature.
    positions : int, optional
        Number of mesh positions.
    at : sequence, optional
        Mesh positions: letters ("C", "B-") or positions x_pl along the path of contact in m.
    scene : Scene, str or path, optional
        Everything but contact and speeds; default: the scene that the file names, otherwise "gear".
    changes : dict, optional
        Changes of that scene, as for :meth:`Scene.replace`.
    steady : bool
        Without a feature.
    folder : path, optional
        Folder of stores and results; default: runs/NAME-N. An existing flank is resumed.
    workers, threads : int, optional
        Number of processes (default: one per core; 1 runs in this process) and threads of each (default: the cores that
        `workers` leave).
    progress : Progress, optional
        As for :func:`tehl_taichi.run`.

    Returns
    -------
    Flank
        :attr:`Flank.failed` lists the positions without a result.

    Raises
    ------
    SceneError, StoreError
        The input is invalid; nothing was run.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> pitch = tehl.flank("fzg-c", at=["C"], steady=True, changes={"grid.nx": 64, "thermal.on": False}, folder="pitch")
    >>> pitch
    <tehl.Flank fzg-c: 1 of 1 position, pitch>
    >>> pitch.positions[0].srr, round(pitch.positions[0].R * 1e3, 2)
    (0.0, 8.38)
    >>> tehl.flank("fzg-c", torque=0)
    Traceback (most recent call last):
    ...
    tehl_taichi.errors.SceneError: gear.torque = 0 N m is out of range; allowed: more than 0 N m and at most 1e+08 N m
    """
    _use_plugins(gear, scene)
    from tehl_taichi.runs.flank.flank_run import flank

    return flank(gear, torque=torque, speed=speed, on=on, positions=positions, at=at, scene=scene, changes=changes,
                 steady=steady, folder=folder, workers=workers, threads=threads, progress=progress)


def bearing(what: "Name | int | RollingBearing", *, load: float | None = None, axial: float | None = None,
            speed: float | None = None, dimensions: dict | None = None, on: str = "inner", feature: "Feature | None" = None,
            roughness: float | None = None, scene: "Scene | Name | None" = None, changes: dict | None = None,
            steady: bool = False, run: bool = True, folder: Name | None = None, workers: int | None = None,
            threads: int | None = None, progress: "Progress | None" = None) -> "Bearing":
    """Compute a rolling bearing: load of every element, contacts of the most loaded one with both rings, a run of each.

    Workers import the calling script: put its calls below `if __name__ == "__main__":`.

    Parameters
    ----------
    what : str, int, path or RollingBearing
        A designation ("6206" or 6206), a TOML file, or a RollingBearing.
    load, axial : float, optional
        Radial and axial load in N.
    speed : float, optional
        Speed of the inner ring in 1/min.
    dimensions : dict, optional
        Further keys of :class:`tehl_taichi.RollingBearing`, in place of those of the designation.
    on : {"inner", "outer"}
        The ring that carries the features.
    feature : Feature, optional
        A dent or scan that passes; default: the features of `scene`, none without a scene.
    roughness : float, optional
        Rms height in m of both surfaces together, for lambda.
    scene : Scene, str or path, optional
        Oil, bodies, features and numerics; default: the scene that the file names, otherwise "gear" without its feature.
    changes : dict, optional
        Changes of that scene, as for :meth:`Scene.replace`.
    steady : bool
        Without features.
    run : bool
        False: loads, dry contacts and formulas only.
    folder : path, optional
        Folder of stores and results; default: runs/NAME-N. An existing bearing is resumed.
    workers, threads : int, optional
        As for :func:`tehl_taichi.flank`.
    progress : Progress, optional
        As for :func:`tehl_taichi.run`.

    Returns
    -------
    Bearing
        :attr:`Bearing.rings` holds the contacts with their summaries.

    Raises
    ------
    SceneError, StoreError
        The input is invalid; nothing was run.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> found = tehl.bearing("6206", load=5000.0, speed=3000.0, run=False, folder="b6206")
    >>> found
    <tehl.Bearing 6206: p_H 3.06 GPa inner, 2.75 GPa outer, b6206>
    >>> f"{found.record['ball_load_max_N']:.0f} N, static safety {found.record['inner']['static_safety']:.1f}"
    '2436 N, static safety 2.6'
    """
    _use_plugins(what, scene)
    from tehl_taichi.runs.bearing.bearing_run import bearing

    return bearing(what, load=load, axial=axial, speed=speed, dimensions=dimensions, on=on, feature=feature,
                   roughness=roughness, scene=scene, changes=changes, steady=steady, run=run, folder=folder, workers=workers,
                   threads=threads, progress=progress)


def cam(table: Name, *, feature: "Feature | None" = None, scene: "Scene | Name | None" = None, changes: dict | None = None,
        steady: bool = False, folder: Name | None = None, workers: int | None = None, threads: int | None = None,
        progress: "Progress | None" = None) -> "Cam":
    """Compute the line contacts of a cam and its follower at every angle of a table.

    Workers import the calling script: put its calls below `if __name__ == "__main__":`.

    Parameters
    ----------
    table : str or path
        CSV with the columns angle_deg, load_N_per_mm, R_mm (or R_a_mm and R_b_mm), u_a_m_s, u_b_m_s.
    feature : Feature, optional
        A dent or scan of the cam that passes at every angle.
    scene, changes, steady, folder, workers, threads, progress
        As for :func:`tehl_taichi.bearing`.

    Returns
    -------
    Cam
        :attr:`Cam.failed` lists the angles without a result.

    Raises
    ------
    SceneError, StoreError
        The input is invalid; nothing was run.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.cam("cycle.csv", changes={"oil.name": "mineral-vg100"})
    Traceback (most recent call last):
    ...
    tehl_taichi.errors.SceneError: cannot read table cycle.csv: No such file or directory
    """
    _use_plugins(scene)
    from tehl_taichi.runs.cam.cam_run import cam

    return cam(table, feature=feature, scene=scene, changes=changes, steady=steady, folder=folder, workers=workers,
               threads=threads, progress=progress)


def traction(scene: "Scene | Name", srr: Any = "0:0.5:11", temperature: Any = None, speed: Any = None, *,
             load: Any = None, hertz_pressure: Any = None, changes: dict | None = None, path: Name | None = None,
             workers: int | None = None, threads_per_worker: int | None = None,
             progress: "Callable | None" = None) -> "Traction":
    """Compute traction curves of a steady contact: friction, film and temperature over slip, speed, load and inlet temperature.

    Workers import the calling script: put its calls below `if __name__ == "__main__":`.

    Parameters
    ----------
    scene : Scene, str or path
        A Scene, or a name that :func:`tehl_taichi.scene` loads; its features are left out.
    srr, temperature, speed : list or str, optional
        Slide-roll ratios, inlet temperatures in deg C and mean speeds in m/s: lists, or text as "low:high:N",
        "low:high:N:log" or "a,b,c", with units as in "0:50%:11"; default of temperature and speed: that of the scene.
    load, hertz_pressure : float, list or str, optional
        Loads in N (line contact: N/m), or Hertz pressures in Pa, likewise.
    changes : dict, optional
        Changes of the scene, as for :meth:`Scene.replace`. Temperatures are computed in all cases unless "thermal.on" says
        otherwise.
    path : path, optional
        The study; default: runs/NAME-traction-ID.zarr. An existing one is resumed.
    workers, threads_per_worker, progress
        As for :func:`tehl_taichi.sweep`.

    Returns
    -------
    Traction
        `rows`, `curves`, `plot(folder)`.

    Raises
    ------
    SceneError, StoreError
        The input is invalid; nothing was run.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> line = tehl.scene("smooth-line").replace(**{"grid.nx": 32})
    >>> found = tehl.traction(line, srr=[0.05, 0.1], path="curve.zarr", changes={"thermal.on": False}, workers=1)
    >>> [f"{row['srr']}: {row['friction_coefficient']:.3f}" for row in found.rows]
    ['0.05: 0.073', '0.1: 0.076']
    """
    _use_plugins(scene)
    from tehl_taichi.runs.traction.traction_run import traction

    return traction(scene, srr, temperature, speed, load=load, hertz_pressure=hertz_pressure, changes=changes, path=path,
                    workers=workers, threads_per_worker=threads_per_worker, progress=progress)


def compare(*paths: "Name | Run | Study | ContactSet") -> "Comparison | PlaceComparison":
    """Compare two or more results of one kind: differences of their settings, their numbers side by side, one figure.

    Parameters
    ----------
    *paths : path, Run, Study, Flank, Bearing or Cam
        Two to eight runs, flanks, bearings, cams, or studies over the same keys; finished or not.

    Returns
    -------
    Comparison or PlaceComparison
        `differs`, `plot(path)`; of runs `summaries`, of others `rows`, a quantity at a position each.

    Raises
    ------
    SceneError
        Fewer than two, or too many; results of two kinds; studies over different keys.
    StoreError
        A path has no result, or is given twice.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 64, "thermal.on": False})
    >>> slow, fast = (tehl.run(scene.replace(speed=u), f"{u:g}.zarr") for u in (5, 10))
    >>> found = tehl.compare(slow, fast)
    >>> found.differs
    {'operation.u_m': [5.0, 10.0]}
    >>> thin, thick = found.summaries["steady.h_c_m"]
    >>> thin < thick
    True
    """
    from tehl_taichi.runs.compare import compare

    return compare(*paths)


def export(of: "Name | Run", format: str = "csv", path: Name | None = None, *, at: float | Sequence[float] = (),
           point: Sequence = (), force: bool = False) -> Path:
    """Write a stored run for other tools, as `tehl export` does.

    Parameters
    ----------
    of : Run or path
        The run or its store, finished or not.
    format : {"csv", "netcdf", "vtk"}
        csv: a folder of tables; netcdf: a file; vtk: a folder with passage.pvd.
    path : path, optional
        File or folder to write; default: beside the store, named after it.
    at : float or sequence of float
        csv: positions of the feature in half-widths a for the centrelines; default: 0.
    point : (x, y) or sequence of (x, y)
        csv: points of the surface with the first feature, whose history is written; m, or text as "10 um", measured as
        feature.x and feature.y.
    force : bool
        Replace an earlier export.

    Returns
    -------
    pathlib.Path
        The file or folder written.

    Raises
    ------
    SceneError
        The run or the format does not have the requested part.
    StoreError
        No store, the path is taken, it cannot be written, or xarray is missing.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
    >>> made = tehl.export(tehl.run(scene, "line.zarr"), "csv")
    >>> made.name, sorted(file.name for file in made.iterdir())
    ('line-csv', ['centreline_steady.csv', 'series.csv'])
    >>> print((made / "centreline_steady.csv").read_text()[:42])
    x [m],contact [1],film [m],pressure [Pa],t
    """
    from tehl_taichi.view.export import export

    return export(of, format, path, at=at, point=point, force=force)


def report(of: Any, out: Name | None = None, *, force: bool = False, progress: Any = None, threads: int | None = None,
           pages: bool = False, **constants: Any) -> Path:
    """Write one self-contained HTML page of a run, study, flank, bearing or cam, as `tehl report` does.

    Parameters
    ----------
    of : Run, Study, Flank, Bearing, Cam or path
        The results or their folder.
    out : path, optional
        The file, with the ending .html or none; default: beside the folder.
    pages : bool
        Of a flank or a cam: also write the page of every position, beside its store.
    force : bool
        Replace an existing page.
    progress, threads
        Of the fatigue search, where constants are given.
    **constants
        Of a run: the page shows the fatigue with these constants of section [fatigue], see :func:`tehl_taichi.fatigue`; the
        store is not changed.

    Returns
    -------
    pathlib.Path
        The page.

    Raises
    ------
    StoreError
        No results in the folder, no run where constants are given, jinja2 or plotly missing, or the file exists.
    SceneError
        A constant is out of range, or `out` has the ending of another format.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False})
    >>> tehl.report(tehl.run(scene, "line.zarr")).name
    'line.html'
    """
    from tehl_taichi.report.write import report

    return report(of, out, force=force, progress=progress, threads=threads, pages=pages, **constants)


def animate(source: "Name | Run", out: Name | None = None, *, format: str | None = None, frames: int = 120, fps: int = 15,
            dpi: int = 110, width: float = 17.0, shown: str = "film", force: bool = False,
            progress: Callable[[int, int], None] | None = None) -> Path:
    """Write an animation of a run: pressure, film and temperatures along the centreline, and a map.

    Parameters
    ----------
    source : Run or path
        The run or its store, finished or not.
    out : path, optional
        The file; default: beside the store.
    format : {"gif", "mp4"}, optional
        Default: the ending of `out`, otherwise gif. mp4 needs ffmpeg.
    frames : int
        At most that many, evenly over the passage, 2 to 2000.
    fps : int
        Frames per second, 1 to 50.
    dpi : int
        Dots per inch, 40 to 1200.
    width : float
        Width in cm, 5 to 60, or text as "170 mm".
    shown : {"film", "pressure", "temperature"}
        The map.
    force : bool
        Replace the file.
    progress : callable, optional
        progress(done, total), called after each frame.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    SceneError
        A number is out of range.
    StoreError
        The run is steady, or the file cannot be written.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("furrow-line").replace(**{"grid.nx": 64, "thermal.on": False, "time.steps": 2, "fatigue.on": False})
    >>> tehl.animate(tehl.run(scene, "furrow.zarr"), dpi=40).name
    'furrow.gif'
    """
    from tehl_taichi.view.figures.animation import animate

    return animate(source, out, format=format, frames=frames, fps=fps, dpi=dpi, width=width, shown=shown, force=force,
                   progress=progress)
