"""A script of a user, for mypy --strict."""

import pathlib
from collections.abc import Generator
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import numpy as np

import hapticwall as hw

scene: hw.Scene = hw.load("tap")
scene["hand.mass_kg"] = 0.3
run: hw.Run = hw.run(scene.replace({"hand.path": [[0.0, 0.03], [1.0, 0.06]]}), algorithm="energy-bounding")
peak: float = run.samples["force_n"].max()
verdict: str = run.summary["verdict"]
grid = hw.map(scene, x=("wall.stiffness_n_per_m", np.geomspace(300, 1e5, 3)), y=("device.mass_kg", [0.1]))
share: float = float(grid.settled.mean())
mine: hw.Algorithm = hw.algorithm(lambda state, tick: 0.0, name="mine")
names: list[str] = [row["algorithm"] for row in hw.compare(scene, ["none", mine])]
with hw.Session(scene, mine) as session:
    sample: hw.Sample = session.step(hand_force_n=0.5)
    session.set("wall.stiffness_n_per_m", 1e3)
    depth: float = sample.penetration_m + session.position_m
    ended: bool = session.diverged or session.summary["verdict"] == "diverged"
copied: hw.Scene = hw.Scene.from_text(str(scene))
same: bool = copied == scene
key: hw.Key = scene.describe("hand.mass_kg")
bounds: list[tuple[str, float, float, str]] = [(one.key, one.minimum, one.maximum, one.unit) for one in hw.keys()]
described: dict[str, str] = hw.scenes()
version: str = hw.__version__
with ProcessPoolExecutor(2) as executor:
    try:
        rows: list[dict[str, Any]] = hw.batch(
            [scene, copied], executor=executor, rows_per_task=1, on_rows=lambda first, rows: print(first, len(rows))
        )
    except hw.Unfinished as error:
        missing: list[Any] = error.missing
    part: hw.Map = hw.map(
        scene,
        x=("wall.stiffness_n_per_m", [300.0]),
        y=("device.mass_kg", [0.1]),
        executor=executor,
        on_rows=lambda part: print(part.verdict),
    )
table = part.to_xarray()
compared = hw.compare(scene, threads=1)
limits = hw.boundary(scene, hw.Axis("wall.stiffness_n_per_m", 300.0, 1e5, 7, True), algorithms=["none"], threads=2)
first: float | None = limits[0]["first_failure"]
options: list[str] = [option for study in hw.studies().values() for option in study]
errors: list[dict[str, Any]] = hw.accuracy(scene, substeps=[1, 10]) + hw.study("ranking", scene, algorithms=["none"])


def staircase() -> Generator[hw.Trial, hw.Answer, None]:
    answer = yield {"a": {"wall.stiffness_n_per_m": 1000}, "b": "wall.stiffness_n_per_m=1200", "correct": "b"}
    print(answer["correct"])


experiment = hw.Experiment(staircase(), participant="P01", answers=pathlib.Path("a.csv"), program="hapticwall",
                           observer=hw.observer("wall.stiffness_n_per_m", jnd=0.1))
found: list[hw.Answer] = experiment.answers
listed = hw.Experiment([{"a": "", "b": "algorithm=none"}], participant="P01", answers="a.csv", program="hapticwall",
                       observer=lambda felt: felt.first)
