"""Maps, a scene over a grid of two of its numbers; and the search for a hand that takes energy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from hapticwall import _core
from hapticwall._executor import Columns, HandTasks, MapTasks, Numbers
from hapticwall._law import Algorithm, algorithms as all_algorithms, heard, index_of, indices_of, told
from hapticwall._path import Path
from hapticwall._scene import Scene, scene_of
from hapticwall._xarray import Dataset, dataset, unit_of

# In the order of the module's index, from good to bad.
_VERDICTS = np.array(["settled", "moving", "no contact", "active", "buzzing", "oscillating", "diverged", ""])

Values = Sequence[float] | npt.NDArray[np.float64]


@dataclass(frozen=True)
class Map:
    """A map. Its arrays have the axes algorithm, y, x. The keys are those of x and y, with their units."""

    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    algorithms: list[str]
    columns: dict[str, npt.NDArray[np.float64]]
    x_key: str = "x"
    y_key: str = "y"
    x_unit: str = ""
    y_unit: str = ""

    def __getitem__(self, key: str) -> npt.NDArray[np.float64]:
        """A number of the summary for every cell, such as "tail_peak_to_peak_m"; NaN for none."""
        return self.columns[key].reshape(len(self.algorithms), self.y.size, self.x.size)

    @property
    def verdict(self) -> npt.NDArray[np.str_]:
        """ "settled", "moving", "no contact", "active", "buzzing", "oscillating" or "diverged"; "" for a missing cell."""
        missing = len(_VERDICTS) - 1
        names: npt.NDArray[np.str_] = _VERDICTS[np.nan_to_num(self["verdict"], nan=missing).astype(int)]
        return names

    @property
    def settled(self) -> npt.NDArray[np.bool_]:
        return np.equal(self["verdict"], 0.0)

    def to_xarray(self) -> Dataset:
        """An xarray.Dataset: dimensions "algorithm" and the two keys, `units` as attributes. It needs xarray."""
        return dataset(self)


def _values(key: str, values: Values) -> npt.NDArray[np.float64]:
    array = np.array(values, dtype=np.float64, ndmin=1)
    if array.ndim != 1:
        raise ValueError(f"{key}: a grid of {array.ndim} dimensions; give x and y one list of numbers each")
    return array


def map(  # noqa: A001
    scene: Scene | Path,
    *,
    x: tuple[str, Values],
    y: tuple[str, Values],
    algorithms: Sequence[Algorithm | Path] | None = None,
    threads: int | None = None,
    executor: Executor | None = None,
    rows_per_task: int = 8,
    on_rows: Callable[[Map], object] | None = None,
) -> Map:
    """Runs axis x of a scene for every x, y and algorithm. All built-in algorithms by default.

    A key is a number of axis x, of the loop or of an algorithm, or "hand.path_speed_m_per_s".
    `threads`: max, 0 for all cores. None is all cores, and one core in a task of an executor.
    `executor` takes `rows_per_task` rows a task: all x of so many y under one algorithm.
    `on_rows(part)` is called for each task that has ended, with its part of the map. Unfinished, with
    what was done, if a task fails or its worker is lost.
    """
    xs, ys = _values(*x), _values(*y)
    scene, indices, names = scene_of(scene), indices_of(algorithms), all_algorithms()
    chosen = [names[index] for index in indices]
    units = unit_of(scene, x[0]), unit_of(scene, y[0])

    def made(columns: Columns, ys: Numbers = ys, algorithms: list[str] = chosen) -> Map:
        return Map(xs, ys, algorithms, columns, x[0], y[0], *units)

    if executor is not None:
        return MapTasks(scene, (x[0], xs), (y[0], ys), indices).run(
            executor,
            rows_per_task,
            1 if threads is None else threads,
            lambda a, part, columns: on_rows and on_rows(made(columns, ys[part], chosen[a : a + 1])),
            made,
        )
    with heard() as raised:
        found = made(_core.map(scene._core, (x[0], xs), (y[0], ys), indices, threads or 0))
    if on_rows is not None:
        on_rows(found)
    return told(raised, found)


@dataclass(frozen=True)
class WorstHand:
    """A search for a hand that takes energy: a row of `hapticwall worst-hand --json`. Joules and watts.

    The fields of the hand are None or empty if no hand took energy. That proves nothing.
    """

    hands: int
    refused_hands: int
    first_hand: int | None
    most_j: float | None = None
    typical_j: float | None = None
    least_j: float | None = None
    taken_j: float | None = None
    taken_at_rest_j: float | None = None
    last_second_w: float | None = None
    numbers: dict[str, float] = field(default_factory=dict)
    at_bound: list[str] = field(default_factory=list)
    scene: Scene | None = None


def worst_hand(
    scene: Scene | Path,
    algorithm: Algorithm | Path | None = None,
    *,
    hands: int = 10_000,
    seed: int = 1,
    bounds: str = "wide",
    motion: str = "let-go",
    threads: int | None = None,
    executor: Executor | None = None,
    rows_per_task: int = 8,
) -> WorstHand:
    """Searches for a hand that takes energy out of axis x, as `hapticwall worst-hand`.

    `bounds` are "wide" or "narrow", `motion` is "let-go" or "ramp"; docs/worst-hand.md defines them.
    `threads`: max, 0 for all cores. None is all cores, and one core in a task of an `executor`, which
    takes `rows_per_task` hands a task. The result is the same for any of them. Unfinished, without a
    result, if a task fails or its worker is lost.
    """
    core = scene_of(scene)._core
    if algorithm is not None:
        core = core.under(index_of(algorithm))
    tasks = None
    if executor is not None:
        tasks = HandTasks(executor, Scene(core), bounds, motion, rows_per_task, 1 if threads is None else threads)
    with heard() as raised:
        row = _core.worst_hand(core, hands, seed, bounds, motion, threads or 0, tasks)
    if tasks is not None and tasks.raised is not None:
        raised = [tasks.raised]
    if "scene" in row:
        row["scene"] = Scene(row["scene"])
    return told(raised, WorstHand(**row))
