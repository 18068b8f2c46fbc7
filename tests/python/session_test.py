import math

import numpy as np
import pytest

import hapticwall as hw

SCENES = ["press", "tap", "light", "layers", "golden-soft", "golden-soft-fric", "golden-hard", "tissue", "detents", "mass"]


def rows_of(session, ticks, force=lambda session: 0.0):
    names = hw.run(session.scene.replace({"duration_s": 0.01})).samples.dtype.names
    rows = []
    for _ in range(ticks):
        sample = session.step(hand_force_n=force(session))
        rows.append([getattr(sample, name) for name in names if hasattr(sample, name)])
    return [name for name in names if hasattr(sample, name)], np.array(rows)


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("law", hw.algorithms()[:8])
def test_without_a_force_every_tick_is_that_of_a_run(scene, law):
    run = hw.run(scene, law)
    with hw.Session(scene, law) as session:
        names, rows = rows_of(session, len(run.samples))
        assert len(names) > 15
        for i, name in enumerate(names):
            assert np.array_equal(rows[:, i], run.samples[name].astype(float)), name
        pace = ("ns_per_tick", "simulated_seconds_per_second")
        expected = {key: value for key, value in run.summary.items() if key not in pace}
        assert {key: value for key, value in session.summary.items() if key not in pace} == expected


@pytest.mark.parametrize("scene", ["corner", "bump"])
def test_two_axes_are_those_of_a_run(scene):
    run = hw.run(scene, "energy-bounding")
    with hw.Session(scene, "energy-bounding") as session:
        for row in run.samples:
            sample = session.step()
            assert (sample.force_n, session.sample_y.force_n) == (row["force_n"], row["y_force_n"])
        assert session.summary["y_verdict"] == run.summary["y_verdict"]


def test_a_change_between_two_ticks_is_that_of_a_live_session():
    with hw.Session("press", "none") as session:
        for _ in range(1500):
            session.step()
        session.set("wall.stiffness_n_per_m", 1000.0)
        session.set("device.mass_kg", 0.3)
        for _ in range(3000):
            last = session.step()
        assert session.scene["wall.stiffness_n_per_m"] == 1000.0
        assert last.wall_force_n == pytest.approx(1000.0 * last.penetration_m, rel=1e-12)
        with pytest.raises(ValueError, match="start a new session"):
            session.set("sampling.rate_hz", 2000.0)
        with pytest.raises(KeyError):
            session.set("wall.stifness_n_per_m", 1.0)


FREE = {"hand.stiffness_n_per_m": 0.0, "hand.damping_n_s_per_m": 0.0}


def free_scene(**device):
    """The device of golden-soft with 0.08 kg and 1.2 N·s/m, and a hand that does not hold it."""
    scene = hw.load("golden-soft").replace(FREE | {"algorithm.name": "none", "wall.position_m": 0.9})
    scene = scene.replace({"device.mass_kg": 0.08, "device.damping_n_s_per_m": 1.2})
    return scene.replace({f"device.{key}": value for key, value in device.items()})


@pytest.mark.parametrize("lag", [None, 0.004])
def test_a_constant_force_moves_the_mass_as_its_equation_says(lag):
    scene = free_scene(**({"amplifier_time_constant_s": lag} if lag else {}))
    mass = scene["device.mass_kg"] + (scene["hand.mass_kg"] or 0.0)
    start, rate = scene["device.start_m"], 1.2 / mass
    with hw.Session(scene) as session:
        for tick in range(400):
            now = tick * 1e-3
            way = 0.3 / 1.2 * (now + math.expm1(-rate * now) / rate)
            sample = session.step(hand_force_n=0.3)
            assert sample.true_position_m == pytest.approx(start + way, abs=1e-14)
            assert sample.hand_force_n == pytest.approx(0.3, abs=1e-15)


@pytest.mark.parametrize("parts", [{}, {"friction_n": 0.1}, {"amplifier_time_constant_s": 0.002}, {"delay_ticks": 3}])
@pytest.mark.parametrize("law", ["none", "energy-bounding"])
def test_the_energy_balance_closes_with_a_force_of_a_program(parts, law):
    scene = free_scene(**parts).replace({"wall.position_m": 0.035, "algorithm.name": law})
    turnover = 0.0
    with hw.Session(scene) as session:
        while session.time_s < 3.0:
            sample = session.step(hand_force_n=200.0 * (0.04 - session.position_m) + math.sin(20.0 * session.time_s))
            turnover = max(turnover, abs(sample.true_hand_work_j) + abs(sample.true_actuator_work_j))
            balance = sample.true_hand_work_j - (
                sample.kinetic_j + sample.true_dissipation_j + sample.true_actuator_work_j
            )
            assert abs(balance) < 1e-13 * max(turnover, 1e-3), session.tick
        assert turnover > 1e-3
        assert session.summary["energy_balance_error_j"] == pytest.approx(0.0, abs=1e-13)


def test_a_spring_of_a_program_is_nearly_the_spring_of_the_scene():
    """Held through a tick, it acts half a tick late: the distance falls with the period."""

    worst = []
    for rate in (1000.0, 4000.0):
        scene = free_scene().replace({"hand.stiffness_n_per_m": 250.0, "duration_s": 0.5, "sampling.rate_hz": rate})
        scene = scene.replace({"hand.path": [[0.0, 0.04]]})
        own = hw.run(scene).samples["true_position_m"]
        with hw.Session(scene.replace({"hand.stiffness_n_per_m": 0.0})) as session:
            driven = [session.step(250.0 * (0.04 - session.position_m)).true_position_m for _ in own]
        worst.append(np.abs(np.array(driven) - own).max())
    assert worst[1] < 0.35 * worst[0]


def test_wrong_forces_and_ends_are_told():
    with hw.Session("press", "none") as session:
        for force in (math.nan, math.inf):
            with pytest.raises(ValueError, match="finite"):
                session.step(force)
        with pytest.raises(ValueError, match="no second axis"):
            session.step(0.0, 1.0)
        assert session.tick == 0
    with pytest.raises(RuntimeError, match="closed"):
        session.step()
    with hw.Session(free_scene()) as session:
        with pytest.raises(RuntimeError, match="diverged at tick"):
            while True:
                session.step(hand_force_n=50.0)
        assert session.diverged and session.summary["verdict"] == "diverged"


def test_a_law_of_ones_own_works_and_its_exception_is_told():
    def step(state, tick):
        if tick[0].position_m > 0.055:
            raise ZeroDivisionError("too deep")
        return tick[0].wall_force_n

    law = hw.algorithm(step, name="session-law")
    with hw.Session("press", law) as session:
        with pytest.raises(hw.LawError) as told:
            for _ in range(6000):
                session.step(hand_force_n=20.0)
        assert isinstance(told.value.__cause__, ZeroDivisionError)
        with pytest.raises(RuntimeError, match="in progress"):
            hw.algorithm(step, name="another-law")
    hw.algorithm(step, name="another-law")
