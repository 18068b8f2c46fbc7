"""The law of docs/from-a-paper-to-a-law.md against its promise.

The expected values are bounds of the proof on that page, computed from rows or by hand; they share no
code with the law.
"""

import ctypes
import pathlib
import re
import shutil
import subprocess

import numpy as np
import pytest

import hapticwall as hw

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/from-a-paper-to-a-law.md"
TEXT = PAGE.read_text(encoding="utf-8")
START_J, TOP_J, FLOOR_J = 0.01, 0.1, 0.001


def block(words):
    return re.search(rf"(?ms)^```{words}\n(.*?)^```", TEXT)[1]


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The names of the page after its blocks, but for those of map and figure."""
    names = {}
    for source in re.findall(r"(?ms)^```python\n(.*?)^```", TEXT):
        if "grid_of" not in source and "matplotlib" not in source:
            exec(compile(source, PAGE.name, "exec"), names)  # noqa: S102
    return names


@pytest.mark.parametrize("seed", range(1, 5))
def test_the_adversary_breaks_the_switch_and_not_the_bound(page, seed):
    least = {}
    for name in ("switch", "tank"):
        hand = page["adversary"](page[name], 400, seed)
        least[name] = page["promise"](page[name], hand).min()
    assert least["switch"] < -1e-3
    assert least["tank"] >= -1e-12


def tank_after_worst_motion(page, step):
    """The energy of the tank, J, by its equation, after a push of 0.5 mm and the motion -w/(2d)."""
    damping, period_s, wall = 1.0, 1e-3, 35000.0
    context = (hw.Context * 1)()
    context[0].period_s, context[0].device_damping_n_s_per_m, context[0].force_limit_n = period_s, damping, 1e9
    context[0].walls, context[0].wall_count = (hw.Wall * 1)((0.0, wall, 0.0)), 1
    context[0].parameters = (ctypes.c_double * 3)(START_J, TOP_J, FLOOR_J)
    state = [0.0] * 8
    page["configure"](state, context)
    page["reset"](state)
    tick = (hw.Input * 1)()
    spring = damping / period_s
    share = spring - spring / 2.0  # d
    depth_m = w_n = 0.0
    tank_j = START_J
    for k in range(6):
        moved_m = 1e-4 if k < 5 else -w_n / (2.0 * share)
        tank_j += w_n * moved_m + share * moved_m**2
        depth_m += moved_m
        tick[0].displacement_m, tick[0].penetration_m = moved_m, depth_m
        tick[0].wall_force_n = wall * max(0.0, depth_m)
        tick[0].previous_force_n = step(state, tick)
        w_n = tick[0].previous_force_n - spring * max(0.0, depth_m)
    assert tank_j < TOP_J
    return tank_j


def test_the_worst_motion_takes_the_tank_to_its_floor_and_no_further(page):
    assert tank_after_worst_motion(page, page["bounded"]) == pytest.approx(FLOOR_J, abs=1e-12)


def test_a_bound_that_is_one_percent_too_large_falls_below_the_floor(page):
    def too_large(state, tick):
        force_n = page["bounded"](state, tick)
        return state[page["SPRING"]] + 1.01 * (force_n - state[page["SPRING"]])

    assert tank_after_worst_motion(page, too_large) < FLOOR_J - 1e-5


def test_the_map_settles_where_positions_are_exact(page):
    found = hw.map(
        hw.load("press").replace({"device.encoder_m": 0.0}),
        x=("wall.stiffness_n_per_m", np.geomspace(300.0, 1e5, 6)),
        y=("device.damping_n_s_per_m", np.geomspace(0.1, 10.0, 6)),
        algorithms=["none", page["fast"]],
    )
    assert found.settled[1].all() and not found.settled[0].all()
    assert found["passivity_margin_j"][1].min() >= 0.0


def test_the_table_has_the_numbers_of_the_runs(page):
    rows = re.findall(r"(?m)^\| ([a-z-]+) \| (settled|oscillating) \| (\d+) \|", TEXT)
    assert len(rows) == 5
    for name, verdict, stiffness in rows:
        summary = hw.run("press", name).summary
        assert (verdict, int(stiffness)) == (summary["verdict"], round(summary["displayed_stiffness_n_per_m"]))


@pytest.mark.skipif(shutil.which("rustc") is None, reason="rustc is missing")
def test_the_step_in_rust_has_the_bits_of_the_step_in_python(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pathlib.Path("tank.rs").write_text(block("rust tank.rs"), encoding="utf-8")
    subprocess.run(block("sh rust").split(), check=True)
    exec(compile(block("python rust"), PAGE.name, "exec"), page)  # noqa: S102
    for scene in ("press", "light"):
        ours, theirs = hw.run(scene, page["rusty"]), hw.run(scene, page["tank"])
        assert (ours.samples == theirs.samples).all()
