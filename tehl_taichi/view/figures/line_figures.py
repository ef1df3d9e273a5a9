"""Lines along x in the row :attr:`Moments.line`: pressure and film, temperatures, temperatures across the film."""


from tehl_taichi.scene.feature_wording import carriers, feature_word
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.view.figures import palette
from tehl_taichi.view.figures.zoom_lines import ZoomLines

ALONG = "x / a (flow to the right)"
SURFACES: tuple[tuple[str, str, str], ...] = (
    ("temperature_mid", "mid-film", "-"), ("temperature_a", "surface a", "--"), ("temperature_b", "surface b", ":"))
ACROSS = (-1.0, -0.5, 0.0, 0.5, 1.0)  # x / a at which profiles are drawn


def carrier(scene):
    """Text of the surface that carries the passing feature; "" without a passage."""
    verb = "carry" if all(surface.features for surface in scene.surfaces) else "carries"
    return f"{carriers(scene)} {verb} the {feature_word(scene)}" if scene.transient else ""


def set_title(page, figure, moments, what, shown, more=""):
    """Set the title: scene, moment if there is one, then `more`."""
    alone = f", {moments.says(shown[0])}" if len(shown) == 1 else ""
    page.title(figure, f"{moments.named}: {what}{alone}{'; ' * bool(more)}{more}")


def start_style(colour):
    """Line style of a moment: the steady start (grey) is dashed, and above the other moments, which would hide it where nothing
    has changed.
    """
    return dict(ls="--", zorder=3) if colour == palette.GREY else dict(ls="-", zorder=2)


def centreline(page, moments):
    """Figure of pressure and film for several feature positions."""
    store, row, shown = moments.store, moments.line, moments.several()
    figure, ((top,), (low,)) = page.figure(2, sharex=True)
    window, zoomed = ZoomLines(store, row), False
    for n, (colour, label) in shown.items():
        f = store.fields(n, ("pressure", "film"))
        zoomed |= window.draw((top, low), n, moments.a, colour)
        style = dict(label=label, color=colour, **start_style(colour))
        top.plot(moments.x, f["pressure"][:, row] / 1e9, **style)
        low.plot(moments.x, f["film"][:, row] * 1e6, **style)
    top.set(ylabel="pressure (GPa)")
    low.set(ylabel="film (µm)", xlabel=ALONG, ylim=(0, 1e6 * moments.film_top(shown)), xlim=moments.window)
    for ax in (top, low):
        ax.grid()
    if len(shown) > 1:
        page.legend(figure)
    set_title(page, figure, moments, moments.along, list(shown), "thick: zoom window" * zoomed)
    return figure


def temperature(page, moments):
    """Figure of mid-film and surface temperatures for several feature positions: a colour per position, a line style per
    kind.
    """
    from matplotlib.lines import Line2D

    store, row, shown = moments.store, moments.line, moments.several()
    figure, ((ax,),) = page.figure(height=1.6 * page.row())
    for n, (colour, _) in shown.items():
        f = store.fields(n, [name for name, *_ in SURFACES])
        for name, _, style in SURFACES:
            ax.plot(moments.x, f[name][:, row], ls=style, color=colour, zorder=start_style(colour)["zorder"])
    ax.set(xlabel=ALONG, ylabel="temperature (°C)", xlim=moments.window)
    ax.grid()
    when = [Line2D([], [], color=colour, label=label) for colour, label in shown.values()]
    kinds = [Line2D([], [], color=palette.BLACK, ls=style, label=text) for _, text, style in SURFACES]
    page.legend(figure, (when if len(shown) > 1 else []) + kinds)
    set_title(page, figure, moments, f"temperatures {moments.along}", list(shown), carrier(store.scene))
    return figure


def profiles(page, moments):
    """Figure of the temperature across the film at several x."""
    store, n = moments.store, moments.one()
    T = store.fields(n, ["temperature"])["temperature"][:, moments.line]
    figure, ((ax,),) = page.figure(height=1.6 * page.row())
    for X in ACROSS:
        ax.plot(T[nearest_index(moments.x, X)], store.map("zeta"), "o-", label=f"x = {X:+.1f} a")
    ax.set(xlabel="temperature (°C)", ylabel="z / h (0: surface a, 1: surface b)")
    ax.grid()
    page.legend(figure)
    what = "across the film" + ("" if moments.half else f" {moments.along}")
    set_title(page, figure, moments, what, [n], carrier(store.scene))
    return figure
