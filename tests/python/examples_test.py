"""The environment of Gymnasium and the arm of MuJoCo in assets/examples/python.

With the libraries of that name in the environment of these tests they judge the real thing. Without
them the environment runs on a stand-in, and the arm is skipped.
"""

import importlib
import importlib.util
import pathlib
import sys
import types

import numpy as np
import pytest

import hapticwall as hw

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "assets/examples/python"
REAL = importlib.util.find_spec("gymnasium") is not None


class StandIn:
    """The parts of gymnasium.Env and of its Box that the example uses."""

    class Env:
        def reset(self, *, seed=None, options=None):
            pass

    class Box:
        def __init__(self, low, high, shape, kind):
            self.shape, self.dtype = shape, np.dtype(kind)


@pytest.fixture
def example(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))
    if not REAL:
        module = types.ModuleType("gymnasium")
        module.Env, module.spaces = StandIn.Env, types.SimpleNamespace(Box=StandIn.Box)
        monkeypatch.setitem(sys.modules, "gymnasium", module)
    sys.modules.pop("gym_wall", None)
    return importlib.import_module("gym_wall")


def test_the_environment_gives_what_the_session_gives(example):
    env = example.WallEnv()
    seen, _ = env.reset(seed=1)
    assert seen.shape == env.observation_space.shape and seen[1] == 0.0
    with hw.Session(env.scene, env.algorithm) as session:
        for push in (0.4, 1.0, -0.3, 0.0):
            seen, reward, lost, over, told = env.step(np.array([push], dtype=env.action_space.dtype))
            for _ in range(10):
                row = session.step(hand_force_n=10.0 * float(np.float32(push)))
            assert tuple(seen) == (row.position_m, row.velocity_m_per_s)
            assert (reward, told["force_n"]) == (1.0 - abs(row.force_n - 2.0) / 2.0, row.force_n)
            assert not lost and not over
    env.close()


def test_the_environment_begins_anew_and_ends_with_the_scene(example):
    env = example.WallEnv(duration_s=0.1)
    first = env.reset(seed=1)[0]
    ends = [env.step(np.array([1.0]))[3] for _ in range(10)]
    assert ends == [False] * 9 + [True]
    assert (env.reset(seed=1)[0] == first).all()
    env.close()


def test_the_hand_of_the_example_reaches_its_force(example, capsys):
    example.main()
    assert float(capsys.readouterr().out.split("reward")[1]) > 0.95


@pytest.mark.skipif(not REAL, reason="gymnasium is missing: its own check of the environment")
@pytest.mark.filterwarnings("error")
def test_gymnasium_accepts_the_environment(example):
    import gymnasium
    from gymnasium.utils.env_checker import check_env

    gymnasium.register("HapticWall-v0", entry_point="gym_wall:WallEnv")
    check_env(gymnasium.make("HapticWall-v0").unwrapped)


@pytest.fixture(scope="module")
def arm():
    pytest.importorskip("mujoco", reason="mujoco is missing: the arm that pushes the handle")
    sys.path.insert(0, str(EXAMPLES))
    module = importlib.import_module("mujoco_hand")
    sys.path.remove(str(EXAMPLES))
    return module


@pytest.mark.parametrize("scene", ["press", "tap"])
def test_the_arm_comes_to_rest_at_the_wall(arm, scene):
    rows, summary = arm.push(scene)
    assert summary["verdict"] == "settled"
    tail = rows[-1000:]
    assert np.ptp(tail[:, 1]) < 1e-6 and np.ptp(tail[:, 2]) < 1e-6
    _, tip_m, handle_m, grip_n, wall_n, _ = rows[-1]
    at = hw.load(scene)
    assert handle_m > at["wall.position_m"]
    # Statics: muscles = grip = wall, up to the friction of the device.
    assert grip_n == pytest.approx(arm.PULL_N_PER_M * (at["wall.position_m"] + 0.02 - tip_m), abs=1e-6)
    assert abs(grip_n - wall_n) <= at["device.friction_n"] + 1e-9


@pytest.mark.parametrize("algorithm", ["none", "force-bounding"])
def test_the_work_of_the_arm_is_that_of_the_session(arm, algorithm):
    rows, summary = arm.push("press", algorithm)
    work_j = (rows[:-1, 3] * np.diff(rows[:, 2])).sum()
    assert rows[-1, 5] == pytest.approx(work_j, abs=1e-13)
    assert abs(work_j) > 1e-3
    assert summary["energy_balance_relative"] < 1e-13
