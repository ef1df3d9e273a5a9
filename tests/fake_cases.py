"""Case functions without a solver, importable by workers."""

from pathlib import Path


def formula(job):
    """A made-up result whose numbers tell its changes; high features at SRR 0 do not converge, the error of Fi is known of the
    lowest alone."""
    height, srr = job.scene.features[0].height, job.scene.operation.srr
    if srr == 0 and height > 1.2e-6:
        return {"status": "not converged", "reason": "made up", "summary": None, "seconds": 0.1}
    return {"status": "converged", "reason": "", "seconds": 0.1, "summary": {
        "wall_s": 1.0, "steady": {"h_c_m": 4e-7, "error": {"h_c_m": None}},
        "transient": {"h_min_m": 3e-7 - 0.1 * height, "p_max_Pa": 2e9 + 1e15 * height},
        "fatigue": {"Fi_max": 0.5 + 3e5 * height - srr, "error": {"Fi_max": 0.04 if height < 0.6e-6 else None}},
        "left_out": ["words"]}}


def position(job):
    """A made-up film of a position; that of A does not converge, over that of E its worker is lost."""
    point = job.scene.name.rpartition("-")[2]
    if point == "E":
        raise MemoryError("no room")
    if point == "A":
        return {"status": "not converged", "reason": "made up", "summary": None, "seconds": 0.1}
    return {"status": "converged", "reason": "", "seconds": 0.1, "summary": {"steady": {"h_c_m": job.scene.contact.radius_x}}}


def unfinished(job):
    """A first case with a result; the others begin their store and take long."""
    import time

    from tehl_taichi.store.store_draft import CaseDraft

    part = Path(job.store).parent / ".0001.zarr.part"
    if job.store.endswith("0000.zarr"):
        while not part.exists():
            time.sleep(0.01)
        return formula(job)
    with CaseDraft(job.store):
        time.sleep(60)


def square(job):
    """Its square; a job below 0 is an error."""
    if job < 0:
        raise ValueError(f"{job} has no place here")
    return job**2


def cubed(job):
    """The cube of (number, folder); the process dies over 13 as often as `folder` has room for: twice."""
    import os

    number, folder = job
    deaths = len(list(Path(folder).iterdir()))
    if number == 13 and deaths < 2:
        (Path(folder) / str(deaths)).touch()
        os._exit(1)
    return number**3


def sockets(folder):
    """Tells which ports this worker listens on, then works for long."""
    import json
    import os
    import time

    mine = {os.readlink(path) for path in map(str, Path("/proc/self/fd").iterdir()) if os.path.lexists(path)}
    rows = [line.split() for name in ("tcp", "tcp6") for line in Path(f"/proc/net/{name}").read_text().splitlines()[1:]]
    listening = [row[1] for row in rows if row[3] == "0A" and f"socket:[{row[9]}]" in mine]
    draft = Path(folder) / f"{os.getpid()}.tmp"
    draft.write_text(json.dumps({"pid": os.getpid(), "listening": listening}))
    draft.rename(draft.with_suffix(".json"))
    time.sleep(600)


def greedy(megabytes):
    """Holds so much memory for a while."""
    import time

    held = bytearray(megabytes * 10**6)
    for n in range(0, len(held), 4096):
        held[n] = 1
    time.sleep(2 if megabytes > 100 else 0)
    return megabytes


def rough_search(p99=1.2):
    """A made-up summary of the search of a rough surface."""
    top = {"share_above_1": 0.12, "median": 0.7, "p90": 1.0, "p99": p99, "points": 130, "cycles_above_1": 0.2,
           "error": {"p99": 0.1, "share_above_1": 0.05}}
    deep = {**top, "p99": 1.4, "depth_m": 7e-6, "by_depth": [], "error": {}}
    return {"surface": "b", "rough": True, "Fi_max": 1.7, "statistics": top,
            "below": {"Fi_max": 2.0, "depth_m": 5e-6, "statistics": deep}}
