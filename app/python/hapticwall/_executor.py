"""Many runs as tasks of an executor: of processes, of a cluster, of MPI."""

from __future__ import annotations

import json
import pickle
import re
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import CancelledError, Executor, Future, as_completed
from contextlib import closing
from typing import Any, Generic, TypeVar

import numpy as np
import numpy.typing as npt

from hapticwall import _core
from hapticwall._law import LawError, heard
from hapticwall._scene import Scene
from hapticwall._travel import arrived, traveller_of

_Result = TypeVar("_Result")
_Rows = TypeVar("_Rows")
Numbers = npt.NDArray[np.float64]
Columns = dict[str, Numbers]


class Unfinished(RuntimeError):
    """Tasks of an executor failed, or their worker was lost; the cause is the first failure.

    `result` is that of the call, with None or NaN in the rows of `missing`: places in the list of
    scenes of a batch, (algorithm, y) of a map.
    """

    def __init__(self, result: Any, missing: Sequence[Any], cause: BaseException) -> None:
        text = str(cause).partition("\n")[0]
        super().__init__(f"{len(missing)} rows are missing, {type(cause).__name__}: {text}")
        self.result: Any = result
        self.missing: list[Any] = list(missing)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.result, self.missing, self.__cause__ or RuntimeError(str(self)))


class Outcome(Generic[_Rows]):
    """The rows of a task, and the exception of a law in it."""

    def __init__(self, rows: _Rows, raised: BaseException | None) -> None:
        self.rows = rows
        self.raised = raised


def _sent(value: object) -> bytes:
    return pickle.dumps((_core.version, _core.build, value))


def _received(sent: bytes) -> Any:
    """In a worker. RuntimeError for the task of another version, which may have other numbers."""
    version, build, value = pickle.loads(sent)
    if (version, build) != (_core.version, _core.build):
        raise RuntimeError(
            f"the worker has hapticwall {_core.version} ({_core.build}), the caller {version} ({build}); install one"
        )
    return value


def _portable(error: BaseException) -> BaseException:
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        return RuntimeError(repr(error))
    return error


def _outcome(work: Callable[[], _Rows]) -> Outcome[_Rows]:
    with heard() as raised:
        rows = work()
    return Outcome(rows, _portable(raised[0]) if raised else None)


def batch_task(sent: bytes, first: int, threads: int) -> Outcome[list[dict[str, Any]]]:
    """Runs in a worker. Scenes arrive as bytes: an error in them is this task's, and ends no worker."""
    scenes: list[Scene] = _received(sent)
    try:
        return _outcome(lambda: _core.batch([scene._core for scene in scenes], threads))
    except RuntimeError as error:  # "scene 3: ..." counts from the task's first
        text = re.sub(r"^scene (\d+)", lambda found: f"scene {first + int(found[1])}", str(error))
        raise RuntimeError(text) from None


def map_task(sent: bytes, law: bytes, x: tuple[str, Numbers], y: tuple[str, Numbers], threads: int) -> Outcome[Columns]:
    """Runs in a worker: all x of these y, under one algorithm."""
    scene: Scene = _received(sent)
    indices = arrived([pickle.loads(law)])
    return _outcome(lambda: _core.map(scene._core, x, y, indices, threads))


AxisText = tuple[str, float, float, int, bool]


def boundary_task(
    sent: bytes, law: bytes, along: AxisText, x: AxisText | None, tolerance: float, threads: int
) -> Outcome[str]:
    """Runs in a worker: the boundaries of one algorithm, as JSON."""
    scene: Scene = _received(sent)
    text = _core.BoundaryText(along, x, arrived([pickle.loads(law)]), tolerance)
    return _outcome(lambda: _core.boundary(scene._core, text, threads))


def hands_task(sent: bytes, bounds: str, motion: str, hands: bytes, threads: int) -> Outcome[bytes]:
    """Runs in a worker: hands of a search, and their results, as numbers of C."""
    scene: Scene = _received(sent)
    return _outcome(lambda: _core.run_hands(scene._core, bounds, motion, hands, threads))


Task = tuple[Any, ...]  # a function and its arguments


class _Tasks(Generic[_Rows]):
    """Tasks in an executor."""

    def __init__(self, executor: Executor, tasks: Sequence[Task]) -> None:
        self.executor, self.tasks = executor, tasks
        self.failure: BaseException | None = None  # the first one
        self.raised: BaseException | None = None  # by a law
        self.lost: list[int] = []

    def _submit(self) -> dict[Future[Any], int]:
        futures: dict[Future[Any], int] = {}
        for number, task in enumerate(self.tasks):
            try:
                futures[self.executor.submit(*task)] = number
            except RuntimeError as error:  # broken, or shut down
                self._fail(number, error)
        return futures

    def _fail(self, number: int, error: BaseException) -> None:
        self.failure = self.failure or error
        self.lost.append(number)

    def done(self) -> Generator[tuple[int, _Rows], None, None]:
        """Number and rows of each task, as they end. Those that fail are in `lost`. close() cancels the rest."""
        futures = self._submit()
        try:
            for future in as_completed(futures):
                number = futures[future]
                try:
                    outcome: Outcome[_Rows] = future.result()
                except (Exception, CancelledError) as error:
                    self._fail(number, error)
                    continue
                self.raised = self.raised or outcome.raised
                yield number, outcome.rows
        finally:
            for future in futures:  # those of a call that ends early; a task that has ended stays as it is
                future.cancel()

    def result(self, result: _Result, missing: Callable[[int], Sequence[Any]]) -> _Result:
        """Raises Unfinished for lost tasks, LawError for an exception of a law."""
        if self.failure is not None:
            rows = [row for number in sorted(self.lost) for row in missing(number)]
            raise Unfinished(result, rows, self.failure) from self.failure
        if self.raised is not None:
            raise LawError(result) from self.raised
        return result


def _step(rows_per_task: int) -> int:
    if rows_per_task < 1:
        raise ValueError(f"rows_per_task: 1 or more, not {rows_per_task}")
    return rows_per_task


def batch_by(
    executor: Executor,
    scenes: Sequence[Scene],
    rows_per_task: int,
    threads: int,
    on_rows: Callable[[int, list[dict[str, Any]]], object] | None,
) -> list[Any]:
    step = _step(rows_per_task)
    starts = range(0, len(scenes), step)
    sent = [_sent(list(scenes[first : first + step])) for first in starts]
    tasks: _Tasks[list[dict[str, Any]]] = _Tasks(
        executor, [(batch_task, part, first, threads) for part, first in zip(sent, starts, strict=True)]
    )
    summaries: list[dict[str, Any] | None] = [None] * len(scenes)
    with closing(tasks.done()) as done:
        for number, rows in done:
            first = starts[number]
            summaries[first : first + len(rows)] = rows
            if on_rows is not None:
                on_rows(first, rows)
    return tasks.result(summaries, lambda number: range(len(scenes))[starts[number] : starts[number] + step])


class MapTasks:
    """A map as tasks. A row is all x of one y under one algorithm."""

    def __init__(self, scene: Scene, x: tuple[str, Numbers], y: tuple[str, Numbers], indices: list[int]) -> None:
        self.scene, self.x, self.y, self.indices = scene, x, y, indices
        _core.check_map(scene._core, x, y, indices)

    def run(
        self,
        executor: Executor,
        rows_per_task: int,
        threads: int,
        on_part: Callable[[int, slice, Columns], object],
        result: Callable[[Columns], _Result],
    ) -> _Result:
        step = _step(rows_per_task)
        sent, laws = _sent(self.scene), [pickle.dumps(traveller_of(index)) for index in self.indices]
        parts = [(a, slice(i, i + step)) for a in range(len(laws)) for i in range(0, self.y[1].size, step)]
        tasks: _Tasks[Columns] = _Tasks(
            executor, [(map_task, sent, laws[a], self.x, (self.y[0], self.y[1][ys]), threads) for a, ys in parts]
        )
        shape = (len(laws), self.y[1].size, self.x[1].size)
        columns = {key: np.full(shape, np.nan) for key in _core.map_columns()}
        with closing(tasks.done()) as done:
            for number, found in done:
                algorithm, ys = parts[number]
                for key, values in found.items():
                    columns[key][algorithm, ys] = values.reshape(-1, shape[2])
                on_part(algorithm, ys, found)
        whole = result({key: values.reshape(-1) for key, values in columns.items()})
        rows = range(shape[1])
        return tasks.result(whole, lambda number: [(parts[number][0], y) for y in rows[parts[number][1]]])


def boundary_by(
    executor: Executor,
    scene: Scene,
    axes: tuple[AxisText, AxisText | None],
    indices: Sequence[int],
    tolerance: float,
    threads: int,
) -> list[Any]:
    along, x = axes
    sent, laws = _sent(scene), [pickle.dumps(traveller_of(index)) for index in indices]
    tasks: _Tasks[str] = _Tasks(executor, [(boundary_task, sent, law, along, x, tolerance, threads) for law in laws])
    count = 1 if x is None else x[3]
    rows: list[Any] = [None] * (count * len(laws))
    with closing(tasks.done()) as done:
        for number, text in done:
            rows[number * count : (number + 1) * count] = json.loads(text)
    return tasks.result(rows, lambda number: range(number * count, (number + 1) * count))


class HandTasks:
    """Runs the hands of a search as tasks, population by population."""

    def __init__(
        self, executor: Executor, scene: Scene, bounds: str, motion: str, rows_per_task: int, threads: int
    ) -> None:
        self.executor, self.sent = executor, _sent(scene)
        self.bounds, self.motion, self.threads = bounds, motion, threads
        self.step = _step(rows_per_task) * _core.hand_bytes
        self.count = 0
        self.raised: BaseException | None = None  # by a law

    def __call__(self, hands: bytes) -> bytes:
        """Raises Unfinished, whose `missing` are numbers of hands from 0 on."""
        parts = [hands[at : at + self.step] for at in range(0, len(hands), self.step)]
        tasks: _Tasks[bytes] = _Tasks(
            self.executor, [(hands_task, self.sent, self.bounds, self.motion, part, self.threads) for part in parts]
        )
        results = [b""] * len(parts)
        with closing(tasks.done()) as done:
            for number, part in done:
                results[number] = part
        self.raised, tasks.raised = self.raised or tasks.raised, None
        first, step = self.count, self.step // _core.hand_bytes
        self.count += len(hands) // _core.hand_bytes
        rows = range(first, self.count)
        tasks.result(None, lambda number: rows[number * step : (number + 1) * step])
        return b"".join(results)
