"""hw.Experiment: trials from Python, a simulated observer, and an end of either side at any moment.

HAPTICWALL_KILLS kills as often, and takes ten times as many trials.
"""

import csv
import importlib.util
import json
import math
import os
import pathlib
import random
import signal
import subprocess
import sys
import time

import jsonschema
import pytest

import hapticwall as hw

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "assets/examples/python"
PROGRAM = os.environ["HAPTICWALL"]
KEY = "wall.stiffness_n_per_m"
KILLS = int(os.environ.get("HAPTICWALL_KILLS", "4"))


def trial(stiffness, **more):
    return {"a": {KEY: 1000}, "b": {KEY: stiffness}, "correct": "b", **more}


def always(choice):
    return lambda felt: choice


def experiment(trials, folder, observer=always("b"), **more):
    names = {"participant": "P1", "answers": folder / "answers.csv", "program": PROGRAM, **more}
    return hw.Experiment(trials, observer=observer, **names)


def rows(folder):
    with (folder / "answers.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_a_list_is_answered_in_its_order(tmp_path):
    pause = {"kind": "break", "question": "Rest."}
    answers = experiment([trial(1200, step=1), pause, trial(1400, step=2), pause], tmp_path).run()
    assert [(one["trial"], one[f"b.{KEY}"], one["step"], one["chosen"], one["correct"]) for one in answers] == [
        (1, 1200.0, "1", "B", True),
        (2, 1400.0, "2", "B", True),
    ]
    assert [row["trial"] for row in rows(tmp_path)] == ["1", "2"]
    schema = json.loads((ROOT / "assets/schemas/answers.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(rows(tmp_path))


def test_pandas_reads_the_answers(tmp_path):
    pandas = pytest.importorskip("pandas")
    steps = [trial(1000 + 50 * step, step=step, note='a, "b"') for step in range(1, 5)]
    experiment(steps, tmp_path, participant="007").run()
    table = pandas.read_csv(tmp_path / "answers.csv", dtype={"participant": str})
    assert table[f"b.{KEY}"].tolist() == [1050, 1100, 1150, 1200]
    assert table["participant"].tolist() == ["007"] * 4 and table["step"].tolist() == [1, 2, 3, 4]
    assert set(table["note"]) == {'a, "b"'} and table["contact_s"].dtype == float
    assert table["seed"].map(int).nunique() == 1


def test_a_generator_gets_each_answer(tmp_path):
    heard = []

    def trials():
        for stiffness in (1100, 1300):
            heard.append((yield trial(stiffness)))

    answers = experiment(trials(), tmp_path, always("a")).run()
    assert heard == answers and [one["correct"] for one in answers] == [False, False]


def test_an_observer_meets_the_walls(tmp_path):
    met = []

    def watch(felt):
        met.append(felt)
        return "a"

    (answer,) = experiment([trial(2000, trial=7)], tmp_path, watch).run()
    (felt,) = met
    assert felt.number == 7 and felt.values == {f"a.{KEY}": 1000.0, f"b.{KEY}": 2000.0}
    # Each wall is what the scene's hand meets in a run of its own.
    for slot, stiffness in (("a", 1000), ("b", 2000)):
        run = hw.run(hw.load("press").replace({KEY: stiffness}))
        assert felt.exposures[slot]["max_force_n"] == pytest.approx(abs(run.samples["force_n"]).max(), rel=1e-12)
        assert felt.exposures[slot]["touches"] >= 1
    assert answer["contact_s"] == pytest.approx(sum(one["contact_s"] for one in felt.exposures.values()), rel=1e-9)
    assert answer["max_force_n"] == max(one["max_force_n"] for one in felt.exposures.values())


def test_walls_come_first_equally_often(tmp_path):
    answers = experiment([trial(1200)] * 16, tmp_path).run()
    for half in (answers[:8], answers[8:]):
        assert sum(one["first"] == "A" for one in half) == 4


def test_a_simulated_observer_has_its_jnd():
    observer = hw.observer(KEY, jnd=0.1, seed=3)

    def share(b, count=4000):
        felt = [hw.Felt(i, {}, "a", {f"a.{KEY}": 1000.0, f"b.{KEY}": b}, {}) for i in range(count)]
        return sum(observer(one) == "b" for one in felt) / count

    spread = 4 * math.sqrt(0.25 / 4000)  # four standard deviations
    assert share(1000.0) == pytest.approx(0.5, abs=spread)
    assert share(1100.0) == pytest.approx(0.75, abs=spread)
    assert share(1e6) == 1.0
    with pytest.raises(ValueError, match="jnd"):
        hw.observer(KEY, jnd=0.0)


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ({"a": {KEY: -1}, "b": ""}, "out of range"),
        ({"a": "", "b": ""}, "both empty"),
        ({"a": "", "b": {"device.mass_kg": 1}}, "first trial sets no such key"),
        (trial(1100, surprise=1), "first trial has no such column"),
        (trial(1100, trial=1), "given before"),
        (trial(1100, list=[1]), "takes a text or a number"),
        (trial(1100, correct="B"), "it takes a or b"),
    ],
)
def test_a_wrong_trial_is_an_exception_and_no_answer_is_lost(tmp_path, wrong, why):
    with pytest.raises(ValueError, match=why):
        experiment([trial(1200), wrong], tmp_path).run()
    assert len(rows(tmp_path)) == 1
    assert len(experiment([trial(1200), trial(1300)], tmp_path).run()) == 2


def test_other_trials_than_those_answered_are_refused(tmp_path):
    experiment([trial(1200), trial(1300)], tmp_path).run()
    for others in ([trial(1200), trial(1400)], [trial(1200)], [trial(1200), trial(1300, kind="practice")]):
        with pytest.raises(ValueError, match="trial 2 was answered"):
            experiment(others, tmp_path).run()
    with pytest.raises(hw.ExperimentError, match="answers of participant 'P1'"):
        experiment([trial(1200)], tmp_path, participant="P2").run()
    assert len(rows(tmp_path)) == 2


def test_an_exception_of_ones_own_ends_the_program(tmp_path):
    def trials():
        yield trial(1200)
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        experiment(trials(), tmp_path).run()
    assert len(rows(tmp_path)) == 1


def test_it_runs_once(tmp_path):
    once = experiment([trial(1200)], tmp_path)
    once.run()
    with pytest.raises(RuntimeError, match="runs once"):
        once.run()


def test_without_a_program_it_says_so(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(FileNotFoundError, match="program="):
        experiment([], tmp_path, program=None)


# ------------------------------------------------------------------------------------ the examples


def example(name, monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))
    sys.modules.pop(name, None)
    return importlib.import_module(name)


def test_the_staircase_ends_at_its_threshold(tmp_path, monkeypatch):
    staircase = example("staircase", monkeypatch).Staircase(trials=200)
    experiment(staircase, tmp_path, hw.observer(KEY, jnd=0.1, seed=5)).run()
    # sqrt(1/2) is told where the normal distribution has 0.5449 standard deviations.
    expected = math.expm1(0.5449 / 0.6745 * math.log(1.1))
    assert len(staircase.reversals) > 30
    assert staircase.threshold() == pytest.approx(expected, rel=0.25)


def test_questplus_finds_the_jnd(tmp_path, monkeypatch):
    if importlib.util.find_spec("questplus") is None:
        pytest.skip("questplus is not installed")
    found = {}
    trials = example("questplus_jnd", monkeypatch).trials(80, found)
    experiment(trials, tmp_path, hw.observer(KEY, jnd=0.1, seed=2)).run()
    assert found["jnd"] == pytest.approx(0.1, rel=0.4)
    assert found["bias"] == pytest.approx(0.0, abs=0.06)


# ------------------------------------------------------------------------------------ kills

RUN = """
import os, sys, time
sys.path.insert(0, sys.argv[1])
import hapticwall as hw
import staircase
steps = staircase.Staircase(trials=int(sys.argv[3]))
last = int(sys.argv[4])
told = open("told", "a")

class Telling:
    next = staticmethod(steps.next)
    def answer(self, answer):
        steps.answer(answer)
        told.write(f"{answer['trial']}\\n")
        told.flush()
        while answer["trial"] == last and not os.path.exists("killed"):
            time.sleep(0.001)

hw.Experiment(Telling(), participant="P1", answers="answers.csv", program=sys.argv[2],
              observer=hw.observer("wall.stiffness_n_per_m", jnd=0.1, seed=11)).run()
print(steps.difference, steps.right, steps.reversals)
"""


def start(folder, trials, last=0):
    """The experiment; it waits after the answer to the trial `last`, until the kill."""
    command = [sys.executable, "-c", RUN, str(EXAMPLES), PROGRAM, str(trials), str(last)]
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def stored(folder):
    """Numbers of the trials whose lines are whole."""
    path = folder / "answers.csv"
    lines = path.read_bytes().split(b"\n")[1:-1] if path.exists() else []
    return [int(line.split(b",")[3]) for line in lines]


def child_of(process):
    """The process of the program, or None before it has started."""
    try:
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    except OSError:
        children = []
    return int(children[0]) if children else None


def kill_one(process, victim, folder, answers, delay_s):
    """Kills after so many further answers; the other side must end by itself."""
    before = len(stored(folder))
    while child_of(process) is None or len(stored(folder)) < before + answers:
        assert process.poll() is None, process.communicate()
        time.sleep(0.0005)
    time.sleep(delay_s)
    program = child_of(process)
    os.kill(process.pid if victim == "python" else program, signal.SIGKILL)
    (folder / "killed").touch()
    process.communicate(timeout=60)
    while pathlib.Path(f"/proc/{program}").exists():
        time.sleep(0.001)
    (folder / "killed").unlink()
    assert process.returncode != 0


@pytest.mark.parametrize("victim", ["program", "python"])
def test_a_kill_loses_no_answer_and_repeats_none(tmp_path, victim):
    trials = 10 * KILLS
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    whole.mkdir()
    killed.mkdir()
    undisturbed, errors = start(whole, trials).communicate(timeout=300)
    assert errors == ""
    chance = random.Random(victim)
    for _ in range(KILLS):
        process = start(killed, trials, len(stored(killed)) + 9)
        kill_one(process, victim, killed, chance.randrange(0, 9), chance.random() * 0.05)
        numbers = stored(killed)
        assert numbers == list(range(1, len(numbers) + 1)), "none lost, none twice"
        told = {int(line) for line in (killed / "told").read_text().split()} if (killed / "told").exists() else set()
        assert told <= set(numbers), "an answer that was told is stored"
    final, errors = start(killed, trials).communicate(timeout=300)
    assert errors == ""
    assert final == undisturbed, "the staircase is that of an uninterrupted run"
    drop = {"time_utc"}
    kept = [{name: text for name, text in row.items() if name not in drop} for row in rows(killed)]
    assert kept == [{name: text for name, text in row.items() if name not in drop} for row in rows(whole)]
    assert len(kept) == trials
