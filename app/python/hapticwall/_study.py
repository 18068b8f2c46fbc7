"""Maps, a scene over a grid of two of its numbers; and the search for a hand that takes energy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from hapticwall import _core
from hapticwall._law import Algorithm, algorithms as all_algorithms, heard, index_of, indices_of, told
from hapticwall._path import Path
from hapticwall._scene import Scene, scene_of

# In the order of the module's index, from good to bad.
_VERDICTS = np.array(["settled", "moving", "no contact", "active", "buzzing", "oscillating", "diverged"])

Values = Sequence[float] | npt.NDArray[np.float64]


@dataclass(frozen=True)
class Map:
    """A map. Its arrays have the axes algorithm, y, x."""

    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    algorithms: list[str]
    columns: dict[str, npt.NDArray[np.float64]]

    def __getitem__(self, key: str) -> npt.NDArray[np.float64]:
        """A number of the summary for every cell, such as "tail_peak_to_peak_m"; NaN for none."""
        return self.columns[key].reshape(len(self.algorithms), self.y.size, self.x.size)

    @property
    def verdict(self) -> npt.NDArray[np.str_]:
        """ "settled", "moving", "no contact", "active", "buzzing", "oscillating" or "diverged"."""
        names: npt.NDArray[np.str_] = _VERDICTS[self["verdict"].astype(int)]
        return names

    @property
    def settled(self) -> npt.NDArray[np.bool_]:
        return np.equal(self["verdict"], 0.0)


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
) -> Map:
    """Runs axis x of a scene for every x, y and algorithm, on all cores. All built-in algorithms by default.

    A key is a number of axis x, of the loop or of an algorithm, or "hand.path_speed_m_per_s".
    """
    xs, ys = _values(*x), _values(*y)
    indices = indices_of(algorithms)
    with heard() as raised:
        columns = _core.map(scene_of(scene)._core, (x[0], xs), (y[0], ys), indices)
    names = all_algorithms()
    return told(raised, Map(xs, ys, [names[index] for index in indices], columns))


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
    threads: int = 0,
) -> WorstHand:
    """Searches for a hand that takes energy out of axis x, as `hapticwall worst-hand`.

    `bounds` are "wide" or "narrow", `motion` is "let-go" or "ramp"; docs/worst-hand.md defines them. The
    result is the same for any number of threads; 0 means all cores.
    """
    core = scene_of(scene)._core
    if algorithm is not None:
        core = core.under(index_of(algorithm))
    with heard() as raised:
        row = _core.worst_hand(core, hands, seed, bounds, motion, threads)
    if "scene" in row:
        row["scene"] = Scene(row["scene"])
    return told(raised, WorstHand(**row))
