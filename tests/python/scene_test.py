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


def test_a_scene_that_is_not_there_is_told():
    with pytest.raises((OSError, ValueError), match="missing.toml"):
        hw.load("missing.toml")
