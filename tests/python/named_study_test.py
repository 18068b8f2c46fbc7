"""Studies and boundaries: the rows of the command line."""

import json
import os
import signal
import threading

import pytest

import hapticwall as hw
from run_test import hapticwall

TAP = hw.load("tap").replace({"duration_s": 1.2})
DURATION = ("--duration", "1.2")
CLOCK = {"ns_per_tick", "ratio_to_exact", "set_up_ns"}


def without_clock(rows):
    return [{key: value for key, value in row.items() if key not in CLOCK} for row in rows]


def test_the_ranking_is_that_of_the_command_line():
    options = ("--algorithms", "none,energy-bounding", "--study", "--json", "-")
    expected = json.loads(hapticwall("compare", "tap", *DURATION, *options))["rows"]
    for threads in (0, 1):
        assert hw.study("ranking", TAP, algorithms=["none", "energy-bounding"], threads=threads) == expected


def test_the_accuracy_is_that_of_the_command_line():
    options = ("--substeps", "1,5", "--algorithm", "half-sample", "--json", "-")
    expected = json.loads(hapticwall("accuracy", "tap", *DURATION, *options))["rows"]
    found = hw.accuracy(TAP, "half-sample", substeps=[1, 5])
    assert without_clock(found) == without_clock(expected)
    assert [row["ns_per_tick"] > 0.0 for row in found] == [True] * len(expected)


def test_the_named_hands_are_those_of_the_command_line():
    options = ("--algorithms", "none,half-sample", "--hands", "all", "--json", "-")
    expected = json.loads(hapticwall("compare", "tap", *DURATION, *options))["rows"]
    assert hw.study("hands", TAP, algorithms=["none", "half-sample"]) == expected


def test_every_study_of_the_command_line_is_known():
    for name, options in hw.studies().items():
        told = hapticwall("compare" if name in ("ranking", "hands") else name, "--help")
        assert all(f"--{option}" in told for option in options)


def test_a_boundary_is_that_of_the_command_line():
    along = hw.Axis("wall.stiffness_n_per_m", 300.0, 1e6, 9, logarithmic=True)
    x = hw.Axis("device.damping_n_s_per_m", 1.0, 3.0, 3)
    options = ("--algorithms", "none,force-bounding", "--json", "-")
    texts = ("--boundary", "wall.stiffness_n_per_m=300:1e6:9:log", "--x", "device.damping_n_s_per_m=1:3:3")
    expected = json.loads(hapticwall("map", "tap", *DURATION, *texts, *options))["boundaries"]
    chosen = ["none", "force-bounding"]
    assert hw.boundary(TAP, along, x=x, algorithms=chosen) == expected
    assert hw.boundary(TAP, along, x=x, algorithms=chosen, threads=1) == expected
    one = json.loads(hapticwall("map", "tap", *DURATION, *texts[:2], "--tolerance", "0.1", *options))["boundaries"]
    assert hw.boundary(TAP, along, algorithms=chosen, tolerance=0.1) == one


def test_a_wrong_argument_is_told():
    along = hw.Axis("wall.stiffness_n_per_m", 300.0, 1e6, 9)
    with pytest.raises(ValueError, match="no study is called 'acuracy'; known: ranking, accuracy"):
        hw.study("acuracy", TAP)
    with pytest.raises(ValueError, match="has no option 'substep'; did you mean 'substeps'"):
        hw.accuracy(TAP, substep=[1])
    with pytest.raises(ValueError, match="substeps"):
        hw.accuracy(TAP, substeps=[0])
    with pytest.raises(KeyError, match="did you mean 'wall.stiffness_n_per_m'"):
        hw.boundary(TAP, hw.Axis("wall.stifness_n_per_m", 300.0, 1e6, 9))
    for wrong in (hw.Axis(along.key, 1.0, 2.0, 1), hw.Axis(along.key, 2.0, 1.0, 9), hw.Axis(along.key, 0.0, 1.0, 9, True)):
        with pytest.raises(ValueError, match="wall.stiffness_n_per_m: .*it takes"):
            hw.boundary(TAP, wrong)
    with pytest.raises(ValueError, match="x and along are the same key"):
        hw.boundary(TAP, along, x=along)
    with pytest.raises(ValueError, match="tolerance: 1e-12 to less than 1"):
        hw.boundary(TAP, along, tolerance=1.0)
    with pytest.raises(ValueError, match="threads: 0 or more"):
        hw.boundary(TAP, along, threads=-1)


@pytest.mark.parametrize("kind", ["study", "boundary"])
def test_ctrl_c_ends_a_study(kind):
    scene = hw.load("press").replace({"duration_s": 1e5})
    timer = threading.Timer(0.2, os.kill, [os.getpid(), signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        if kind == "study":
            hw.study("ranking", scene)
        else:
            hw.boundary(scene, hw.Axis("wall.stiffness_n_per_m", 300.0, 1e6, 9))
    timer.join()
