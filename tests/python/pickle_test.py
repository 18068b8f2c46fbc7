"""Scenes and algorithms in other processes."""

import copy
import ctypes
import dataclasses
import os
import pathlib
import pickle
import subprocess
import sys

import pytest

import hapticwall as hw
import laws
import travelling
from hapticwall import _travel

SHORT = {"duration_s": 0.2}
LAWS = travelling.registered()
READ = """
import pickle, sys
import hapticwall as hw
scene, expected = pickle.load(sys.stdin.buffer)
sys.exit(0 if {k: v for k, v in hw.batch([scene])[0].items() if k != "algorithm"} == expected else "other numbers")
"""


def elsewhere(scene, folder="."):
    """Runs the scene in a process that is told nothing else; compares its summary with that of this one."""
    expected = {key: value for key, value in hw.batch([scene])[0].items() if key != "algorithm"}
    path = os.pathsep.join([os.environ["PYTHONPATH"], str(pathlib.Path(__file__).parent)])
    done = subprocess.run(
        [sys.executable, "-c", READ],
        input=pickle.dumps((scene, expected)),
        env={**os.environ, "PYTHONPATH": path},
        cwd=folder,
        capture_output=True,
    )
    return done.returncode, done.stderr.decode()


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
@pytest.mark.parametrize("name", hw.scenes())
def test_a_scene_is_equal_to_its_pickle(name, protocol):
    scene = hw.load(name)
    found = pickle.loads(pickle.dumps(scene, protocol))
    assert found == scene and str(found) == str(scene)
    assert hw.batch([found]) == hw.batch([scene])


def test_a_copy_changes_by_itself():
    scene = hw.load("tap")
    for found in (copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene)), scene.replace({})):
        assert found == scene and found is not scene
        found["hand.mass_kg"] = 0.123
        assert found != scene and scene == hw.load("tap")
    assert scene != "tap" and not scene == 3
    with pytest.raises(TypeError, match="unhashable"):
        hash(scene)


@pytest.mark.parametrize(
    "values",
    [
        {"algorithm.name": "none"},
        {"name": "other"},
        {"hand.path": [[0.0, 0.0], [1.0, 0.06]]},
        {"simulator.integrator": "rk4"},
        {"sampling.seed": 3, "sampling.jitter": 0.1},
        {"estimator.name": "foaw"},
    ],
)
def test_scenes_with_another_value_differ(values):
    scene = hw.load("tap")
    changed = scene.replace(values)
    assert changed != scene
    assert pickle.loads(pickle.dumps(changed)) == changed


def test_a_text_is_a_scene():
    scene = hw.load("corner").replace({"hand.mass_kg": 0.3})
    assert hw.Scene.from_text(str(scene)) == scene
    with pytest.raises(ValueError, match="text"):
        hw.Scene.from_text("[hand]\nmas_kg = 3")
    with pytest.raises(TypeError, match="the text of a scene file is a str"):
        hw.Scene.from_text(pathlib.Path("press"))


def recorded_scene(folder, **values):
    run = hw.run(hw.load("tap").replace({**SHORT, **values}))
    run.save(folder / "a.csv")
    return hw.read(folder / "a.csv").scene


def test_a_recorded_hand_travels(tmp_path):
    scene = recorded_scene(tmp_path)
    found = pickle.loads(pickle.dumps(scene))
    assert found == scene
    other = recorded_scene(tmp_path, **{"hand.path": [[0.0, 0.03], [0.1, 0.04]]})
    assert other != scene  # in its motion alone: the name and the hash of its file do not count
    assert (hw.run(found).samples == hw.run(scene).samples).all()
    (tmp_path / "a.csv").unlink()
    assert elsewhere(scene) == (0, "")


def test_the_points_of_a_path_file_travel(tmp_path):
    path = tmp_path / "hand.csv"
    path.write_text("time_s,position_m\n0,0.03\n0.1,0.06\n0.15,0.055\n")
    scene = hw.load("tap").replace({**SHORT, "hand.path_file": str(path)})
    other = scene.replace({})
    path.unlink()
    found = pickle.loads(pickle.dumps(scene))
    assert found == scene == other and str(found) == str(scene)
    assert elsewhere(scene) == (0, "")


def test_a_session_that_cannot_be_repeated_stays(tmp_path):
    path = tmp_path / "hand.csv"
    path.write_text("time_s,position_m\n0,0.03\n0.1,0.06\n")
    hw.run(hw.load("tap").replace({**SHORT, "hand.path_file": str(path)})).save(tmp_path / "a.csv")
    path.write_text("time_s,position_m\n0,0.03\n0.1,0.07\n")
    with pytest.raises(ValueError, match="cannot be repeated: .* was changed since"):
        pickle.dumps(hw.load(tmp_path / "a.toml"))


@pytest.mark.parametrize("law", ["limited", "numba", "Python", "C"])
def test_an_algorithm_travels_with_its_scene(law, tmp_path):
    scene = hw.load("press").replace(SHORT).with_algorithm({**LAWS, **laws.written()}[law])
    assert elsewhere(scene, tmp_path) == (0, "")


def test_an_algorithm_of_which_the_scene_has_a_parameter_travels():
    scene = hw.load("press").replace({**SHORT, "algorithm.deadly": 0.0})
    assert scene["algorithm.name"] != "kills"
    assert elsewhere(scene) == (0, "")


def local():
    return lambda state, tick: 0.0


def test_a_function_without_a_place_stays():
    address = ctypes.cast(laws.ctypes_step, ctypes.c_void_p).value
    hidden = local()  # another function has its place
    hidden.__module__, hidden.__qualname__ = "travelling", "limited"
    for number, step in enumerate((lambda state, tick: 0.0, local(), address, laws.ctypes_step, hidden)):
        scene = hw.load("press").with_algorithm(hw.algorithm(step, name=f"stays-{number}"))
        with pytest.raises(ValueError, match=f"algorithm 'stays-{number}': its step cannot travel") as refused:
            pickle.dumps(scene)
        assert "\n" not in str(refused.value)
    half = hw.algorithm(travelling.limited, name="half", reset=lambda state: None)
    with pytest.raises(ValueError, match="its reset cannot travel"):
        pickle.dumps(hw.load("press").with_algorithm(half))


def test_another_plugin_than_that_of_the_sender_is_refused(tmp_path):
    plugin = tmp_path / "mine.so"
    plugin.write_bytes(pathlib.Path(laws.written()["C++"]).read_bytes())
    sent = _travel.PluginFile("elsewhere-only", str(plugin), "0" * 64)
    with pytest.raises(ValueError, match="mine.so: not the plug-in that was sent; SHA-256 0{64} is wanted"):
        sent.arrive()
    with pytest.raises(FileNotFoundError):
        dataclasses.replace(sent, path=str(tmp_path / "missing.so")).arrive()
    index = hw.algorithms().index(hw.run(hw.load("press").replace(SHORT), laws.written()["C"]).scene["algorithm.name"])
    loaded = _travel.traveller_of(index)
    assert loaded.arrive() == index
    with pytest.raises(ValueError, match="SHA-256"):
        dataclasses.replace(loaded, sha256="0" * 64).arrive()
