"""Runs, recordings, and many runs at once."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from hapticwall import _core
from hapticwall._executor import batch_by
from hapticwall._law import Algorithm, heard, index_of, indices_of, told
from hapticwall._path import Path, file_text, path_text
from hapticwall._scene import Scene, Value, scene_of, setting

# The keys of `hapticwall run --json`; None for what does not apply.
Summary: TypeAlias = dict[str, Any]


def _rows(layout: _core.RowLayout, data: npt.NDArray[np.uint8]) -> npt.NDArray[np.void]:
    return data.view(
        np.dtype(
            {
                "names": layout.names,
                "formats": layout.formats,
                "offsets": layout.offsets,
                "itemsize": layout.row_bytes,
            }
        )
    )


class Run:
    """A finished run."""

    def __init__(self, core: _core.Run) -> None:
        self._core = core

    @cached_property
    def summary(self) -> Summary:
        """The keys of `hapticwall run --json`; None for what does not apply."""
        return self._core.summary()

    @property
    def samples(self) -> npt.NDArray[np.void]:
        """Every tick, with the columns of the CSV as fields. Read-only; no copy."""
        return _rows(self._core.layout(), self._core.row_data())

    @property
    def scene(self) -> Scene:
        """The scene that ran."""
        return Scene(self._core.scene)

    @property
    def first_different_tick(self) -> int | None:
        """Of a rerun(): the first tick that differs from the recording; None if all are equal."""
        return self._core.first_different_tick

    def save(self, path: Path) -> None:
        """Writes NAME.csv and its sidecar NAME.toml, as `hapticwall run --csv` does."""
        self._core.save(path_text(path))


class Recording:
    """A recording that read() has opened. `notes` are warnings for people."""

    def __init__(self, core: _core.Recording) -> None:
        self._core = core
        self.notes: list[str] = core.notes

    @property
    def samples(self) -> npt.NDArray[np.void]:
        """Every row, with the columns of the CSV as fields. Read-only."""
        return _rows(self._core.layout(), self._core.row_data())

    @property
    def scene(self) -> Scene:
        """The recorded scene, in which the hand moves as it was recorded: for compare(), map(), batch()."""
        return Scene(self._core.scene())


def run(scene: Scene | Path, algorithm: Algorithm | Path | None = None) -> Run:
    """Runs a scene on the simulator. LawError if a law of one's own raised an exception."""
    core = scene_of(scene)._core
    if core.not_repeatable_because:
        warnings.warn(f"differs from the recorded session: {core.not_repeatable_because}", stacklevel=2)
    if algorithm is not None:
        core = core.under(index_of(algorithm))
    with heard() as raised:
        result = Run(_core.run(core))
    return told(raised, result)


def batch(
    scenes: Iterable[Scene],
    *,
    threads: int | None = None,
    executor: Executor | None = None,
    rows_per_task: int = 8,
    on_rows: Callable[[int, list[Summary]], object] | None = None,
) -> list[Summary]:
    """Runs many scenes; their summaries, in order. The same bits for any number of threads and workers.

    `threads`: max, 0 for all cores. None is all cores, and one core in a task of an executor.
    `executor` takes `rows_per_task` scenes a task, and `on_rows(first, summaries)` is called for each
    task that has ended. Unfinished, with what was done, if a task fails or its worker is lost.
    """
    if executor is not None:
        return batch_by(executor, list(scenes), rows_per_task, 1 if threads is None else threads, on_rows)
    cores = [scene._core for scene in scenes]
    with heard() as raised:
        summaries = _core.batch(cores, threads or 0)
    if on_rows is not None:
        on_rows(0, summaries)
    return told(raised, summaries)


def compare(
    scene: Scene | Path, algorithms: Sequence[Algorithm | Path] | None = None, *, threads: int = 0
) -> list[Summary]:
    """Summaries of a scene under these algorithms, or all built-in ones: the rows of `hapticwall compare`.

    `threads`: max, 0 for all cores.
    """
    core, indices = scene_of(scene)._core, indices_of(algorithms)
    with heard() as raised:
        summaries = _core.compare(core, indices, threads)
    return told(raised, summaries)


def read(path: Path) -> Recording:
    """Opens NAME.csv with its sidecar NAME.toml, and checks every row.

    ValueError says what is wrong with it, OSError that it cannot be read.
    """
    return Recording(_core.Recording(file_text(path)))


def rerun(
    recording: Recording,
    algorithm: Algorithm | Path | None = None,
    values: Mapping[str, Value] | None = None,
) -> Run:
    """Runs the recorded hand again, under another algorithm or with other values of the scene."""
    name = "" if algorithm is None else _core.algorithm_names()[index_of(algorithm)]
    settings = [f"{key}={setting(value)}" for key, value in (values or {}).items()]
    with heard() as raised:
        result = Run(recording._core.rerun(name, settings))
    return told(raised, result)
