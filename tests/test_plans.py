"""FFTW plans that are measured once a machine."""

import numpy as np
import pytest

from tehl_taichi.engine import plans
from tehl_taichi.engine.fftw import pyfftw

ROWS, PERIOD = 64, 256  # large enough to be measured


@pytest.fixture
def empty_cache(monkeypatch, tmp_path):
    monkeypatch.setattr(plans, "_place", lambda: tmp_path / "transforms.json")
    before = pyfftw.export_wisdom()
    pyfftw.forget_wisdom()
    plans._remembered.cache_clear()
    yield tmp_path
    pyfftw.import_wisdom(before)
    plans._remembered.cache_clear()


def transform():
    source, result = np.ones((ROWS, PERIOD)), np.ones((ROWS, PERIOD // 2 + 1), complex)
    made = plans.plan(source, result, 1)
    return made, source, result


def test_a_measured_plan_is_kept_and_taken_up(empty_cache):
    _, source, result = transform()
    kept = (empty_cache / "transforms.json").read_text()
    assert not source.any() and not result.any()
    pyfftw.forget_wisdom()
    plans._remembered.cache_clear()
    made, source, result = transform()
    assert "FFTW_WISDOM_ONLY" in made.flags and (empty_cache / "transforms.json").read_text() == kept
    source[:] = np.random.default_rng(0).standard_normal(source.shape)
    made.execute()
    np.testing.assert_allclose(result, np.fft.rfft(source, axis=1), atol=1e-12)


def test_without_a_folder_to_keep_them_plans_are_estimated(empty_cache, monkeypatch):
    def full(*_):
        raise OSError("no space left on device")

    monkeypatch.setattr(plans.os, "replace", full)
    made, source, result = transform()
    assert "FFTW_ESTIMATE" in made.flags
    assert list(empty_cache.iterdir()) == []


def test_a_damaged_record_is_replaced(empty_cache):
    record = empty_cache / "transforms.json"
    record.write_text("{")
    assert "FFTW_MEASURE" in transform()[0].flags and len(record.read_text()) > 1
