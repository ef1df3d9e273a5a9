"""Threads of a fatigue search: transforms and matrix products release the interpreter's lock."""

from concurrent.futures import Executor, Future, ThreadPoolExecutor

from tehl_taichi.engine import cores

WORKERS = min(4, cores.available())
# numbers of a field from which threads pay; with less they wait for the lock. Search of both bodies with two threads and
# without: 3.6 and 3.1 s on 64x16 and 32x8 cells together, 8.1 and 9.7 s on 128x32 cells
WORTH = 4000


class AtOnce(Executor):
    """Executor that runs tasks in the calling thread."""

    def submit(self, function, /, *args, **options):
        done: Future = Future()
        done.set_result(function(*args, **options))
        return done


def pool(numbers):
    """Executor for tasks on fields of so many numbers: threads from WORTH on."""
    return ThreadPoolExecutor(WORKERS) if numbers >= WORTH else AtOnce()
