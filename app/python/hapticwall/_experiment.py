"""Experiments whose trials come from Python, one at a time, each from the answers so far."""

from __future__ import annotations

import json
import math
import random
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import IO, Any, Protocol, TypeAlias, runtime_checkable

from hapticwall._path import Path, path_text

Setting: TypeAlias = str | int | float | bool
Trial: TypeAlias = Mapping[str, Any]
Answer: TypeAlias = dict[str, Any]

_WHOLE = {"trial", "chosen_presentation", "looks", "seed", "touches", "lost_ticks", "first_tick", "last_tick"}
_NUMBERS = {"seconds", "contact_s", "mean_force_n", "max_force_n", "energy_to_hand_j"}
_PROTOCOL = 1


@runtime_checkable
class Adaptive(Protocol):
    """An object that gives trials: next() returns one, or None at the end; answer() hears each answer."""

    def next(self) -> Trial | None: ...
    def answer(self, answer: Answer) -> None: ...


@dataclass(frozen=True)
class Felt:
    """The two walls of a trial, as a simulated observer meets them."""

    number: int
    trial: dict[str, Any]  # as it was given
    first: str  # "a" or "b": the wall of the first presentation
    values: dict[str, float | str]  # of the columns a.KEY and b.KEY
    exposures: dict[str, dict[str, float]]  # of "a" and "b": contact_s, mean_force_n, max_force_n, ...


Observer: TypeAlias = Callable[[Felt], str]


class ExperimentError(RuntimeError):
    """The program has ended before the experiment. The answers so far are stored: the same script resumes."""


def observer(key: str, jnd: float, lapses: float = 0.0, seed: int = 1) -> Observer:
    """A simulated observer who chooses the wall with the larger value of `key`, for tests and planning.

    It chooses b with the chance Φ(0.6745·ln(b/a)/ln(1 + jnd)): three times in four a wall that is larger
    by the share `jnd`, 0.1 for 10 %. In the share `lapses` of the trials it guesses. A choice depends on
    `seed` and the number of the trial alone, so that a resumed experiment gets the same ones.
    """
    if not jnd > 0.0 or not 0.0 <= lapses <= 1.0:
        raise ValueError(f"jnd={jnd}, lapses={lapses}: jnd is above 0, lapses is 0 to 1")

    def choose(felt: Felt) -> str:
        a, b = (float(felt.values[f"{slot}.{key}"]) for slot in "ab")
        chance = random.Random(f"{seed}-{felt.number}")
        if chance.random() < lapses:
            return chance.choice("ab")
        noise = chance.gauss(0.0, math.log1p(jnd) / 0.6744897501960817)
        return "b" if math.log(b / a) + noise > 0.0 else "a"

    return choose


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)


def _fields(trial: Trial) -> dict[str, Any]:
    """A trial as the program takes it: a and b may be dictionaries of keys."""
    if not isinstance(trial, Mapping):
        raise TypeError(f"a trial is a dictionary of columns, not {trial!r}")
    fields = dict(trial)
    for slot in "ab":
        value = fields.get(slot, "")
        if isinstance(value, Mapping):
            fields[slot] = "; ".join(f"{key}={_text(one)}" for key, one in value.items())
    return {name: value.item() if hasattr(value, "item") else value for name, value in fields.items()}


def _value(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def _answer(row: dict[str, str]) -> Answer:
    answer: Answer = {}
    for name, text in row.items():
        if name == "correct":
            answer[name] = None if text == "" else text == "1"
        elif name in _WHOLE:
            answer[name] = int(text) if text else None
        elif name in _NUMBERS or name.startswith(("a.", "b.")):
            answer[name] = _value(text)
        else:
            answer[name] = text
    return answer


class _Source:
    """A list, a generator, an iterator or an Adaptive object, trial by trial."""

    def __init__(self, trials: Iterable[Trial] | Adaptive) -> None:
        self._adaptive = trials if isinstance(trials, Adaptive) else None
        self._trials: Iterator[Trial] = iter(()) if isinstance(trials, Adaptive) else iter(trials)
        self._begun = False

    def next(self, answer: Answer | None) -> dict[str, Any] | None:
        """The next trial after this answer; None at the end. A break has no answer."""
        trial: Trial | None
        if self._adaptive is not None:
            if answer is not None:
                self._adaptive.answer(answer)
            trial = self._adaptive.next()
        else:
            try:
                if isinstance(self._trials, Generator) and self._begun:
                    trial = self._trials.send(answer)
                else:
                    trial = next(self._trials)
            except StopIteration:
                trial = None
            self._begun = True
        return None if trial is None else _fields(trial)


def _is_break(trial: Trial) -> bool:
    return trial.get("kind") == "break"


def _check_same(trial: dict[str, Any] | None, answer: Answer) -> None:
    """A kept answer belongs to the trial that the source gives in its place."""
    for name in ("a", "b", "kind", "trial"):
        default = {"kind": "test", "trial": answer["trial"]}.get(name, "")
        given = "nothing" if trial is None else trial.get(name, default) or default
        if trial is None or str(given).strip() != str(answer[name]):
            raise ValueError(
                f"trial {answer['trial']} was answered with {name} = {answer[name]!r}, and now it would be {given!r}: "
                "the trials are not those of this file of answers"
            )


class _Program:
    """The program and its two pipes."""

    def __init__(self, command: Sequence[str]) -> None:
        self._errors: IO[bytes] = tempfile.TemporaryFile()
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors, text=True, encoding="utf-8"
        )

    def __enter__(self) -> _Program:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            self._process.terminate()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                try:
                    pipe.close()
                except BrokenPipeError:
                    pass
        self._process.wait()
        self._errors.close()

    def send(self, **message: Any) -> None:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(json.dumps(message) + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            pass  # messages() tells why it has ended

    def messages(self) -> Iterator[tuple[str, Any]]:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            if line.endswith("\n"):
                yield from json.loads(line).items()

    def end(self) -> str:
        """Waits for the program; why it has failed, or ""."""
        assert self._process.stdin is not None
        try:
            self._process.stdin.close()
        except BrokenPipeError:
            pass
        status = self._process.wait()
        self._errors.seek(0)
        lines = self._errors.read().decode("utf-8", "replace").strip().splitlines()
        return "" if status == 0 else f"{lines[-1] if lines else 'hapticwall ended'} (status {status})"


class Experiment:
    """A blind experiment whose trials come from Python (docs/experiments.md).

        def staircase():
            stiffness = 1500.0
            for _ in range(40):
                answer = yield {"a": {"wall.stiffness_n_per_m": 1000},
                                "b": {"wall.stiffness_n_per_m": stiffness}, "correct": "b"}
                stiffness *= 0.95 if answer["correct"] else 1.15

        hw.Experiment(staircase(), scene="press", participant="P01", answers="P01.csv").run()

    `trials` is a list of trials, a generator that receives each answer, or an object with next() and
    answer(). A trial is a dictionary with the columns of a trial list; `a` and `b` may be dictionaries
    of keys. Every further column is repeated in the answers; the first trial names all of them, and all
    keys.

    run() opens the window and returns when it is closed. With `observer` there is no window: the hand of
    the scene presses into both walls, and observer(felt) returns "a" or "b". `program` is the program's
    path, and `arguments` are its further options.
    """

    def __init__(
        self,
        trials: Iterable[Trial] | Adaptive,
        *,
        participant: str,
        answers: Path,
        scene: Path = "press",
        session: str | int = "1",
        observer: Observer | None = None,
        program: Path | None = None,
        arguments: Sequence[str] = (),
    ) -> None:
        found = path_text(program) if program is not None else shutil.which("hapticwall")
        if found is None:
            raise FileNotFoundError("hapticwall is not on the PATH: give its path as program=")
        options = ["--participant", participant, "--session", str(session), "--answers", path_text(answers)]
        self._command = [found, path_text(scene), "--trials", "-", *options, *arguments]
        if observer is not None:
            self._command.append("--rehearse")
        self._source = _Source(trials)
        self._observer = observer
        self._trial: dict[str, Any] | None = None  # the present one
        self._run = False
        self.answers: list[Answer] = []

    def run(self) -> list[Answer]:
        """Runs the trials that are left, and returns all answers, as rows with the columns of the file.

        Once: to resume, make an Experiment of the same trials from their beginning. ValueError for a
        trial that the program refuses, and if the answers in the file are not those of these trials;
        ExperimentError if the program ends early. Either way no answer is lost.
        """
        if self._run:
            raise RuntimeError("an Experiment runs once: make another one of the same trials to resume")
        self._run = True
        with _Program(self._command) as program:
            ended = self._serve(program)
            problem = program.end()
        if problem or not ended:
            raise ExperimentError(problem or "the program has ended before the experiment")
        return self.answers

    def _serve(self, program: _Program) -> bool:
        """Answers every message. True if the program has told its end."""
        for name, content in program.messages():
            if name == "hello":
                if content["protocol"] != _PROTOCOL:
                    spoken = content["protocol"]
                    raise ExperimentError(f"the program speaks protocol {spoken}, this package {_PROTOCOL}")
                self._trial = self._source.next(None)
            elif name == "answer":
                self._hear(_answer(content))
            elif name == "next":
                self._give(program)
            elif name == "felt":
                program.send(choose=self._choose(content))
            elif name == "error":
                raise ValueError(content)
            elif name == "end":
                return True
        return False

    def _hear(self, answer: Answer) -> None:
        while self._trial is not None and _is_break(self._trial):
            self._trial = self._source.next(None)
        _check_same(self._trial, answer)
        self.answers.append(answer)
        self._trial = self._source.next(answer)

    def _give(self, program: _Program) -> None:
        if self._trial is None:
            program.send(end=True)
            return
        program.send(trial=self._trial)
        if _is_break(self._trial):
            self._trial = self._source.next(None)

    def _choose(self, felt: dict[str, Any]) -> int:
        assert self._observer is not None and self._trial is not None
        order = [felt["first"].lower(), felt["second"].lower()]
        chosen = self._observer(
            Felt(
                number=felt["trial"],
                trial=self._trial,
                first=order[0],
                values={name: _value(text) for name, text in felt["values"].items()},
                exposures=dict(zip(order, felt["exposures"], strict=True)),
            )
        )
        if chosen not in order:
            raise ValueError(f"an observer returns 'a' or 'b', not {chosen!r}")
        return 1 + order.index(chosen)
