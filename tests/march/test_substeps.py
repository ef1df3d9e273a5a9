"""Parts of time steps: halves of what fails, larger ones again after a while."""

from tehl_taichi.march.substeps import FIRST_PAUSE, LONGEST_PAUSE, SMALLEST, Substeps


def marched(steps, largest):
    """(parts tried, those of them that failed) of a march in which nothing larger than `largest` converges."""
    parts, tried, failed = Substeps(), [], 0
    for _ in range(steps):
        done = 0.0
        while done < 1.0:
            part = parts.next(done)
            tried.append(part)
            if part <= largest:
                done += part
                parts.accept(part)
            else:
                failed += 1
                assert parts.reject(part)
        assert done == 1.0
    return tried, failed


def test_whole_steps_stay_whole():
    assert marched(5, 1.0) == ([1.0] * 5, 0)


def test_a_smaller_rest_of_a_step_does_not_change_the_size():
    parts = Substeps(part=0.5, left=0)
    before = parts.state()
    parts.accept(parts.next(0.75))
    assert parts.state() == before and parts.next(0.0) == 0.5


def test_a_single_failure_costs_two_halves():
    parts = Substeps()
    assert parts.reject(1.0) and parts.next(0.0) == 0.5
    parts.accept(0.5)
    assert parts.next(0.5) == 0.5
    parts.accept(0.5)
    assert parts.next(0.0) == 1.0


def test_what_always_fails_is_tried_ever_more_rarely():
    tried, failed = marched(400, 0.5)
    assert failed == 12 and tried.count(0.5) == 800  # after 0, 2, 6, 14 ... 254 halves, then each 128
    assert marched(400, 0.25)[1] <= 20 and marched(400, 1 / 32)[1] <= 200


def test_after_easy_steps_the_first_pause_is_short_again():
    parts = Substeps(1.0, 0, LONGEST_PAUSE)
    for _ in range(10):
        parts.accept(1.0)
    parts.reject(1.0)
    assert parts.left == FIRST_PAUSE


def test_there_is_a_smallest_part():
    parts, part = Substeps(), 1.0
    while parts.reject(part):
        part = parts.next(0.0)
    assert part == SMALLEST


def test_a_march_goes_on_as_if_it_had_not_stopped():
    parts = Substeps()
    for part in (1.0, 0.5):
        parts.reject(part)
    parts.accept(0.25)
    again = Substeps.of(parts.state())
    assert vars(again) == vars(parts) and vars(Substeps.of({"part": 0.5})) == vars(Substeps())


def test_failures_in_a_row_are_one():
    parts = Substeps()
    for part in (1.0, 0.5, 0.25, 0.125):
        parts.reject(part)
    assert (parts.part, parts.left, parts.pause) == (1 / 16, FIRST_PAUSE, 2 * FIRST_PAUSE)
