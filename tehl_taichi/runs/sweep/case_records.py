"""Records of the cases of a study: one JSON line each, written at once when the case ends."""

import io
import json
import os

from tehl_taichi.disk import files
from tehl_taichi.errors import StoreError
from tehl_taichi.store.json_values import plain

FILE = "cases.jsonl"
MOST = 2e9  # bytes: 100 000 cases have a quarter of them
# of a case; the number stands in the study's table
STATUS = {"waiting": 0, "converged": 1, "not converged": 2, "refused": 3, "failed": 4}
FINAL = ("converged", "not converged", "refused")  # would end the same again; a failed one lost its worker or its disk


def append(folder, record):
    """Append one record, a dictionary with "case", "status" and more."""
    line = (json.dumps(plain(record), allow_nan=False) + "\n").encode()
    files.append(folder / FILE, line)


def read(folder):
    """Generator of records in order of writing (a repeated case has several). Raises StoreError."""
    try:
        for line in io.BytesIO(files.content(folder / FILE, MOST)):
            if line.endswith(b"\n") and (record := _record(line)):
                yield record
    except FileNotFoundError:
        return
    except OSError as error:
        raise StoreError(f"cannot read {folder / FILE}: {error.strerror}") from None


def mend(folder):
    """Cut off an incomplete last line of a killed writer, so that the next record begins on a new line."""
    path = folder / FILE
    content = files.content(path, MOST) if os.path.exists(path) else b""
    if content and not content.endswith(b"\n"):
        files.truncate(path, content.rfind(b"\n") + 1)


def _record(line):
    try:
        record = json.loads(line)
        return record if isinstance(record, dict) and record["status"] in STATUS and isinstance(record["case"], int) else None
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
