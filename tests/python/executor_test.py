"""Batches, maps and searches as tasks of an executor: the same bits, and what is left after a loss."""

import multiprocessing
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool

import numpy as np
import pytest

import hapticwall as hw
import laws
import travelling
from hapticwall import _executor

SHORT = {"duration_s": 0.05}
LAWS = travelling.registered()
PRESS = hw.load("press").replace(SHORT)
SCENES = [PRESS.replace({"device.mass_kg": mass}) for mass in np.linspace(0.03, 0.3, 7)]
SCENES.insert(3, hw.load("corner").replace(SHORT))
GRID = {
    "x": ("wall.stiffness_n_per_m", [300.0, 3e3, 3e4]),
    "y": ("device.damping_n_s_per_m", [0.3, 3.0, 30.0, 40.0, 50.0]),
}


def workers(method, count=2):
    if method == "threads":
        return ThreadPoolExecutor(count)
    return ProcessPoolExecutor(count, mp_context=multiprocessing.get_context(method))


@pytest.fixture(scope="module", params=["fork", "spawn", "threads"])
def executor(request):
    with workers(request.param) as made:
        yield made


def same_map(found, expected):
    assert (found.algorithms, found.x_key, found.y_key) == (expected.algorithms, expected.x_key, expected.y_key)
    assert list(found.columns) == list(expected.columns)
    for key in expected.columns:
        np.testing.assert_array_equal(found[key], expected[key])
    assert (found.x == expected.x).all() and (found.y == expected.y).all()


@pytest.mark.parametrize("rows", [1, 3, 100])
def test_a_batch_by_tasks_is_the_batch(executor, rows):
    parts = {}
    found = hw.batch(SCENES, executor=executor, rows_per_task=rows, on_rows=parts.__setitem__)
    assert found == hw.batch(SCENES)
    assert sorted(parts) == list(range(0, len(SCENES), rows))
    assert [row for first in sorted(parts) for row in parts[first]] == found
    assert hw.batch([], executor=executor) == []


@pytest.mark.parametrize("rows", [1, 2, 100])
def test_a_map_by_tasks_is_the_map(executor, rows):
    algorithms = ["none", "energy-bounding"]
    parts = []
    found = hw.map(
        PRESS, **GRID, algorithms=algorithms, executor=executor, rows_per_task=rows, on_rows=parts.append
    )
    expected = hw.map(PRESS, **GRID, algorithms=algorithms)
    same_map(found, expected)
    assert sum(part.verdict.size for part in parts) == found.verdict.size
    for part in parts:
        a = algorithms.index(part.algorithms[0])
        ys = np.isin(expected.y, part.y)
        np.testing.assert_array_equal(part["peak_force_n"][0], expected["peak_force_n"][a, ys])


def test_algorithms_travel_with_a_map_and_a_batch(executor):
    chosen = [LAWS["limited"], *laws.written().values()]
    chosen = [law for law in chosen if getattr(law, "name", "") not in ("by-address", "ctypes")]
    found = hw.map(PRESS, **GRID, algorithms=chosen, executor=executor, rows_per_task=2)
    same_map(found, hw.map(PRESS, **GRID, algorithms=chosen))
    scenes = [PRESS.with_algorithm(law) for law in chosen]
    assert hw.batch(scenes, executor=executor, rows_per_task=2) == hw.batch(scenes)


def test_a_boundary_by_tasks_is_the_boundary(executor):
    along = hw.Axis("wall.stiffness_n_per_m", 300.0, 1e5, 7, logarithmic=True)
    chosen = ["none", LAWS["limited"], "energy-bounding"]
    for x in (None, hw.Axis("device.damping_n_s_per_m", 1.0, 3.0, 3)):
        expected = hw.boundary(PRESS, along, x=x, algorithms=chosen)
        assert hw.boundary(PRESS, along, x=x, algorithms=chosen, executor=executor) == expected
        assert len(expected) == (3 if x is None else 9)
    with pytest.raises(ValueError, match="x and along are the same key"):
        hw.boundary(PRESS, along, x=along, algorithms=chosen, executor=executor)


def same_search(found, expected):
    assert {**vars(found), "scene": str(found.scene)} == {**vars(expected), "scene": str(expected.scene)}


@pytest.mark.parametrize("motion", ["let-go", "ramp"])
def test_a_search_for_a_hand_by_tasks_is_the_search(executor, motion):
    scene = hw.load("tap").replace({"duration_s": 0.3})
    for law, rows in (("none", 7), (LAWS["limited"], 100)):
        search = {"algorithm": law, "hands": 40, "seed": 5, "motion": motion}
        expected = hw.worst_hand(scene, **search)
        same_search(hw.worst_hand(scene, **search, executor=executor, rows_per_task=rows), expected)
    assert hw.worst_hand(scene, "none", hands=40, seed=5).taken_j > 0.0  # the search has found something


def test_a_search_by_tasks_tells_what_is_wrong(executor):
    with pytest.raises(ValueError, match="hands: 1 to 10000000"):
        hw.worst_hand("tap", hands=0, executor=executor)
    with pytest.raises(ValueError, match="rows_per_task: 1 or more, not 0"):
        hw.worst_hand("tap", executor=executor, rows_per_task=0)
    with pytest.raises(hw.LawError) as told:
        hw.worst_hand(hw.load("tap").replace(SHORT), LAWS["raises"], hands=20, executor=executor)
    assert isinstance(told.value.__cause__, ZeroDivisionError)
    assert told.value.result.hands == 20


def test_a_search_with_a_lost_worker_names_the_hands():
    deadly = hw.load("tap").replace(SHORT).with_algorithm(LAWS["kills"], deadly=1.0)
    with workers("fork", count=1) as executor, pytest.raises(hw.Unfinished) as told:
        hw.worst_hand(deadly, hands=20, executor=executor)
    assert told.value.result is None and told.value.missing == list(range(20))
    assert isinstance(told.value.__cause__, BrokenProcessPool)


def test_threads_of_one_call_do_not_change_a_bit():
    for threads in (1, 2, 5):
        assert hw.batch(SCENES, threads=threads) == hw.batch(SCENES)
        same_map(hw.map(PRESS, **GRID, threads=threads), hw.map(PRESS, **GRID))
        rows = hw.compare(PRESS, threads=threads)
        clock = {"ns_per_tick", "simulated_seconds_per_second"}
        assert [{k: v for k, v in row.items() if k not in clock} for row in rows] == [
            {k: v for k, v in row.items() if k not in clock} for row in hw.compare(PRESS)
        ]
    for call in (hw.batch, lambda scenes, threads: hw.compare(scenes[0], threads=threads)):
        with pytest.raises(ValueError, match="threads: 0 or more"):
            call(SCENES, threads=-1)


def test_a_wrong_argument_is_told_before_any_task(executor):
    asked = []
    parts = {"executor": executor, "on_rows": asked.append}
    with pytest.raises(KeyError, match="did you mean 'wall.stiffness_n_per_m'"):
        hw.map(PRESS, x=("wall.stifness_n_per_m", [1.0]), y=GRID["y"], **parts)
    with pytest.raises(ValueError, match="out of range"):
        hw.map(PRESS, x=("wall.stiffness_n_per_m", [1.0, -1.0]), y=GRID["y"], **parts)
    with pytest.raises(ValueError, match="rows_per_task: 1 or more, not 0"):
        hw.batch(SCENES, executor=executor, rows_per_task=0)
    mine = hw.algorithm(lambda state, tick: 0.0, name="lambda")
    with pytest.raises(ValueError, match="algorithm 'lambda': its step cannot travel"):
        hw.map(PRESS, **GRID, algorithms=[mine], **parts)
    with pytest.raises(ValueError, match="algorithm 'lambda': its step cannot travel"):
        hw.batch([PRESS.with_algorithm(mine)], executor=executor)
    assert asked == []


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_an_exception_of_a_law_comes_back(method):
    with workers(method) as executor:
        with pytest.raises(hw.LawError) as told:
            hw.map(PRESS, **GRID, algorithms=["none", LAWS["raises"]], executor=executor)
        assert isinstance(told.value.__cause__, ZeroDivisionError)
        found = told.value.result
        assert (found.verdict[1] == "diverged").any() and not (found.verdict == "").any()


def test_an_exception_is_heard_beside_a_call_that_ends_earlier():
    # The short call ends while the law of the long one still runs, and would take the hook with it.
    slow = hw.load("press").replace({"duration_s": 0.5}).with_algorithm(LAWS["raises late"])
    before = sys.unraisablehook
    with workers("threads") as executor:
        short = executor.submit(hw.run, PRESS.with_algorithm(LAWS["waits"]))
        assert travelling.waiting.wait(60.0)
        late = executor.submit(hw.run, slow)
        short.result()
        travelling.may_raise.set()
        with pytest.raises(hw.LawError) as told:
            late.result()
    assert isinstance(told.value.__cause__, ZeroDivisionError)
    assert told.value.result.summary["verdict"] == "diverged" and sys.unraisablehook is before


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_a_killed_worker_loses_only_its_own_rows(method):
    scenes = [PRESS.with_algorithm(LAWS["kills"], deadly=float(i == 5)) for i in range(8)]
    done = []
    with workers(method, count=1) as executor, pytest.raises(hw.Unfinished) as told:
        hw.batch(scenes, executor=executor, rows_per_task=1, on_rows=lambda first, rows: done.append(first))
    error = told.value
    assert isinstance(error.__cause__, BrokenProcessPool)
    assert error.missing == [5, 6, 7] and "3 rows are missing, BrokenProcessPool" in str(error)
    assert done == [0, 1, 2, 3, 4]
    healthy = [scene.replace({"algorithm.deadly": 0.0}) for scene in scenes]
    expected = hw.batch(healthy)
    assert error.result == expected[:5] + [None] * 3
    with workers(method) as executor:
        rest = hw.batch([healthy[i] for i in error.missing], executor=executor)
    assert error.result[:5] + rest == expected


def test_a_map_with_lost_rows_has_the_others():
    deadly = PRESS.with_algorithm(LAWS["kills"])
    grid = {"x": ("wall.stiffness_n_per_m", [300.0, 3e3]), "y": ("algorithm.deadly", [0.0, 0.0, 1.0, 0.0])}
    with workers("fork", count=1) as executor, pytest.raises(hw.Unfinished) as told:
        hw.map(deadly, **grid, algorithms=["none", LAWS["kills"]], executor=executor, rows_per_task=1)
    error = told.value
    assert error.missing == [(1, 2), (1, 3)]
    found = error.result
    assert (found.verdict[1, 2:] == "").all() and np.isnan(found["peak_force_n"][1, 2:]).all()
    healthy = hw.map(deadly, x=grid["x"], y=("algorithm.deadly", [0.0]), algorithms=["none", LAWS["kills"]])
    for row in ((0, 0), (0, 3), (1, 0), (1, 1)):
        np.testing.assert_array_equal(found["peak_force_n"][row], healthy["peak_force_n"][row[0], 0])
    again = pickle.loads(pickle.dumps(error))
    assert again.missing == error.missing and str(again) == str(error)
    assert not found.settled[1, 2:].any()


def test_a_worker_of_another_version_refuses_its_task():
    sent = pickle.dumps((hw.__version__, "another-build", [PRESS]))
    with pytest.raises(RuntimeError, match=rf"the worker has hapticwall {hw.__version__} .*\(another-build\)"):
        _executor.batch_task(sent, 0, 1)


def test_an_executor_that_is_shut_down_loses_all_rows():
    executor = ThreadPoolExecutor(1)
    executor.shutdown()
    with pytest.raises(hw.Unfinished, match="8 rows are missing, RuntimeError") as told:
        hw.batch(SCENES, executor=executor)
    assert told.value.result == [None] * 8


def test_an_error_of_on_rows_ends_the_call():
    futures = []

    class Kept(ThreadPoolExecutor):
        def submit(self, *task):
            futures.append(super().submit(*task))
            return futures[-1]

    def refuses(first, rows):
        raise LookupError("enough")

    with Kept(1) as executor, pytest.raises(LookupError, match="enough"):
        hw.batch(SCENES * 50, executor=executor, rows_per_task=1, on_rows=refuses)
    assert len(futures) == 50 * len(SCENES) and futures[-1].cancelled()


SCRIPT = """
import multiprocessing, sys
from concurrent.futures import ProcessPoolExecutor
import hapticwall as hw

def step(state, tick):
    return 0.5 * tick[0].wall_force_n

mine = hw.algorithm(step, name="mine")
if __name__ == "__main__":
    scene = hw.load("press").replace({"duration_s": 0.05}).with_algorithm(mine)
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context(sys.argv[1])) as executor:
        assert hw.batch([scene], executor=executor) == hw.batch([scene])
"""


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_a_law_of_the_script_itself_travels(method, tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT)
    subprocess.run([sys.executable, tmp_path / "script.py", method], check=True)
