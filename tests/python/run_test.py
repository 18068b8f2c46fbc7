import json
import os
import signal
import subprocess
import threading

import numpy as np
import pytest

import hapticwall as hw

PROGRAM = os.environ["HAPTICWALL"]
SHORT = {"duration_s": 0.2}


def hapticwall(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def sidecar(path):
    """Without the build, which the module and the program need not share, and the seal over it."""
    return [line for line in path.read_text().splitlines() if not line.startswith(("build =", "sidecar_sha256 ="))]


@pytest.mark.parametrize("name", ["tap", "corner"])
def test_a_run_is_that_of_the_command_line(name, tmp_path):
    expected = json.loads(hapticwall("run", name, "--csv", str(tmp_path / "a.csv"), "--json", "-"))
    run = hw.run(name)
    run.save(tmp_path / "b.csv")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    assert sidecar(tmp_path / "a.toml") == sidecar(tmp_path / "b.toml")
    assert list(run.summary) == list(expected)
    clock = {"ns_per_tick", "simulated_seconds_per_second"}
    assert {k: v for k, v in run.summary.items() if k not in clock} == {
        k: v for k, v in expected.items() if k not in clock
    }
    assert run.summary["ns_per_tick"] > 0.0


@pytest.mark.parametrize("name", ["tap", "corner"])
def test_the_samples_are_the_rows_of_the_csv(name, tmp_path):
    run = hw.run(hw.load(name).replace(SHORT))
    run.save(tmp_path / "a.csv")
    rows = np.genfromtxt(tmp_path / "a.csv", delimiter=",", names=True)
    assert run.samples.dtype.names == rows.dtype.names
    for column in rows.dtype.names:
        assert (run.samples[column] == rows[column]).all(), column


def test_samples_are_no_copy_and_outlive_the_run():
    run = hw.run(hw.load("press").replace(SHORT))
    first, second = run.samples, run.samples
    assert first.__array_interface__["data"] == second.__array_interface__["data"]
    assert not first.flags.writeable
    kept = first["force_n"]
    before = kept.copy()
    del run, first, second
    for _ in range(50):  # would reuse the memory
        hw.run(hw.load("tap").replace(SHORT))
    assert (kept == before).all()


def test_a_recording_is_read_and_run_again(tmp_path):
    run = hw.run("tap")
    run.save(tmp_path / "a.csv")
    recording = hw.read(tmp_path / "a.csv")
    assert (recording.samples == run.samples).all()
    again = hw.rerun(recording)
    assert again.first_different_tick is None
    assert (again.samples == run.samples).all()
    other = hw.rerun(recording, "none", {"wall.stiffness_n_per_m": 5000})
    other.save(tmp_path / "b.csv")
    hapticwall(
        *("replay", str(tmp_path / "a.csv"), "--algorithm", "none", "--csv", str(tmp_path / "c.csv")),
        *("--set", "wall.stiffness_n_per_m=5000", "--quiet"),
    )
    assert (tmp_path / "b.csv").read_bytes() == (tmp_path / "c.csv").read_bytes()
    assert sidecar(tmp_path / "b.toml") == sidecar(tmp_path / "c.toml")


def test_a_recorded_hand_serves_studies(tmp_path):
    run = hw.run("tap")
    run.save(tmp_path / "a.csv")
    scene = hw.read(tmp_path / "a.csv").scene
    assert hw.compare(scene, ["energy-bounding"])[0]["energy_cv_j"] == run.summary["energy_cv_j"]
    scene["wall.stiffness_n_per_m"] = 5000.0
    with pytest.raises(ValueError, match="scene of a recording"):
        scene["simulator.integrator"] = "rk4"


def test_compare_has_the_rows_of_the_command_line():
    expected = json.loads(hapticwall("compare", "press", "--json", "-"))
    rows = hw.compare("press")
    clock = {"ns_per_tick", "simulated_seconds_per_second"}
    assert [{k: v for k, v in row.items() if k not in clock} for row in rows] == [
        {k: v for k, v in row.items() if k not in clock} for row in expected
    ]


def test_a_batch_has_the_summaries_of_its_runs():
    scenes = [hw.load("press").replace({"device.mass_kg": m, **SHORT}) for m in (0.03, 0.05)]
    scenes.append(hw.load("corner").replace(SHORT))
    without_clock = [{**hw.run(s).summary, "ns_per_tick": None, "simulated_seconds_per_second": None} for s in scenes]
    assert hw.batch(scenes) == without_clock


def test_a_map_has_the_summaries_of_its_cells():
    x, y = np.geomspace(300.0, 1e5, 4), [0.3, 3.0, 30.0]
    algorithms = ["none", "energy-bounding"]
    found = hw.map(
        "press", x=("wall.stiffness_n_per_m", x), y=("device.damping_n_s_per_m", y), algorithms=algorithms
    )
    assert found.algorithms == algorithms and found.settled.shape == (2, 3, 4)
    for a, name in enumerate(algorithms):
        for i, damping in enumerate(y):
            for j, stiffness in enumerate(x):
                values = {"wall.stiffness_n_per_m": stiffness, "device.damping_n_s_per_m": damping}
                summary = hw.run(hw.load("press").replace(values), name).summary
                assert found.verdict[a, i, j] == summary["verdict"]
                assert found.settled[a, i, j] == (summary["verdict"] == "settled")
                for key in ("tail_peak_to_peak_m", "max_penetration_m", "saturated_ticks", "passivity_margin_j"):
                    one = np.nan if summary[key] is None else summary[key]
                    np.testing.assert_equal(found[key][a, i, j], one)


def test_a_map_tells_a_wrong_key_and_a_wrong_value():
    good = ("device.damping_n_s_per_m", [1.0])
    with pytest.raises(KeyError, match="did you mean 'wall.stiffness_n_per_m'"):
        hw.map("press", x=("wall.stifness_n_per_m", [1.0]), y=good)
    with pytest.raises(ValueError, match="out of range"):
        hw.map("press", x=("wall.stiffness_n_per_m", [1.0, -1.0]), y=good)
    with pytest.raises(ValueError, match="at least one value"):
        hw.map("press", x=("wall.stiffness_n_per_m", []), y=good)


def long_work(kind):
    scene = hw.load("press").replace({"duration_s": 1e5})
    if kind == "run":
        hw.run(scene)
    elif kind == "batch":
        hw.batch([scene, hw.load("press")])
    else:
        hw.map(scene, x=("wall.stiffness_n_per_m", [300.0, 301.0]), y=("device.damping_n_s_per_m", [1.0, 2.0]))


@pytest.mark.parametrize("kind", ["run", "batch", "map"])
def test_ctrl_c_ends_long_work(kind):
    # The timer's thread runs only because the work has released the interpreter's lock.
    timer = threading.Timer(0.2, os.kill, [os.getpid(), signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        long_work(kind)
    timer.join()
    assert hw.run(hw.load("press").replace(SHORT)).summary["ticks"] == 200


def test_many_runs_take_no_more_memory():
    def resident_bytes():
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def use(count):
        scene = hw.load("press").replace({"duration_s": 0.02})
        for i in range(count):
            run = hw.run(scene.replace({"hand.mass_kg": 0.1 + 1e-6 * i}))
            assert run.samples.size == 20 and run.summary["ticks"] == 20

    use(1000)
    warm = resident_bytes()
    use(10_000)
    assert resident_bytes() - warm < 2_000_000
