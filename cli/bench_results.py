"""What a suite gives: tables for people or one JSON object, both in files beside a picture."""

from tehl_cli.live import say
from tehl_cli.out import print_json


def table(title, rows, columns):
    """Print rows (dictionaries) as {key: format} says; a value that is not known is left empty."""
    from tehl_cli.listing import list_table

    list_table(title, columns, [[form.format(row[key]) if row.get(key) is not None else "" for key, form in columns.items()]
                                for row in rows])


def finish(folder, name, rows, chart, as_json, **more):
    """Write NAME.json (machine, rows and what else is given) and NAME.png; print the JSON object where it is asked for.

    chart(plt): the figure.
    """
    from tehl_taichi.profiles import measure

    found = measure.result(rows, **more)
    say(f"wrote {measure.save(folder, name, found)}")
    picture(folder, name, chart)
    if as_json:
        print_json(found)


def picture(folder, name, chart):
    """Write NAME.png where matplotlib is installed; chart(plt): the figure."""
    from tehl_taichi.profiles import measure

    plt = measure.pyplot()
    if plt:
        figure = chart(plt)
        figure.savefig(folder / f"{name}.png", dpi=110)
        plt.close(figure)
        say(f"wrote {folder / name}.png")
