"""Parts of the time of a command: they do not overlap and leave nothing out."""

import threading

import pytest

from tehl_taichi.engine import watched_calls
from tehl_taichi.runs import time_budget
from tehl_taichi.runs.time_budget import MACHINE_CODE, REST, SETUP, TimeBudget


class Clock:
    """Time and time of kernels that a test sets."""

    def __init__(self, monkeypatch):
        from tehl_taichi.engine.taichi_patches import prebound

        self.now = self.made = 0.0
        monkeypatch.setattr(time_budget.time, "perf_counter", lambda: self.now)
        monkeypatch.setattr(prebound, "binding_seconds", lambda: self.made)

    def pass_(self, seconds, made=0.0):
        self.now, self.made = self.now + seconds, self.made + made


@pytest.fixture
def clock(monkeypatch):
    return Clock(monkeypatch)


def test_parts_inside_a_stage_are_taken_out_of_it(clock):
    budget = TimeBudget(0.0)
    inner = budget._wrapper("temperatures", lambda: clock.pass_(3.0, made=1.0))
    outer = budget._wrapper("pressure", lambda: (clock.pass_(2.0), inner(), clock.pass_(0.5)))
    clock.pass_(4.0)
    budget.stage("passage", 0, 10)
    clock.pass_(1.0)
    outer()
    clock.pass_(0.25)
    budget.stage("passage", 10, 10)
    clock.pass_(7.0)
    budget._charge()
    assert {name: seconds for name, seconds in budget.spent.items() if seconds} == {
        SETUP: 4.0, "passage: rest": 1.25, "passage: pressure": 2.5, "passage: temperatures": 2.0, MACHINE_CODE: 1.0, REST: 7.0}
    rows = budget.rows()
    assert rows[0][:2] == (REST, 7.0) and rows[-1] == ("sum", clock.now, 1.0)
    assert sum(share for *_, share in rows[:-1]) == pytest.approx(1.0)


def test_what_follows_the_start_is_no_summary(clock):
    budget = TimeBudget(0.0)
    budget.stage("steady start", 1, 1)
    clock.pass_(2.0)
    budget.stage("passage", 0, 3)
    assert budget.spent["contact alone, new store"] == 2.0 and REST not in budget.spent


def test_calls_of_other_stages_and_threads_belong_to_the_stage(clock):
    budget = TimeBudget(0.0)
    call = budget._wrapper("pressure", lambda: clock.pass_(1.0))
    budget.stage("steady start", 0, 1)
    call()
    budget.stage("passage", 0, 2)
    thread = threading.Thread(target=call)
    thread.start()
    thread.join()
    budget._charge()
    assert budget.spent["steady start"] == budget.spent["passage: rest"] == 1.0 and "passage: pressure" not in budget.spent


def test_every_place_is_there_and_is_put_back():
    from tehl_taichi.pressure.newton import PressureSolver

    before, seen, places = PressureSolver.solve, [], {**time_budget.MARCHED, **time_budget.SEARCHED}
    with watched_calls.wrapped(places, lambda name, function: seen.append(name) or len):
        assert PressureSolver.solve is len
    assert PressureSolver.solve is before and set(seen) == set(places)
    assert all(names.items() <= places.items() for names in time_budget.INSIDE.values())
