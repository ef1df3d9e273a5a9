"""Figure of a bearing: loads of the elements around the ring; Hertz pressure and slip across both contacts."""

import numpy as np

from tehl_taichi.view.figures import palette

LOADS, AZIMUTH, ACROSS = "load of the elements (N)", "azimuth from the load (degrees)", "y across rolling (mm)"
POINTS = 201


def drawn(page, bearing):
    """The matplotlib Figure of a Bearing."""
    slips = has_slip(bearing)
    figure, axes = page.figure(3 if slips else 2)
    _loads(axes[0, 0], bearing)
    for ax, (label, lines) in zip(axes[1:, 0], ((("Hertz pressure (GPa)"), pressures(bearing)), ("slip (m/s)", slip(bearing)))):
        for (name, (x, y)), colour in zip(lines.items(), palette.LINES):
            ax.plot(x, y, color=colour, label=f"{name} ring")
        ax.set_ylabel(label)
        ax.set_xlabel(ACROSS)
        ax.grid()
        ax.legend()
    page.title(figure, bearing.title)
    return figure


def _loads(ax, bearing):
    azimuth, loads = azimuths(bearing)
    ax.bar(azimuth, loads, width=0.5 * 360 / len(loads), color=palette.LINES[0])
    ax.set_ylabel(LOADS)
    ax.set_xlabel(AZIMUTH)
    ax.set_axisbelow(True)
    ax.grid(axis="y")


def azimuths(bearing):
    """Azimuths (-180 to 180 degrees, rising) and loads (N) of the elements."""
    azimuth = (np.array(bearing.record["azimuths_deg"]) + 180) % 360 - 180
    order = np.argsort(azimuth)
    return azimuth[order], np.array(bearing.record["loads_N"])[order]


def has_slip(bearing):
    """Whether the elements are balls, whose contacts slip."""
    return any(ring["slip"] for ring in bearing.rings.values())


def pressures(bearing):
    """{ring: (y in mm, Hertz pressure in GPa)} along the middle of both contacts; constant along straight rollers."""
    out = {}
    for name, ring in bearing.rings.items():
        y = np.linspace(-1, 1, POINTS)
        shape = np.ones(POINTS) if ring["R_y_m"] is None else np.sqrt(1 - y**2)
        out[name] = y * ring["b_m"] * 1e3, ring["p_Hertz_Pa"] * 1e-9 * shape
    return out


def slip(bearing):
    """{ring: (y in mm, slip of the ring relative to the element in m/s)}."""
    return {name: (np.array(ring["slip"]["y_m"]) * 1e3, np.array(ring["slip"]["slip_m_s"]))
            for name, ring in bearing.rings.items() if ring["slip"]}
