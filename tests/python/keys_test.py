"""The keys of scenes as a list, the scenes, the version."""

import pytest

import hapticwall as hw
from run_test import hapticwall

LEAST = """
name = "least"
[device]
mass_kg = 0.1
damping_n_s_per_m = 1.0
[hand]
stiffness_n_per_m = 100.0
path = [[0.0, 0.06]]
[[wall]]
position_m = 0.05
stiffness_n_per_m = 300.0
"""
KEYS = {key.key: key for key in hw.keys()}
NUMBERS = [key for key in KEYS.values() if key.kind in ("number", "whole number")]


@pytest.mark.parametrize("key", NUMBERS, ids=lambda key: key.key)
def test_a_range_is_that_which_a_scene_takes(key):
    scene = hw.Scene.from_text(LEAST)
    beyond = [key.maximum * 2.0 + 1.0, key.minimum - 1.0] + [key.minimum] * key.minimum_excluded
    for value in beyond:
        with pytest.raises(ValueError) as told:
            scene[key.key] = value
        assert key.key.split(".")[-1] in str(told.value)
    unit = f" {key.unit}" if key.unit else ""
    if key.key != "simulator.substeps":  # its text is another one
        with pytest.raises(ValueError, match="it takes") as told:
            scene[key.key] = beyond[0]
        assert str(told.value).endswith(unit)


def test_a_default_is_the_value_of_a_scene_that_omits_the_key():
    scene = hw.Scene.from_text(LEAST)
    defaults = {key.key: key.default for key in NUMBERS if key.default is not None}
    assert {"duration_s", "sampling.rate_hz", "wall.damping_n_s_per_m"} <= set(defaults)
    for key, value in defaults.items():
        if f"{key.split('.')[-1]} =" not in LEAST:
            assert scene[key] == value, key
    for key in NUMBERS:
        if key.default is None and not key.required:
            assert scene[key.key] is None, key


def test_a_required_number_must_be_there():
    required = [key.key for key in NUMBERS if key.required]
    assert "device.mass_kg" in required
    for key in required:
        word = key.split(".")[-1]
        text = "\n".join(line for line in LEAST.splitlines() if not line.startswith(word))
        if word in LEAST and LEAST.count(word) == 1:
            with pytest.raises(ValueError, match=f"{word}.*missing"):
                hw.Scene.from_text(text)


@pytest.mark.parametrize("name", ["press", "layers", "corner"])
def test_every_number_of_a_scene_is_described(name):
    scene = hw.load(name)
    for key in scene:
        described = scene.describe(key)
        assert described.key == key
        assert scene[key] is None or described.minimum <= scene[key] <= described.maximum
    with pytest.raises(KeyError, match="did you mean 'mass_kg'"):
        scene.describe("hand.mas_kg")
    with pytest.raises(KeyError, match="no number, switch or choice"):
        scene.describe("hand.path")


def test_a_whole_number_beyond_its_range_is_not_cut():
    scene = hw.load("press")
    for value in (4e9, -1):
        with pytest.raises(ValueError, match=f"sampling.seed: {value:g}".replace("+0", "").replace("+", "")):
            scene["sampling.seed"] = value
        with pytest.raises(ValueError, match="sampling.seed: .* is out of range"):
            hw.map(scene, x=("sampling.seed", [1, value]), y=("device.mass_kg", [0.1]), algorithms=["none"])


def test_a_choice_has_its_words():
    scene = hw.load("press")
    assert scene.describe("wall[0].stiffness_n_per_m") == scene.describe("wall.stiffness_n_per_m")
    for key in KEYS.values():
        if key.kind != "choice":
            assert key.choices == []
            continue
        assert key.default_text in key.choices and len(key.choices) > 1
        for word in key.choices:
            scene.replace({key.key: word})
        with pytest.raises(ValueError):
            scene[key.key] = "no such word"
    assert [key.choices for key in hw.keys() if key.key == "algorithm.name"] == [hw.algorithms()]


def test_the_scenes_and_the_version_are_those_of_the_program():
    assert [line.split(maxsplit=1) for line in hapticwall("scenes").splitlines()] == [
        [name, description] for name, description in hw.scenes().items()
    ]
    assert all(hw.load(name)["name"] == name for name in hw.scenes())
    assert hapticwall("--version").split()[1] == hw.__version__
