"""Environments against programs that share no code with them, and in other languages."""

import json
import math
import os
import pathlib
import pickle
import shutil
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

import environments as own
import hapticwall as hw

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ROOT / "assets/examples/plugins/environment"
INCLUDE = ROOT / "core/algorithm/plugin/include"
BUILD = {
    "c": (("cc", "-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-shared", f"-I{INCLUDE}"), ("-lm",)),
    "cpp": (("c++", "-std=c++20", "-O2", "-ffp-contract=off", "-fPIC", "-shared", f"-I{INCLUDE}"), ()),
    "rs": (("rustc", "--edition", "2021", "--crate-type", "cdylib", "-O"), ()),
}


def same(a, b):
    """The rows of two runs, but for the signals of one of them."""
    for name in a.samples.dtype.names:
        np.testing.assert_array_equal(a.samples[name], b.samples[name], err_msg=name)


# ---- the forces, by the formulas of docs/environments.md and Python's math ----


def test_tissue_has_its_force():
    rows = hw.run("tissue", "none").samples
    p = rows["position_m"] - 0.05
    expected = np.where(p > 0, 5.0 * np.maximum(p / 0.01, 0) ** 1.5 * (1 + 0.5 * rows["velocity_m_per_s"]), 0)
    np.testing.assert_allclose(rows["wall_force_n"], np.maximum(expected, 0), rtol=0, atol=1e-14)
    assert rows["wall_force_n"].max() > 3.0


def test_detents_have_their_force():
    rows = hw.run("detents", "none").samples
    expected = 2.0 * np.sin(2 * np.pi * (rows["position_m"] - 0.05) / 0.01)
    np.testing.assert_allclose(rows["wall_force_n"], expected, rtol=0, atol=2e-14)
    assert np.ptp(rows["wall_force_n"]) > 3.9


def test_a_bump_has_the_slope_of_its_potential():
    session = []
    with hw.Session("bump", "none") as s:
        while s.time_s < 6.0:
            x = s.step()
            y = s.sample_y
            session.append((x.position_m, y.position_m, x.wall_force_n, y.wall_force_n))
    x, y, force_x, force_y = np.array(session).T

    def energy(x, y):
        return 10.0 * 0.005 * np.exp(-((x - 0.05) ** 2 + (y - 0.05) ** 2) / (2 * 0.008**2))

    h = 1e-6
    np.testing.assert_allclose(force_x, (energy(x + h, y) - energy(x - h, y)) / (2 * h), atol=1e-6)
    np.testing.assert_allclose(force_y, (energy(x, y + h) - energy(x, y - h)) / (2 * h), atol=1e-6)


# ---- whole motions: a free handle under a held force has a closed form ----


def next_state(x, v, force_n, mass_kg, damping, period_s):
    """After a period under a constant force."""
    decay = math.exp(-damping / mass_kg * period_s)
    end = force_n / damping
    return x + end * period_s + (v - end) * mass_kg / damping * (1 - decay), end + (v - end) * decay


def push(k):
    return 1.5 * math.sin(2 * math.pi * k / 700) + 0.4


def motion(force_of, ticks, mass_kg=0.1, damping=2.0, period_s=1e-3, start_m=0.03):
    """Positions of a handle that the program pushes, by `force_of(x, dx, k)` of the environment."""
    x, v, before = start_m, 0.0, start_m
    positions = []
    for k in range(ticks):
        positions.append(x)
        force = force_of(x, (x - before) / period_s if k else 0.0, k)
        before = x
        x, v = next_state(x, v, push(k) - force, mass_kg, damping, period_s)
    return np.array(positions)


class OwnMass:
    """w += T F/M, m += T w, from rest at the handle."""

    def __init__(self):
        self.place = None
        self.speed = 0.0

    def __call__(self, x, v, k):
        force = 0.0 if self.place is None else 1000.0 * (x - self.place)
        if self.place is None:
            self.place = x
        self.speed += 1e-3 * force / 0.5
        self.place += 1e-3 * self.speed
        return force


def hertz(x, v, k):
    return max(0.0, 5.0 * (max(0.0, x - 0.031) / 0.01) ** 1.5 * (1 + 0.5 * v))


CLOSED = {
    "hunt-crossley": ({"environment.position_m": 0.031}, lambda: hertz),
    "detents": ({}, lambda: lambda x, v, k: 2.0 * math.sin(2 * math.pi * (x - 0.05) / 0.01)),
    "virtual-mass": ({}, OwnMass),
    "bump": (
        {},
        lambda: lambda x, v, k: -10.0 * 0.005 * (x - 0.05) / 0.008**2 * math.exp(-((x - 0.05) ** 2) / (2 * 0.008**2)),
    ),
}


@pytest.mark.parametrize("name", CLOSED)
def test_the_motion_is_that_of_the_closed_form(name):
    values, force_of = CLOSED[name]
    scene = hw.Scene.from_text(
        f"""
name = "free"
duration_s = 1.4
[device]
mass_kg = 0.1
damping_n_s_per_m = 2.0
start_m = 0.03
[environment]
name = "{name}"
[algorithm]
name = "none"
"""
    ).replace(values)
    positions = []
    with hw.Session(scene) as session:
        for k in range(1400):
            positions.append(session.step(push(k)).position_m)
    np.testing.assert_allclose(positions, motion(force_of(), 1400), rtol=0, atol=1e-12)
    assert np.ptp(positions) > 0.002


# ---- a closed path over the bump ----


def round_trip(law, form, direction):
    """Energies, J, that go into the bump along an ellipse beside its top, from rest to rest.

    Of both axes: exchanged (Eq. 10), of the hold (Eq. 9) and the budget.
    """
    t = np.linspace(0, 4, 201)
    angle = direction * 2 * np.pi * t / 4
    x, y = 0.053 + 0.011 * np.cos(angle), 0.049 + 0.007 * np.sin(angle)
    values = {"duration_s": 9.0, "algorithm.name": law, "algorithm.form": form}
    for axis, place in (("", x), (".y", y)):
        values |= {
            f"device{axis}.encoder_m": 0.0,
            f"device{axis}.friction_n": 0.0,
            f"device{axis}.start_m": place[0],
            f"hand{axis}.stiffness_n_per_m": 2000.0,
            f"hand{axis}.path": [[0, place[0]], *([1.5 + a, b] for a, b in zip(t, place, strict=True))],
        }
    before, after = np.zeros(4), np.zeros(4)
    with hw.Session(hw.load("bump").replace(values)) as session:
        while session.time_s < 9.0:
            rows = (session.step(), session.sample_y)
            if session.tick in (1500, 9000):
                sums = [sum(getattr(row, f"energy_{key}_j") for row in rows) for key in ("scv", "hold", "budget")]
                before, after = after, np.array([*sums, rows[0].true_position_m])
    assert abs(after[3] - before[3]) < 1e-9, "the path is not closed"
    return (after - before)[:3]


@pytest.mark.parametrize("direction", [1, -1])
def test_a_closed_path_takes_no_work_either_way(direction):
    """Half of what the hold costs is the difference of the sum of Eq. 10 to the trapezoidal rule."""
    for law, form in (("none", "per-axis"), ("energy-bounding", "vector")):
        exchanged, hold, budget = round_trip(law, form, direction)
        assert abs(exchanged - 0.5 * hold) < 5e-9
        assert hold > 1e-4 and budget < -1e-3
    # The bound of each axis by itself turns the force, so that the bump takes energy on the way.
    exchanged, hold, budget = round_trip("energy-bounding", "per-axis", direction)
    assert exchanged - 0.5 * hold > 1e-4
    assert exchanged >= budget


def turns(form):
    """The largest angle between F_d and F_e, degrees, on a quick pass beside the top."""
    values = {"algorithm.name": "energy-bounding", "algorithm.form": form, "duration_s": 0.5}
    for axis in ("", ".y"):
        values |= {f"device{axis}.encoder_m": 0.0, f"device{axis}.friction_n": 0.0}
    values |= {"device.y.start_m": 0.049, "hand.path": [[0, 0.02], [0.3, 0.08]], "hand.y.path": [[0, 0.049]]}
    largest = 0.0
    with hw.Session(hw.load("bump").replace(values)) as session:
        while session.time_s < 0.5:
            x, y = session.step(), session.sample_y
            if math.hypot(x.wall_force_n, y.wall_force_n) < 0.3 or math.hypot(x.force_n, y.force_n) < 0.1:
                continue
            across = x.wall_force_n * y.force_n - y.wall_force_n * x.force_n
            along = x.wall_force_n * x.force_n + y.wall_force_n * y.force_n
            largest = max(largest, math.degrees(abs(math.atan2(across, along))))
    return largest


def test_the_vector_form_keeps_the_direction_of_the_force():
    assert turns("per-axis") == pytest.approx(57.5, abs=0.1)
    assert turns("vector") < 0.1


# ---- other languages ----


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("environments")
    made = {}
    for kind, (before, after) in BUILD.items():
        if shutil.which(before[0]) is None:
            continue
        target = folder / f"tissue_{kind}.so"
        subprocess.run([*before, SOURCES / f"tissue.{kind}", "-o", target, *after], check=True)
        made[kind] = target
    assert {"c", "cpp"} <= set(made)
    return made


SHORT = {"duration_s": 1.5}


def expected(law):
    return hw.run(hw.load("tissue").replace(SHORT), law)


def bare():
    """The scene without the table of the built-in one."""
    text = str(hw.load("tissue").replace(SHORT))
    return hw.Scene.from_text(text.replace("exponent", "# exponent").replace("dissipation", "# dissipation"))


@pytest.mark.parametrize("law", ["none", "energy-bounding", "half-sample", "passivity-control"])
def test_every_language_has_the_bits_of_the_built_in_one(built, law):
    for path in built.values():
        environment = hw.load_environment(path)
        same(hw.run(bare().replace({"environment.name": environment}), law), expected(law))


def ways():
    return {
        "python": own.tissue(own.force, own.depth, "own-python"),
        "numba": own.tissue(own.numba_force, own.numba_depth, "own-numba"),
        "ctypes": own.tissue(own.ctypes_force, own.depth, "own-ctypes"),
    }


@pytest.mark.parametrize("way", ["python", "numba", "ctypes"])
def test_every_way_of_python_has_the_bits_of_the_built_in_one(way):
    scene = bare().replace({"environment.name": ways()[way]})
    same(hw.run(scene, "energy-bounding"), expected("energy-bounding"))


def test_a_mass_of_ones_own_has_the_bits_of_the_built_in_one():
    built_in = hw.load("mass").replace(SHORT)
    mine = hw.load("mass").replace({**SHORT, "environment.name": own.mass()})
    for law in ("none", "energy-bounding"):
        ours, theirs = hw.run(mine, law), hw.run(built_in, law)
        for name in ("wall_force_n", "force_n", "position_m", "true_position_m", "energy_scv_j"):
            np.testing.assert_array_equal(ours.samples[name], theirs.samples[name])


# ---- travel and mistakes ----


def test_an_environment_travels_with_its_scene(built):
    scenes = [
        bare().replace({"environment.name": ways()["python"]}),
        bare().replace({"environment.name": hw.load_environment(built["c"])}),
        hw.load("detents").replace(SHORT),
    ]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as executor:
        assert hw.batch(scenes, executor=executor, rows_per_task=1) == hw.batch(scenes)


def test_another_file_is_refused(built, tmp_path):
    target = tmp_path / "moved.so"
    shutil.copy(built["cpp"], target)
    script = tmp_path / "send.py"
    script.write_text(
        "import pickle, sys, hapticwall as hw\n"
        "scene = hw.load('press').replace({'environment.name': hw.load_environment(sys.argv[1])})\n"
        "sys.stdout.buffer.write(pickle.dumps(scene))\n"
    )
    sent = subprocess.run([sys.executable, script, target], check=True, capture_output=True, env=os.environ).stdout
    target.write_bytes(built["c"].read_bytes())
    arrive = tmp_path / "arrive.py"
    arrive.write_text("import pickle, sys\npickle.loads(sys.stdin.buffer.read())\n")
    refused = subprocess.run([sys.executable, arrive], input=sent, capture_output=True, env=os.environ, check=False)
    assert refused.returncode != 0
    assert b"not the plug-in that was sent" in refused.stderr


def test_a_lambda_cannot_travel():
    mine = hw.environment(lambda state, motion: 0.0, name="own-lambda")
    with pytest.raises(ValueError, match="own-lambda.*force cannot travel"):
        pickle.dumps(hw.load("press").replace({"environment.name": mine}))


def test_an_exception_is_told_and_ends_the_force():
    def broken(state, motion):
        if motion[0].time_s > 0.2:
            raise ZeroDivisionError("a test")
        return 1.0

    mine = hw.environment(broken, name="own-broken")
    with pytest.raises(hw.LawError) as raised:
        hw.run(hw.load("press").replace({"environment.name": mine}), "none")
    assert isinstance(raised.value.__cause__, ZeroDivisionError)
    rows = raised.value.result.samples
    assert len(rows) == 201 and (rows["force_n"] == 1.0).all()
    assert raised.value.result.summary["diverged_at_tick"] == 201


def test_mistakes_have_one_line():
    with pytest.raises(ValueError, match="takes the place of the walls"):
        hw.Scene.from_text(str(hw.load("press")) + '[environment]\nname = "detents"\n')
    with pytest.raises(ValueError, match="needs the stiffness"):
        hw.load("press").replace({"environment.name": ways()["python"], "algorithm.name": "virtual-coupling"})
    with pytest.raises(ValueError, match="no environment is called"):
        hw.load("press").replace({"environment.name": "detent"})
    with pytest.raises(ValueError, match="force has the address 0"):
        hw.environment(0, name="own-nothing")


def program(*arguments):
    command = [os.environ["HAPTICWALL"], *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=100)


def test_a_comparison_leaves_out_what_needs_a_stiffness_and_refuses_it_by_name(built):
    done = program("compare", "press", "--duration", 0.2, "--environment", built["c"], "--json", "-")
    rows = [row["algorithm"] for row in json.loads(done.stdout)]
    assert done.returncode == 0 and len(rows) == 8
    assert not {"virtual-coupling", "energy-limited-spring"} & set(rows)
    assert done.stderr.count("note: left out: ") == 2
    named = program("compare", "press", "--environment", built["c"], "--algorithms", "none,virtual-coupling")
    assert named.returncode == 2 and "virtual-coupling needs the stiffness" in named.stderr


def test_a_sidecar_tells_another_file(built, tmp_path):
    library, csv = tmp_path / "tissue.so", tmp_path / "a.csv"
    shutil.copy(built["c"], library)
    run = ("--environment", library, "--duration", 0.2, "--quiet")
    assert program("run", "press", *run, "--csv", csv).returncode == 0
    alone = program("run", csv.with_suffix(".toml"))
    assert alone.returncode == 2 and "which a scene does not load; if you trust it, --environment" in alone.stderr
    run = ("run", csv.with_suffix(".toml"), "--environment", library)
    assert "will differ from the recorded session" not in program(*run).stderr
    with library.open("ab") as file:
        file.write(b"rebuilt")
    assert "will differ from the recorded session" in program(*run).stderr


def test_a_fault_of_a_library_is_told_at_the_end(tmp_path):
    text = (SOURCES / "tissue.cpp").read_text(encoding="utf-8")
    source = tmp_path / "broken.cpp"
    source.write_text(text.replace("if (!(depth > 0.0)) return 0.0;", "if (depth > 1e-3) throw 1;"), encoding="utf-8")
    before, after = BUILD["cpp"]
    subprocess.run([*before, source, "-o", tmp_path / "broken.so", *after], check=True)
    done = program("run", "press", "--environment", tmp_path / "broken.so", "--algorithm", "none")
    assert "threw an exception, and the force was zero from then on" in done.stderr
