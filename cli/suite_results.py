"""Results of a suite: printed tables or one JSON object, both also in files, with a picture."""

from tehl_cli import bench_page
from tehl_cli.live_display import say
from tehl_cli.stdout import print_json
from tehl_cli.tables import list_table

from tehl_taichi.disk import links, user_files


def table(title, rows, columns):
    """Print rows (dictionaries) in the formats {key: format}; unknown values are left empty."""
    list_table(title, columns, texts(rows, columns))


def texts(rows, columns):
    """Rows (dictionaries) as lists of texts."""
    return [[form.format(row[key]) if row.get(key) is not None else "" for key, form in columns.items()] for row in rows]


class Results:
    """Files NAME.json, NAME.png and others (`more`: their endings) of a suite in a folder.

    force: replace those of an earlier run; write: also replace the suite's table in the documentation. Raises StoreError,
    before the work, if they may not be written.
    """

    def __init__(self, folder, name, force, more=(), kept=(), write=False):
        self.folder, self.name, self.write = folder, name, write
        if write:
            bench_page.check(name)
        links.refuse_itself(folder)
        for ending in ("json", "png", *more):
            if ending not in kept:
                user_files.check(self.file(ending), force)

    def file(self, ending):
        """Path of the file with that ending."""
        return self.folder / f"{self.name}.{ending}"

    def keep(self, rows, **more):
        """Write NAME.json (machine, rows and further data) so far; returns its JSON object."""
        from tehl_taichi.profiles import measure

        found = measure.result(rows, **more)
        measure.save(self.folder, self.name, found)
        return found

    def finish(self, rows, chart, as_json, **more):
        """Write NAME.json (machine, rows and further data) and NAME.png; print the JSON object if requested.

        chart(plt): the figure.
        """
        found = self.keep(rows, **more)
        say(f"wrote {self.file('json')}")
        self.picture(chart)
        if as_json:
            print_json(found)

    def show(self, title, rows, columns, chart, as_json, shown=None):
        """Print and document the table of rows (or of `shown`) in the formats `columns`, then :meth:`finish`."""
        shown = shown or rows
        if not as_json:
            table(title, shown, columns)
        self.documented(columns, texts(shown, columns))
        self.finish(rows, chart, as_json)

    def documented(self, columns, rows, keys=0):
        """Write the suite's table into the documentation if requested; rows: lists of texts; keys: see
        :func:`tehl_cli.bench_page.write`.
        """
        if self.write:
            bench_page.write(self.name, columns, rows, keys)
            say(f"wrote {bench_page.of(self.name)}")

    def page(self, text):
        """Write NAME.md."""
        user_files.text(self.file("md"), f"{text.rstrip()}\n\n{user_files.COMMENT}\n", force=True)

    def picture(self, chart):
        """Write NAME.png if matplotlib is installed; chart(plt): the figure."""
        from tehl_taichi.profiles import measure

        plt = measure.pyplot()
        if plt:
            figure = chart(plt)
            with user_files.made(self.file("png"), force=True) as draft:
                figure.savefig(draft, format="png", dpi=110, metadata={"Software": user_files.PROGRAM})
            plt.close(figure)
            say(f"wrote {self.file('png')}")
