"""Threads of a fatigue pass."""

import threading

import pytest

from tehl_taichi.fatigue.stress import workers


@pytest.mark.parametrize("numbers, here", [(workers.WORTH - 1, True), (workers.WORTH, False)])
def test_small_fields_stay_in_this_thread(numbers, here):
    with workers.pool(numbers) as some:
        threads = [some.submit(threading.get_ident).result(), *some.map(lambda _: threading.get_ident(), range(2))]
    assert {thread == threading.get_ident() for thread in threads} == {here}
