"""The ending of a file's name, as instruments, Windows and people write it."""

from pathlib import Path


def ending(path):
    """".csv" of a.csv, A.CSV and a.Csv alike; "" where there is none."""
    return Path(path).suffix.lower()
