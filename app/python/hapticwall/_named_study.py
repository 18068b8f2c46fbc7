"""The studies of the command line, by name; and boundaries."""

from __future__ import annotations

import json
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

from hapticwall import _core
from hapticwall._executor import AxisText, boundary_by
from hapticwall._law import Algorithm, heard, index_of, indices_of, told
from hapticwall._path import Path
from hapticwall._scene import Scene, scene_of

# A row of the command's --json; None for what does not apply.
Row = dict[str, Any]


@dataclass(frozen=True)
class Axis:
    """`count` values of a key from `low` to `high`, in equal steps or in equal ratios."""

    key: str
    low: float
    high: float
    count: int
    logarithmic: bool = False


def studies() -> dict[str, dict[str, str]]:
    """The studies that study() knows: for each the help of its options."""
    return {name: {key: text for key, text, _ in options} for name, options in _core.studies()}


def _option_text(value: object) -> str:
    if isinstance(value, Sequence) and not isinstance(value, str):
        several: Sequence[object] = value
        return ",".join(str(one) for one in several)
    return str(value)


def study(
    name: str,
    scene: Scene | Path,
    algorithm: Algorithm | Path | None = None,
    *,
    threads: int = 0,
    **options: object,
) -> list[Row]:
    """The rows of a study, with the keys of its --json: "ranking" is `hapticwall compare --study`.

    Options are those of the command, with "_" for "-" in their names; a list is joined by commas.
    `threads`: max, 0 for all cores.
    """
    core = scene_of(scene)._core
    if algorithm is not None:
        core = core.under(index_of(algorithm))
    given = [(key.replace("_", "-"), _option_text(value)) for key, value in options.items()]
    with heard() as raised:
        found = json.loads(_core.study(core, name, given, threads))
    rows: list[Row] = found["rows"]
    return told(raised, rows)


def accuracy(
    scene: Scene | Path, algorithm: Algorithm | Path | None = None, *, threads: int = 0, **options: object
) -> list[Row]:
    """Speed and error of every integrator and substep count on a scene: `hapticwall accuracy`."""
    return study("accuracy", scene, algorithm, threads=threads, **options)


def boundary(
    scene: Scene | Path,
    along: Axis,
    *,
    x: Axis | None = None,
    algorithms: Sequence[Algorithm | Path] | None = None,
    tolerance: float = 1e-3,
    threads: int | None = None,
    executor: Executor | None = None,
) -> list[Row]:
    """First and last value of a key that settle and that fail: the rows of `hapticwall map --boundary`.

    The values of `along` are scanned, then each change of verdict is bisected to the relative
    `tolerance`. With `x`, for each of its values. All built-in algorithms by default. `threads`: max,
    0 for all cores. None is all cores, and one core in a task of an `executor`, which takes one
    algorithm a task.
    """
    scene, indices = scene_of(scene), indices_of(algorithms)
    axes = _text(along), None if x is None else _text(x)
    text = _core.BoundaryText(*axes, indices, tolerance)
    if executor is not None:
        _core.check_boundary(scene._core, text)
        return boundary_by(executor, scene, axes, indices, tolerance, 1 if threads is None else threads)
    with heard() as raised:
        found = _core.boundary(scene._core, text, threads or 0)
    rows: list[Row] = json.loads(found)
    return told(raised, rows)


def _text(axis: Axis) -> AxisText:
    return axis.key, axis.low, axis.high, axis.count, axis.logarithmic
