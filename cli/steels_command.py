"""tehl steels: the named steels."""

from tehl_cli.tables import list_table, print_wrapped


def steels():
    """List the named steels with their numbers and sources."""
    from tehl_taichi.scene.named_steels import STEELS

    rows = [(name, f"{n['E'] / 1e9:g}", f"{n['nu']:g}", f"{n['k']:g}", f"{n['rho']:g}", f"{n['c']:g}", f"{n['alpha']:.4g}")
            for name, steel in STEELS.items() for n in (steel.numbers,)]
    list_table("named steels (--set bodies.a.material=NAME)",
               ("name", "E GPa", "nu", "k W/mK", "kg/m3", "J/kgK", "alpha 1/K"), rows)
    for name, steel in STEELS.items():
        print_wrapped(f"{name}: {steel.says}; {steel.source}")
