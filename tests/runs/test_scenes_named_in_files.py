"""The scene that a file of a flank, a bearing or a study names lies beside that file."""

import pytest

import tehl_taichi as tehl
from tehl_taichi.runs.bearing.bearing_source import bearing_source
from tehl_taichi.runs.flank.flank_source import flank_source
from tehl_taichi.runs.sweep import study_file
from tehl_taichi.scene import scene_file

FILES = {"flank": ('base = "fzg-c"', lambda file: flank_source(file).scene),
         "bearing": ('base = "6206"', lambda file: bearing_source(file, {}).scene),
         "study": ("over.srr = [0.0, 0.1]", lambda file: study_file.load(file).scene)}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with scenes of 70 deg C; the current folder has ones of the same names with 30 deg C."""
    beside = tmp_path / "beside"
    beside.mkdir()
    for place, temperature in ((beside, 70.0), (tmp_path, 30.0)):
        (place / "mine.toml").write_text(scene_file.dumps(tehl.scene("dent").replace(temperature=temperature)))
    monkeypatch.chdir(tmp_path)
    return beside


@pytest.mark.parametrize("keys, scene_of", FILES.values(), ids=FILES)
def test_the_scene_of_a_file_is_built_in_or_lies_beside_it(folder, keys, scene_of):
    file = folder / "any.toml"
    for name, temperature in (("mine.toml", 70.0), ("gear", tehl.scene("gear").operation.temperature)):
        file.write_text(f'scene = "{name}"\n{keys}\n')
        assert scene_of(file).operation.temperature == temperature
    (folder / "gear").write_text("no scene")
    assert scene_of(file).name == "gear"


@pytest.mark.parametrize("keys, scene_of", FILES.values(), ids=FILES)
def test_a_scene_in_the_current_folder_is_not_meant(folder, keys, scene_of):
    (folder / "mine.toml").unlink()
    (folder / "any.toml").write_text(f'scene = "mine.toml"\n{keys}\n')
    with pytest.raises(tehl.SceneError, match="cannot read scene file .*beside.mine.toml"):
        scene_of(folder / "any.toml")


@pytest.mark.parametrize("keys, scene_of", FILES.values(), ids=FILES)
@pytest.mark.parametrize("line, said", [("scene = 3", "scene = 3 must be text"),
                                        ("colour = 1", "unknown key 'colour' in .*; known: ")])
def test_keys_of_a_file_are_checked(folder, keys, scene_of, line, said):
    (folder / "any.toml").write_text(f"{line}\n{keys}\n")
    with pytest.raises(tehl.SceneError, match=said):
        scene_of(folder / "any.toml")
