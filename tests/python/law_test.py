import ctypes
import pathlib
import threading

import numba
import numpy as np
import pytest
from numba import types

import hapticwall as hw
import laws

CLOCK = {"algorithm", "ns_per_tick", "simulated_seconds_per_second"}
WRITTEN = laws.written()
SHORT = hw.load("press").replace({"duration_s": 0.01})


def figures(summary):
    return {key: value for key, value in summary.items() if key not in CLOCK}


@pytest.fixture(params=WRITTEN.keys())
def mine(request):
    return WRITTEN[request.param]


@pytest.mark.parametrize("scene", ["press", "tap", "corner"])
def test_a_law_has_the_bits_of_the_built_in_one(mine, scene):
    built_in, own = hw.run(scene, "energy-bounding"), hw.run(scene, mine)
    assert (own.samples == built_in.samples).all()
    assert figures(own.summary) == figures(built_in.summary)


def test_the_same_in_a_comparison_a_map_and_a_rerun(mine, tmp_path):
    rows = hw.compare("press", ["energy-bounding", mine])
    assert figures(rows[0]) == figures(rows[1])
    found = hw.map(
        hw.load("press").replace({"duration_s": 0.3}),
        x=("wall.stiffness_n_per_m", [300.0, 3e4]),
        y=("algorithm.rest_force_step_n", [0.0, 0.02]),
        algorithms=["energy-bounding", mine],
    )
    for key in found.columns:
        np.testing.assert_array_equal(found[key][0], found[key][1])
    hw.run("press").save(tmp_path / "a.csv")
    recording = hw.read(tmp_path / "a.csv")
    assert (hw.rerun(recording, mine).samples == hw.rerun(recording, "energy-bounding").samples).all()


def fails(state, tick):
    if tick[0].tick == 100:
        raise ZeroDivisionError("at tick 100")
    return tick[0].wall_force_n


@numba.cfunc(types.float64(types.CPointer(types.float64), types.CPointer(laws.record)))
def numba_fails(state, tick):
    one = numba.carray(tick, 1)[0]
    if one.tick == 100:
        raise ZeroDivisionError("at tick 100")
    return one.wall_force_n


def callback(function):
    return ctypes.CFUNCTYPE(ctypes.c_double, laws.Double, ctypes.POINTER(hw.Input))(function)


failing = callback(fails)


@pytest.mark.parametrize(
    "step",
    [fails, failing, ctypes.cast(failing, ctypes.c_void_p).value, numba_fails, numba_fails.address],
    ids=["Python", "ctypes", "address of ctypes", "numba", "address of numba"],
)
def test_an_exception_is_no_force_and_is_told(step):
    law = hw.algorithm(step, name="fails")
    with pytest.raises(hw.LawError) as told:
        hw.run("press", law)
    assert isinstance(told.value.__cause__, ZeroDivisionError)
    run = told.value.result
    assert run.summary["verdict"] == "diverged" and run.summary["diverged_at_tick"] == 100
    assert run.samples["tick"][-1] == 99


@pytest.mark.parametrize("wrong", [lambda state, tick: None, lambda state: 0.0])
def test_what_is_no_law_is_told(wrong):
    with pytest.raises(hw.LawError) as told:
        hw.run("press", hw.algorithm(wrong, name="wrong"))
    assert isinstance(told.value.__cause__, TypeError)


def test_a_failing_configure_is_told():
    def configure(state, context):
        raise RuntimeError("no")

    law = hw.algorithm(laws.step, name="unconfigured", state_bytes=16, configure=configure)
    with pytest.raises(hw.LawError) as told:
        hw.batch([hw.load("press").replace({"algorithm.name": "unconfigured"})])
    assert told.value.result[0]["verdict"] == "diverged"
    assert law.name in hw.algorithms()


def test_a_map_with_a_failing_law_keeps_its_cells():
    law = hw.algorithm(fails, name="fails")
    with pytest.raises(hw.LawError) as told:
        one = {"x": ("wall.stiffness_n_per_m", [300.0]), "y": ("device.damping_n_s_per_m", [1.0])}
        hw.map("press", **one, algorithms=["none", law])
    assert told.value.result.verdict[1, 0, 0] == "diverged" != told.value.result.verdict[0, 0, 0]


def test_an_exception_elsewhere_is_not_of_the_law(monkeypatch):
    class Fails:
        def __del__(self):
            raise ValueError("elsewhere")

    heard, stop = [], threading.Event()
    monkeypatch.setattr("sys.unraisablehook", heard.append)

    def drop():
        while not stop.is_set():
            Fails()

    thread = threading.Thread(target=drop)
    thread.start()
    try:
        hw.run("press", WRITTEN["Python"])
    finally:
        stop.set()
        thread.join()
    assert heard


def test_a_law_under_a_name_is_replaced():
    law = hw.algorithm(lambda state, tick: 1.0, name="changing")
    assert hw.run("press", law).samples["force_n"][-1] == 1.0
    hw.algorithm(lambda state, tick: 2.0, name="changing")
    assert hw.run("press", law).samples["force_n"][-1] == 2.0
    with pytest.raises(ValueError, match="other parameters"):
        hw.algorithm(lambda state, tick: 3.0, name="changing", parameters=[hw.Parameter("gain", "", 0.0, 1.0)])


def test_the_state_is_zero_at_first_and_of_one_run():
    def count(state, tick):
        state[0] += 1.0
        return state[0] * 1e-3

    law = hw.algorithm(count, name="counts", state_bytes=8)
    for _ in range(2):
        run = hw.run(hw.load("press").replace({"duration_s": 0.05}), law)
        np.testing.assert_allclose(run.samples["force_n"], 1e-3 * np.arange(1, 51))


@pytest.mark.parametrize("index", [1, 5000, 100_000, -2])
@pytest.mark.parametrize("function", ["step", "configure", "reset"])
def test_the_state_has_an_end(function, index):
    def write(state, *others):
        state[index] = 1.0
        return 0.0

    functions = {"step": lambda state, tick: 0.0, function: write}
    law = hw.algorithm(**functions, name="writes", state_bytes=8)
    with pytest.raises(hw.LawError) as told:
        hw.run(SHORT, law)
    assert isinstance(told.value.__cause__, IndexError)


@pytest.mark.parametrize("state_bytes, length", [(0, 0), (7, 0), (8, 1), (20, 2), (262144, 32768)])
def test_the_state_has_its_length(state_bytes, length):
    lengths = []
    law = hw.algorithm(
        lambda state, tick: lengths.append(len(state)) or 0.0,
        name="measures",
        state_bytes=state_bytes,
        configure=lambda state, context: lengths.append(len(state)),
        reset=lambda state: lengths.append(len(state)),
    )
    hw.run(SHORT, law)
    assert set(lengths) == {length}


def test_arrays_of_the_host_have_an_end():
    found, wrong = [], []

    def configure(state, context):
        scene = context[0]
        found.append((list(scene.parameters), [wall.stiffness_n_per_m for wall in scene.walls]))
        for read in (lambda: scene.parameters[2], lambda: scene.walls[1], lambda: context[1]):
            try:
                wrong.append(read())
            except IndexError:
                pass
        assert context.contents.period_s == scene.period_s

    def step(state, tick):
        assert tick.contents.tick == tick[0].tick
        return tick[1].wall_force_n

    parameters = [hw.Parameter("gain_a", "", 0.0, 1.0, 0.25), hw.Parameter("gain_b", "", 0.0, 1.0, 0.5)]
    law = hw.algorithm(step, name="reads", configure=configure, parameters=parameters)
    with pytest.raises(hw.LawError) as told:
        hw.run(SHORT, law)
    assert isinstance(told.value.__cause__, IndexError)
    assert found == [([0.25, 0.5], [SHORT["wall.stiffness_n_per_m"]])] and wrong == []


def test_what_the_types_of_a_callback_tell_is_checked():
    three = ctypes.POINTER(ctypes.c_double * 3)
    large = ctypes.CFUNCTYPE(ctypes.c_double, three, ctypes.POINTER(hw.Input))(lambda state, tick: state.contents[2])
    with pytest.raises(ValueError, match="step takes a state of 24 bytes; state_bytes is 16"):
        hw.algorithm(large, name="large", state_bytes=16)
    hw.run(SHORT, hw.algorithm(large, name="large", state_bytes=24))
    narrow = ctypes.CFUNCTYPE(ctypes.c_float, laws.Double, ctypes.POINTER(hw.Input))(laws.step)
    compiled = numba.cfunc(types.float32(types.CPointer(types.float64), types.CPointer(laws.record)))(lambda s, t: 0.0)
    for step in (narrow, compiled):
        with pytest.raises(TypeError, match="step must return a double"):
            hw.algorithm(step, name="narrow")


def test_reset_follows_configure():
    calls = []
    law = hw.algorithm(
        lambda state, tick: 0.0,
        name="calls",
        configure=lambda state, context: calls.append("configure"),
        reset=lambda state: calls.append("reset"),
    )
    hw.run(hw.load("press").replace({"duration_s": 0.01}), law)
    assert calls[:2] == ["configure", "reset"]


@pytest.mark.parametrize(
    "arguments, problem",
    [
        ({"name": "energy-bounding"}, "called \"energy-bounding\" already"),
        ({"name": "No Name"}, "not a word"),
        ({"name": "big", "state_bytes": 1 << 20}, "at most 262144"),
        ({"name": "twice", "parameters": [hw.Parameter("damping_n_s_per_m", "kg", 0.0, 1.0)]}, "another unit"),
    ],
)
def test_what_a_plugin_must_not_be_is_refused(arguments, problem):
    with pytest.raises(ValueError, match=problem):
        hw.algorithm(laws.step, **arguments)


def test_no_law_is_registered_during_a_run():
    told = []

    def register(state, tick):
        if tick[0].tick == 0:
            try:
                hw.algorithm(laws.step, name="late")
            except RuntimeError as error:
                told.append(str(error))
        return 0.0

    hw.run(hw.load("press").replace({"duration_s": 0.01}), hw.algorithm(register, name="registers"))
    assert told == ["a run is in progress; register functions before or after it"]


def test_unknown_algorithms_are_told(tmp_path):
    with pytest.raises(ValueError, match="did you mean 'energy-bounding'"):
        hw.run("press", "energy-bouding")
    with pytest.raises(FileNotFoundError, match="mine.so"):
        hw.run("press", str(tmp_path / "mine.so"))
    path = pathlib.Path(WRITTEN["C"])
    assert (hw.run("press", path).samples == hw.run("press", WRITTEN["C"]).samples).all()


def test_a_recording_names_the_law(tmp_path):
    hw.run("press", WRITTEN["numba"]).save(tmp_path / "a.csv")
    assert 'name = "numba"' in (tmp_path / "a.toml").read_text()
    hw.run("press", WRITTEN["C"]).save(tmp_path / "b.csv")
    assert "plugin_sha256" in (tmp_path / "b.toml").read_text()
    assert hw.rerun(hw.read(tmp_path / "a.csv")).first_different_tick is None
