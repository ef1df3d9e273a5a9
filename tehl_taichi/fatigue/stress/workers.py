"""Threads of a fatigue pass: transforms and products of matrices run outside the interpreter's lock."""

from concurrent.futures import Executor, Future, ThreadPoolExecutor

from tehl_taichi.engine import cores

WORKERS = min(4, cores.available())
# Numbers of one field from which on threads are worth it; below, they wait for each other's lock. Search of both bodies, s, on
# 64x16 and 32x8 cells together: 3.6 with two threads, 3.1 without; on 128x32 cells 8.1 and 9.7
WORTH = 4000


class AtOnce(Executor):
    """Does in this thread what is submitted."""

    def submit(self, function, /, *args, **options):
        done: Future = Future()
        done.set_result(function(*args, **options))
        return done


def pool(numbers):
    """Executor of tasks on fields of so many numbers each."""
    return ThreadPoolExecutor(WORKERS) if numbers >= WORTH else AtOnce()
