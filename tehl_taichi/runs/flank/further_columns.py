"""Further columns of a user's table: kept with the results, so none has the name of a result."""

from tehl_taichi.errors import SceneError


def check(path, places, keys, columns):
    """Refuse further columns that would hide results. Raises SceneError.

    places: positions with their further columns `more`; keys: names of a stored position; columns: TableColumns of the results.
    """
    taken = {*keys, *(name for column in columns for name in (column.name, f"error_{column.name}"))}
    found = [name for name in dict.fromkeys(name for at in places for name in at.more) if name in taken]
    if found:
        raise SceneError(f"table {path}: {', '.join(found)} {'is a name' if len(found) == 1 else 'are names'} of the results; "
                         "rename or remove such columns")
