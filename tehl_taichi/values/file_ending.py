"""Ending of a file name, in upper or lower case."""

from pathlib import Path


def ending(path):
    """Ending in lower case: ".csv" of a.csv, A.CSV and a.Csv; "" without one."""
    return Path(path).suffix.lower()
