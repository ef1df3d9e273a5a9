"""Distribution of the index over rough surfaces: share of the surface that exceeds a value."""

from tehl_taichi.fatigue.index_statistics import QUANTILES, exceeded
from tehl_taichi.view.figures import palette

TICKS = (0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)  # %


def curves(result):
    """[(label, Fi, share of the surface above it)] of each searched body, the worse one first."""
    several, out = result.other is not None, []
    for name, one in result.by_surface.items():
        if one.Fi is not None and one.passed is not None:
            out.append((f"surface {name}" if several else "surface", *exceeded(one.Fi, one.passed)))
    return out


def has_distribution(result):
    """Whether the run has rough surfaces to draw."""
    return bool(result.numbers.get("rough")) and bool(curves(result))


def distribution_figure(page, found):
    """Figure of the share of the surfaces above an index, with the percentiles of the summary, on a logarithmic axis."""
    figure, axes = page.figure(1, 1, height=2.0 * page.row())
    ax = axes.ravel()[0]
    handles = []
    for label, Fi, share in curves(found.result):
        line, = ax.step(Fi, 100 * share, where="post", label=label)
        handles.append(line)
        numbers = found.result.by_surface.get(label[-1:], found.result).numbers["statistics"]
        for name, level in QUANTILES.items():
            ax.plot(numbers[name], 100 * (1 - level), "o", color=line.get_color(), ms=4)
    limit = ax.axvline(1.0, color=palette.GREY, ls="--", label="fatigue limit, Fi = 1")
    ax.set(xlabel="index Fi", ylabel="share of the surface above it (%)", yscale="log", ylim=(0.2, 100))
    ax.set_yticks(TICKS, [f"{tick:g}" for tick in TICKS])
    ax.minorticks_off()
    ax.grid()
    page.legend(figure, [*handles, limit])
    page.title(figure, f"{found.constants}; dots: median, 90th and 99th percentile")
    return figure
