"""The schemas in assets/schemas against files and outputs of the program, and against its refusals."""

import copy
import csv
import json
import os
import pathlib
import subprocess
import tomllib

import jsonschema
import pytest
import referencing

import hapticwall as hw

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMAS = {
    path.name.removesuffix(".schema.json"): json.loads(path.read_text(encoding="utf-8"))
    for path in (ROOT / "assets/schemas").glob("*.schema.json")
}
REGISTRY = referencing.Registry().with_resources(
    (f"{name}.schema.json", referencing.Resource.from_contents(schema)) for name, schema in SCHEMAS.items()
)
SCENES = sorted((ROOT / "assets/scenes").glob("*.toml"))
KEPT = ROOT / "tests/compatibility/0.1.0"
KEPT_SCENES = ["corner", "every-key", "map", "press-signals", "realtime", "then"]


def fits(name, instance):
    return jsonschema.Draft202012Validator(SCHEMAS[name], registry=REGISTRY).is_valid(instance)


def check(name, instance):
    jsonschema.Draft202012Validator(SCHEMAS[name], registry=REGISTRY).validate(instance)


def program(*arguments):
    done = subprocess.run([os.environ["HAPTICWALL"], *map(str, arguments)], capture_output=True, text=True, check=False)
    return done.stdout, done.stderr


def printed(*arguments):
    out, error = program(*arguments, "--json", "-")
    assert out, error
    return json.loads(out)


@pytest.mark.parametrize("name", SCHEMAS)
def test_a_schema_is_a_schema(name):
    jsonschema.Draft202012Validator.check_schema(SCHEMAS[name])


# ------------------------------------------------------------------------------------ what is right


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_scenes_sidecars_and_summaries_fit(path, tmp_path):
    check("scene", tomllib.loads(path.read_text(encoding="utf-8")))
    check("summary", printed("run", path, "--duration", 0.2, "--csv", tmp_path / "a.csv"))
    check("scene", tomllib.loads((tmp_path / "a.toml").read_text(encoding="utf-8")))


@pytest.mark.parametrize("name", KEPT_SCENES)
def test_scenes_of_earlier_versions_fit(name):
    check("scene", tomllib.loads((KEPT / f"{name}.toml").read_text(encoding="utf-8")))


@pytest.mark.parametrize("scene", ["press", "golden-soft"])
def test_a_comparison_fits(scene):
    rows = printed("compare", scene, "--duration", 1.5)
    assert len(rows) >= 8
    check("comparison", rows)


def test_summaries_of_unusual_runs_fit():
    far = hw.load("press").replace({"wall.position_m": 0.9, "duration_s": 0.3})
    diverged = hw.run(hw.load("golden-hard").replace({"wall.stiffness_n_per_m": 1e9}), "none")
    for run in (hw.run(far), diverged, hw.run("corner")):
        check("summary", run.summary)
    assert hw.run(far).summary["max_penetration_m"] is None
    session = printed("run", "press", "--realtime", "--duration", 0.05)
    assert "missed_ticks" in session
    check("summary", session)


def test_the_summary_of_a_recording_fits(tmp_path):
    hw.run(hw.load("press").replace({"duration_s": 0.3})).save(tmp_path / "a.csv")
    check("summary", printed("replay", tmp_path / "a.csv"))
    check("summary", printed("replay", tmp_path / "a.csv", "--algorithm", "none"))


def test_maps_and_boundaries_fit():
    walls = "wall.stiffness_n_per_m=1e3:1e5:3:log"
    few = ("--algorithms", "none,force-bounding", "--duration", 0.5)
    check("map", printed("map", "press", "--x", walls, "--y", "wall.damping_n_s_per_m=0:20:3", *few))
    check("boundary", printed("map", "press", "--boundary", walls, *few))
    damping = ("--x", "device.damping_n_s_per_m=0.5:2:2")
    check("boundary", printed("map", "press", "--boundary", walls, *damping, *few))


def rows_of(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_trials_and_answers_fit():
    check("trials", rows_of(ROOT / "assets/examples/experiments/stiffer.csv"))
    check("trials", rows_of(KEPT / "list.csv"))
    check("answers", rows_of(KEPT / "answers-P01-1.csv"))


# ------------------------------------------------------------------------------------ what is wrong


def changed(instance, path, value):
    """A copy with this value at the path, or without it for ..."""
    instance = copy.deepcopy(instance)
    *way, last = path
    place = instance
    for step in way:
        place = place[step]
    if value is ...:
        del place[last]
    else:
        place[last] = value
    return instance


WRONG = {
    "summary": [
        (("verdict",), "good"), (("verdict",), ...), (("ticks",), 1.5), (("ticks",), -1), (("surprise",), 1),
        (("given_j",), None), (("energy_budget_j",), 1.0), (("y_verdict",), "settled"), (("missed_ticks",), 0),
    ],
    "comparison": [((0, "scene"), ...), ((0,), 3), ((0, "contacts"), "1")],
    "map": [(("x",), ...), (("x", "count"), 0), (("algorithms", 0, "settled"), ...), (("algorithms", 0, "calm"), 1)],
    "boundary": [(("tolerance",), 0), (("boundaries", 0, "changes"), ...), (("boundaries", 0, "surprise"), 1.0)],
    "trials": [((0, "a"), ...), ((0, "kind"), "tests"), ((0, "correct"), "B"), ((0, "trial"), "0"), ((1, "a"), "x=1"),
               ((0, "seed"), "1"), ((0, "a.step"), "1"), ((0, ""), "1")],
    "answers": [((0, "seed"), ...), ((0, "chosen"), "a"), ((0, "time_utc"), "today"), ((0, "scene_sha256"), "0")],
}  # fmt: skip


@pytest.fixture(scope="module")
def right():
    walls, few = "wall.stiffness_n_per_m=1e3:1e5:2", ("--algorithms", "none", "--duration", 0.2)
    return {
        "summary": printed("run", "press", "--duration", 0.2),
        "comparison": printed("compare", "press", "--duration", 0.2),
        "map": printed("map", "press", "--x", walls, "--y", "wall.damping_n_s_per_m=0:1:2", *few),
        "boundary": printed("map", "press", "--boundary", walls, *few),
        "trials": rows_of(KEPT / "list.csv"),
        "answers": rows_of(KEPT / "answers-P01-1.csv"),
    }


@pytest.mark.parametrize(("name", "path", "value"), [(name, *wrong) for name, all_of in WRONG.items() for wrong in all_of])
def test_what_is_wrong_does_not_fit(right, name, path, value):
    assert fits(name, right[name])
    assert not fits(name, changed(right[name], path, value))


# ------------------------------------------------------------- scenes: the program must refuse the same

DEVICE = {"mass_kg": 0.05, "damping_n_s_per_m": 1.0}
HAND = {"mass_kg": 0.1, "grip_stiffness_n_per_m": 100.0, "path": [[0.0, 0.03]]}
PLAIN = {
    "device": {**DEVICE, "y": DEVICE},
    "hand": {**HAND, "y": HAND},
    "wall": [{"position_m": 0.05, "stiffness_n_per_m": 1000.0}],
    "sampling": {}, "environment": {}, "algorithm": {}, "estimator": {}, "simulator": {},
}  # fmt: skip
TABLES = {
    (): (), ("sampling",): ("sampling",), ("device",): ("$defs", "device"), ("device", "y"): ("$defs", "device"),
    ("hand",): ("$defs", "hand"), ("hand", "y"): ("$defs", "hand"), ("wall", 0): ("$defs", "wall"),
    ("environment",): ("environment",), ("algorithm",): ("algorithm",), ("estimator",): ("estimator",),
    ("simulator",): ("simulator",),
}  # fmt: skip


def keys_of(table):
    """The properties that the schema gives to a table of a scene."""
    place = SCHEMAS["scene"]
    way = TABLES[table]
    for step in way if way[:1] == ("$defs",) else ("properties", *way) if way else ():
        place = place[step]
    return place["properties"]


def toml(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml(one)}" for key, one in value.items()) + "}"
    return json.dumps(value) if not isinstance(value, list) else "[" + ", ".join(map(toml, value)) + "]"


@pytest.fixture
def refusal(tmp_path):
    """What the program says of a scene, or ""."""

    def of(scene):
        lines = [f"{key} = {toml(value)}\n" for key, value in scene.items()]
        (tmp_path / "scene.toml").write_text("".join(lines), encoding="utf-8")
        try:
            hw.load(tmp_path / "scene.toml")
        except ValueError as error:
            return str(error)
        return ""

    return of


NUMBERS = [
    (table, key, schema)
    for table in TABLES
    for key, schema in keys_of(table).items()
    if schema.get("type") in ("number", "integer")
]


def test_the_plain_scene_fits_both(refusal):
    assert len(NUMBERS) > 60
    named = changed(PLAIN, ("hand", "file"), "fu-cavusoglu-x")
    for scene in (PLAIN, named):
        check("scene", scene)
        assert refusal(scene) == ""


@pytest.mark.parametrize(("table", "key", "schema"), NUMBERS, ids=lambda part: str(part)[:40])
def test_a_number_has_the_range_of_the_program(refusal, table, key, schema):
    low, high = schema.get("minimum", schema.get("exclusiveMinimum")), schema["maximum"]
    outside = [low - 1, high + max(1, high // 1000)]
    if "exclusiveMinimum" in schema:
        outside.append(low)
    for value in outside:
        scene = changed(PLAIN, (*table, key), value)
        assert "out of range" in refusal(scene)
        assert not fits("scene", scene)
    for value in [high] if "exclusiveMinimum" in schema else [low, high]:
        scene = changed(PLAIN, (*table, key), value)
        assert "out of range" not in refusal(scene)
        assert fits("scene", scene)
    for value in ["1", True, [1]] + [low + 0.5] * (schema["type"] == "integer"):
        scene = changed(PLAIN, (*table, key), value)
        assert refusal(scene) and not fits("scene", scene)


@pytest.mark.parametrize("table", TABLES, ids=str)
def test_a_table_has_the_keys_of_the_program(tmp_path, table):
    scene = changed(PLAIN, (*table, "qqqqqqqq"), 1)
    assert not fits("scene", scene)
    (tmp_path / "scene.toml").write_text("".join(f"{key} = {toml(value)}\n" for key, value in scene.items()))
    _, error = program("run", tmp_path / "scene.toml")
    known = set(error.strip().split("known here: ")[1].split(", ")) - {"y"}
    assert known == set(keys_of(table))


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("device", "mass_kg"), ...), (("device", "y", "damping_n_s_per_m"), ...), (("wall", 0, "position_m"), ...),
        (("wall", 0, "axis"), "z"), (("wall",), {}), (("device",), 3), (("device",), ...), (("algorithm", "then"), "none2"),
        (("algorithm", "observer"), "other"), (("algorithm", "damping_credit"), 1), (("estimator", "name"), "other"),
        (("environment", "name"), "detents"), (("algorithm", "form"), "other"),
        (("simulator", "integrator"), "other"), (("hand", "path"), "mousse"), (("hand", "path"), [[0.0]]),
        (("hand", "path"), []), (("hand", "path"), ...), (("hand", "path_file"), "a.csv"), (("name",), 3), (("name",), "a" * 101), (("name",), "a\nb"), (("description",), "a" * 3001),
    ],
)  # fmt: skip
def test_both_refuse_what_is_wrong(refusal, path, value):
    scene = changed(PLAIN, path, value)
    assert refusal(scene)
    assert not fits("scene", scene)


def test_a_hand_may_be_that_of_the_second_axis_alone(refusal):
    scene = changed(PLAIN, ("hand",), {"y": HAND})
    assert refusal(scene) == ""
    check("scene", scene)


def test_a_plug_ins_keys_fit_and_those_of_a_built_in_algorithm_are_checked():
    assert fits("scene", changed(PLAIN, ("algorithm",), {"name": "mine", "gain": 1.0}))
    assert not fits("scene", changed(PLAIN, ("algorithm",), {"name": "none", "gain": 1.0}))
