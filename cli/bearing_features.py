"""Features of a raceway or a cam from `--dent` and `--scan`."""

from tehl_cli.amount import amount, metres

from tehl_taichi.errors import SceneError

DENT = "DEPTH,WIDTH,rim=HEIGHT in m, as in 10e-6,0.3e-3,rim=1.2e-6 or 10um,0.3mm,rim=1.2um"


def dent_of(text):
    """Feature of a --dent. Raises SceneError."""
    from tehl_taichi.scene.feature import Feature

    plain, named = _parts(text)
    rim = named.get("rim", 0.0)
    keys = {"height": -abs(plain[0]), "width": plain[1]}
    if not rim and "rim_width" not in named:
        return Feature(**keys)
    return Feature(shape="dent", **keys, **named)


def _parts(text):
    """([depth, width], {key: value}) of a --dent."""
    pairs = [part.rpartition("=") for part in text.split(",")]
    plain = [metres("--dent", amount(value)) for key, _, value in pairs if not key]
    named = {key.strip(): metres("--dent", amount(value)) for key, _, value in pairs if key}
    if len(plain) + len(named) < len(pairs):
        raise SceneError(f"--dent {text!r} gives a value twice; it has the form {DENT}")
    if len(plain) != 2 or named.keys() - {"rim", "rim_width"}:
        raise SceneError(f"--dent {text!r} must have the form {DENT} (rim_width=WIDTH may follow)")
    return plain, named


def scan_of(path, unit, pixel):
    """Feature of a --scan: a map or a profile with its form removed and its rim faded out."""
    from tehl_taichi.scene.feature import Feature
    from tehl_taichi.scene.scan_scene import scan_keys

    return Feature(**scan_keys(path, unit or "", metres("--pixel", pixel, 0.0)))


def feature_of(dent, scan, unit, pixel):
    """Feature of --dent or --scan, None without them."""
    if dent is not None and scan is not None:
        raise SceneError(f"--dent {dent} and --scan {scan} contradict each other: give one of them")
    for word, value in (("--unit", unit), ("--pixel", pixel)):
        if value is not None and scan is None:
            raise SceneError(f"{word} {value} has no effect without --scan")
    return dent_of(dent) if dent is not None else scan_of(scan, unit, pixel) if scan is not None else None
