import json
import os
import signal
import subprocess
import sys
import threading

import h5py
import numpy as np
import pandas as pd
import pytest

import hapticwall as hw
from hapticwall import _core

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


def stored(samples, folder):
    """Samples after a file of NumPy, of HDF5, and as a data frame."""
    np.save(folder / "a.npy", samples)
    yield np.load(folder / "a.npy")
    with h5py.File(folder / "a.h5", "w") as file:
        file["samples"] = samples
    with h5py.File(folder / "a.h5") as file:
        assert isinstance(file["samples"].id.get_type(), h5py.h5t.TypeCompoundID)
        yield file["samples"][:]
    frame = pd.DataFrame(samples)
    yield {name: frame[name].to_numpy() for name in frame}


@pytest.mark.parametrize("name", ["tap", "corner"])
def test_other_programs_store_and_read_the_samples(name, tmp_path):
    samples = hw.run(hw.load(name).replace(SHORT)).samples
    offsets = [samples.dtype.fields[column][1] for column in samples.dtype.names]
    assert offsets == sorted(offsets)
    for found in stored(samples, tmp_path):
        columns = list(found) if isinstance(found, dict) else list(found.dtype.names)
        assert columns == list(samples.dtype.names)
        for column in columns:
            assert found[column].dtype == samples[column].dtype
            np.testing.assert_array_equal(found[column], samples[column])


def test_the_signals_of_a_recording_are_columns(tmp_path):
    for name in ("press", "corner"):
        hapticwall("run", name, "--algorithm", "passivity-control", "--signals", "--csv", str(tmp_path / "a.csv"))
        samples = hw.read(tmp_path / "a.csv").samples
        rows = pd.read_csv(tmp_path / "a.csv")
        assert list(samples.dtype.names) == list(rows)
        assert [column for column in rows if "signal." in column and rows[column].any()]
        np.save(tmp_path / "a.npy", samples)
        for column in rows:
            np.testing.assert_array_equal(samples[column], rows[column])
            np.testing.assert_array_equal(np.load(tmp_path / "a.npy")[column], rows[column])


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
    with pytest.raises(ValueError, match="wall.stiffness_n_per_m: a grid of 2 dimensions; give x and y one list"):
        hw.map("press", x=("wall.stiffness_n_per_m", [[1.0, 2.0], [3.0, 4.0]]), y=good)
    with pytest.raises(ValueError, match="x and y are the same key, device.damping_n_s_per_m"):
        hw.map("press", x=good, y=good)
    with pytest.raises(ValueError, match="x and y are the same key, wall.stiffness_n_per_m"):
        hw.map("press", x=("wall.stiffness_n_per_m", [1.0]), y=("wall[0].stiffness_n_per_m", [1.0]))
    with pytest.raises(ValueError, match="device.delay_ticks: 0.5 where a whole number belongs"):
        hw.map("press", x=("device.delay_ticks", [0.0, 0.5]), y=good)
    million = np.linspace(1.0, 2.0, 1_000_000)
    with pytest.raises(ValueError, match="a map of 1000000000000 cells; it takes at most 100000000"):
        hw.map("press", x=("wall.stiffness_n_per_m", million), y=("device.mass_kg", million), algorithms=["none"])


HAND = ("most_j", "typical_j", "least_j", "taken_j", "taken_at_rest_j", "last_second_w")


@pytest.mark.parametrize("motion", ["let-go", "ramp"])
def test_worst_hand_is_that_of_the_command_line(motion):
    options = ("--duration", "1.5", "--hands", "60", "--seed", "7", "--bounds", "narrow", "--motion", motion)
    text = hapticwall("worst-hand", "tap", "--algorithms", "none,force-bounding", *options, "--json", "-")
    scene = hw.load("tap").replace({"duration_s": 1.5})
    for row, threads in zip(json.loads(text)["rows"], (1, 2), strict=True):
        found = hw.worst_hand(
            scene, row["algorithm"], hands=60, seed=7, bounds="narrow", motion=motion, threads=threads
        )
        assert (found.hands, found.refused_hands, found.first_hand) == (60, row["refused_hands"], row["first_hand"])
        assert [getattr(found, key) for key in HAND] == [row[key] for key in HAND]
        assert " ".join(found.at_bound) == (row["at_bound"] or "")
        for key, value in found.numbers.items():
            assert value == row[key]
        if found.scene is not None:
            assert hw.run(found.scene).summary["passivity_margin_j"] == -found.taken_j
    assert found.scene is None and found.numbers == {} and row["most_j"] is None


def test_worst_hand_tells_a_wrong_argument():
    with pytest.raises(ValueError, match="hands: 1 to 10000000"):
        hw.worst_hand("tap", hands=0)
    with pytest.raises(ValueError, match='bounds: "wide" or "narrow"'):
        hw.worst_hand("tap", bounds="Wide")
    with pytest.raises(ValueError, match='motion: "let-go" or "ramp"'):
        hw.worst_hand("tap", motion="push")
    with pytest.raises(ValueError, match="the search starts in front of the walls"):
        hw.worst_hand(hw.load("tap").replace({"device.start_m": 0.06}))


def long_work(kind):
    scene = hw.load("press").replace({"duration_s": 1e5})
    if kind == "run":
        hw.run(scene)
    elif kind == "batch":
        hw.batch([scene, hw.load("press")])
    elif kind == "worst_hand":
        hw.worst_hand(scene)
    else:
        hw.map(scene, x=("wall.stiffness_n_per_m", [300.0, 301.0]), y=("device.damping_n_s_per_m", [1.0, 2.0]))


@pytest.mark.parametrize("kind", ["run", "batch", "map", "worst_hand"])
def test_ctrl_c_ends_long_work(kind):
    # The timer's thread runs only because the work has released the interpreter's lock.
    timer = threading.Timer(0.2, os.kill, [os.getpid(), signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        long_work(kind)
    timer.join()
    assert hw.run(hw.load("press").replace(SHORT)).summary["ticks"] == 200


def test_the_check_of_a_large_map_hears_ctrl_c(monkeypatch):
    # The last cells are wrong: a check that heard nothing would end with a ValueError.
    values, wrong = np.full(2000, 300.0), np.append(np.full(1999, 1.0), -1.0)
    begins, run_map = threading.Event(), _core.map

    def interrupt():
        begins.wait()
        os.kill(os.getpid(), signal.SIGINT)

    # The thread goes on only when _core.map() gives the interpreter's lock away.
    monkeypatch.setattr(_core, "map", lambda *arguments: (begins.set(), run_map(*arguments)))
    thread = threading.Thread(target=interrupt)
    thread.start()
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000.0)
    try:
        with pytest.raises(KeyboardInterrupt):
            hw.map("press", x=("wall.stiffness_n_per_m", values), y=("device.damping_n_s_per_m", wrong))
    finally:
        sys.setswitchinterval(interval)
    thread.join()


SCRIPTS = {
    "globals": "scene = hw.load('press'); run = hw.run(scene); samples = run.samples; grid = hw.compare",
    "a law": """
scene = hw.load("press")
mine = hw.algorithm(lambda state, tick: scene["hand.mass_kg"], name="mine")
run = hw.run(scene, mine)""",
    "a cycle": """
class Keeps: pass
one = Keeps(); one.run = hw.run("press"); one.itself = one; hw.kept = one""",
    "a thread": """
import threading
run = hw.run("press")
threading.Thread(target=lambda run: threading.Event().wait(), args=[run], daemon=True).start()""",
    "another library": """
import ctypes
run = hw.run("press")
ctypes.pythonapi.Py_IncRef(ctypes.py_object(run))""",
    "an exception": "run = hw.run('press'); scene = run.scene; raise SystemExit(0)",
}


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_script_ends_without_a_word(script):
    done = subprocess.run([sys.executable, "-c", "import hapticwall as hw\n" + SCRIPTS[script]], capture_output=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


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
