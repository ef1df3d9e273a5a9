"""Results of a suite: printed tables or one JSON object, both also in files, with a picture."""

from tehl_cli import bench_page
from tehl_cli.live_display import say
from tehl_cli.stdout import print_json
from tehl_cli.tables import list_table


def texts(rows, columns):
    """Rows (dictionaries) as lists of texts, in the formats {key: format} of `columns`; unknown values are left empty."""
    return [[form.format(row[key]) if row.get(key) is not None else "" for key, form in columns.items()] for row in rows]


class Results:
    """Files NAME.json, NAME.png and others (`more`: their endings) of a suite in a folder.

    force: replace those of an earlier run; as_json: print the JSON object in place of tables; write: also replace the suite's
    table in the documentation. Raises StoreError, before the work, if they may not be written.
    """

    def __init__(self, folder, name, force, as_json, more=(), kept=(), write=False):
        from tehl_taichi.disk import links, user_files

        self.folder, self.name, self.as_json, self.write = folder, name, as_json, write
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

    def table(self, title, columns, rows):
        """Print a table; rows: lists of texts."""
        if not self.as_json:
            list_table(title, columns, rows)

    def finish(self, rows, chart, **more):
        """As :meth:`write_files`; print the JSON object if requested."""
        found = self.write_files(rows, chart, **more)
        if self.as_json:
            print_json(found)

    def write_files(self, rows, chart, **more):
        """Write NAME.json (machine, rows and further data), and NAME.png of chart(plt); returns the JSON object."""
        found = self.keep(rows, **more)
        say(f"wrote {self.file('json')}")
        self.picture(chart)
        return found

    def show(self, title, rows, columns, chart, shown=None):
        """Print and document the table of rows (or of `shown`) in the formats `columns`, then :meth:`finish`."""
        lines = texts(shown or rows, columns)
        self.table(title, columns, lines)
        self.documented(columns, lines)
        self.finish(rows, chart)

    def documented(self, columns, rows, keys=0):
        """Write the suite's table into the documentation if requested; rows: lists of texts; keys: see
        :func:`tehl_cli.bench_page.write`.
        """
        if self.write:
            bench_page.write(self.name, columns, rows, keys)
            say(f"wrote {bench_page.of(self.name)}")

    def page(self, text):
        """Write NAME.md."""
        from tehl_taichi.disk import user_files

        user_files.text(self.file("md"), f"{text.rstrip()}\n\n{user_files.COMMENT}\n", force=True)

    def picture(self, chart):
        """Write NAME.png if matplotlib is installed; chart(plt): the figure."""
        from tehl_taichi.profiles import measure

        from tehl_taichi.disk import user_files

        plt = measure.pyplot()
        if plt:
            figure = chart(plt)
            with user_files.made(self.file("png"), force=True) as draft:
                figure.savefig(draft, format="png", dpi=110, metadata={"Software": user_files.PROGRAM})
            plt.close(figure)
            say(f"wrote {self.file('png')}")
