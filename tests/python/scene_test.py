import pathlib

import numpy as np
import pytest

import hapticwall as hw


def test_a_key_has_the_value_that_was_set():
    scene = hw.load("tap")
    scene["hand.mass_kg"] = 0.3
    scene["simulator.integrator"] = "rk4"
    scene["hand.path"] = np.array([[0.0, 0.03], [1.0, 0.06]])
    assert scene["hand.mass_kg"] == 0.3
    assert scene["simulator.integrator"] == "rk4"
    assert scene["hand.path"] == [[0.0, 0.03], [1.0, 0.06]]
    assert scene["wall[0].stiffness_n_per_m"] == scene["wall.stiffness_n_per_m"] == 35000.0


def test_every_number_has_a_key():
    scene = hw.load("corner")
    assert "device.y.mass_kg" in scene.keys() and "wall[1].stiffness_n_per_m" in scene.keys()
    for key in scene.keys():
        assert scene[key] is None or isinstance(scene[key], float), key


@pytest.mark.parametrize("value", [300.0, 300, np.float64(300.0), np.float32(300.0), np.int64(300), "300"])
def test_a_number_of_numpy_is_a_number(value):
    scene = hw.load("press")
    scene["wall.stiffness_n_per_m"] = value
    assert scene["wall.stiffness_n_per_m"] == 300.0


def test_a_part_that_is_omitted_has_no_value_and_can_be_added():
    scene = hw.load("golden-soft")
    assert scene["device.friction_n"] is None
    scene["device.friction_n"] = 0.2
    assert scene["device.friction_n"] == 0.2


@pytest.mark.parametrize("key, nearest", [("hand.mas_kg", "mass_kg"), ("hnd.mass_kg", "hand"), ("nme", "name")])
def test_an_unknown_key_names_the_nearest_one(key, nearest):
    scene = hw.load("press")
    with pytest.raises(KeyError, match=f"unknown key; did you mean '{nearest}'"):
        scene[key]
    with pytest.raises(KeyError, match=f"unknown key; did you mean '{nearest}'"):
        scene[key] = 1.0


@pytest.mark.parametrize(
    "key, value",
    [
        ("hand.mass_kg", -1.0),
        ("hand.mass_kg", float("nan")),
        ("hand.mass_kg", "heavy"),
        ("device.delay_ticks", 1.5),
        ("algorithm.name", "energy-bouding"),
        ("wall[7].stiffness_n_per_m", 1.0),
    ],
)
def test_a_wrong_value_changes_nothing(key, value):
    scene = hw.load("press")
    before = str(scene)
    with pytest.raises(ValueError, match="\\w: .*"):
        scene[key] = value
    assert str(scene) == before


def test_a_value_of_no_kind_is_refused():
    with pytest.raises(TypeError, match="not None"):
        hw.load("press").replace({"hand.mass_kg": None})


def test_values_that_need_each_other_are_checked_together():
    scene = hw.load("press")
    changed = scene.replace({"simulator.substeps": 4, "simulator.integrator": "rk4"})
    assert changed["simulator.substeps"] == 4
    assert scene["simulator.integrator"] == "exact"


def test_the_text_of_a_scene_is_a_scene_file(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(str(hw.load("press").replace({"hand.mass_kg": 0.1})))
    assert hw.load(str(path))["hand.mass_kg"] == 0.1


def test_a_path_is_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "press").write_text(str(hw.load("tap")))
    assert hw.load(pathlib.Path("press"))["name"] == "tap"
    assert hw.load(tmp_path / "press")["name"] == "tap"
    assert hw.load("press")["name"] == "press"
    assert hw.run(pathlib.Path("press")).scene["name"] == "tap"


def test_a_file_that_is_not_there_is_told(tmp_path):
    missing = tmp_path / "missing.toml"
    for call in (hw.load, hw.read, hw.compare, lambda path: hw.run("press", path)):
        for path in (missing, str(missing)):
            with pytest.raises(FileNotFoundError, match="missing.toml"):
                call(path)
    with pytest.raises(ValueError, match="neither a file nor a built-in scene"):
        hw.load("pres")
    with pytest.raises(TypeError):
        hw.load(3)


def test_a_path_with_a_null_character_is_refused(tmp_path):
    run = hw.run(hw.load("press").replace({"duration_s": 0.01}))
    for call in (run.save, hw.read, hw.load):
        with pytest.raises(ValueError, match="null character"):
            call(str(tmp_path / "x\0y.csv"))
    assert list(tmp_path.iterdir()) == []


def test_the_keys_of_a_scene_are_in_it():
    scene = hw.load("golden-soft")
    assert list(scene) == scene.keys() and all(key in scene for key in scene)
    assert "device.friction_n" in scene and scene["device.friction_n"] is None
    assert "algorithm.name" in scene
    for key in ("hand.mas_kg", "", 3, None):
        assert key not in scene
    with pytest.raises(TypeError, match="a key is a text such as 'hand.mass_kg', not 3"):
        scene[3]


def test_another_algorithm_has_its_defaults():
    scene = hw.load("press").replace({"algorithm.rest_force_step_n": 0.5})
    kept = scene.replace({"algorithm.name": "energy-bounding-2010"})
    assert kept["algorithm.rest_force_step_n"] == 0.5  # as the page says
    fresh = scene.with_algorithm("energy-bounding-2010")
    assert fresh["algorithm.name"] == "energy-bounding-2010"
    assert [key for key in fresh if key.startswith("algorithm.") and fresh[key] is not None] == []
    assert scene["algorithm.rest_force_step_n"] == 0.5
    assert scene.with_algorithm("energy-bounding", rest_force_step_n=0.25)["algorithm.rest_force_step_n"] == 0.25
    mine = hw.algorithm(lambda state, tick: 0.0, name="of-a-scene")
    assert scene.with_algorithm(mine)["algorithm.name"] == "of-a-scene"
    with pytest.raises(KeyError, match="did you mean 'rest_force_step_n'"):
        scene.with_algorithm("energy-bounding", rest_force_stp_n=0.25)
    with pytest.raises(ValueError, match="rest_force_step_n"):
        scene.with_algorithm("energy-bounding", rest_force_step_n=-1.0)
