"""Algorithms by name, by file, and of one's own."""

from __future__ import annotations

import ctypes
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeVar

from hapticwall import _core
from hapticwall._functions import Function, Functions, Parameter, Signature, one, takes_lock
from hapticwall._path import Path, name_or_file


class Wall(ctypes.Structure):
    """hw_wall of hapticwall/plugin.h."""

    _fields_ = [(name, ctypes.c_double) for name in ("position_m", "stiffness_n_per_m", "damping_n_s_per_m")]


class Context(ctypes.Structure):
    """hw_context of hapticwall/plugin.h: the scene, for configure()."""

    _fields_ = [
        ("size", ctypes.c_uint32),
        ("period_s", ctypes.c_double),
        ("device_damping_n_s_per_m", ctypes.c_double),
        ("encoder_m", ctypes.c_double),
        ("force_limit_n", ctypes.c_double),
        ("parameters", ctypes.POINTER(ctypes.c_double)),
        ("walls", ctypes.POINTER(Wall)),
        ("wall_count", ctypes.c_uint32),
    ]


class Input(ctypes.Structure):
    """hw_input of hapticwall/plugin.h: a tick. numpy.dtype(Input) is its form for numba."""

    _fields_ = [
        ("size", ctypes.c_uint32),
        ("in_contact", ctypes.c_uint32),
        ("tick", ctypes.c_uint64),
        ("wall_force_n", ctypes.c_double),
        ("position_m", ctypes.c_double),
        ("displacement_m", ctypes.c_double),
        ("velocity_m_per_s", ctypes.c_double),
        ("penetration_m", ctypes.c_double),
        ("previous_force_n", ctypes.c_double),
    ]


_Result = TypeVar("_Result")

@dataclass(frozen=True)
class Algorithm:
    """An algorithm that `algorithm=` takes, as it takes its name."""

    name: str


class LawError(RuntimeError):
    """A function of a law raised an exception, the cause of this one; the force was zero from then on.

    `result` is what the call would have returned.
    """

    def __init__(self, result: object) -> None:
        super().__init__("the law raised an exception; its force was zero from then on")
        self.result = result


@dataclass(frozen=True)
class Given:
    """The arguments of algorithm(): functions, and all others by their names."""

    step: Function
    configure: Function
    reset: Function
    others: dict[str, Any]

    def same(self, other: Given | None) -> bool:
        """The same functions with the same arguments. NaN as a fallback equals NaN."""
        functions = ("step", "configure", "reset")
        return (
            other is not None
            and all(getattr(self, name) is getattr(other, name) for name in functions)
            and repr(self.others) == repr(other.others)
        )


_given: dict[str, Given] = {}


def given(name: str) -> Given | None:
    """What algorithm() has got for this name."""
    return _given.get(name)


# By the name of a law: what its addresses belong to.
_kept: dict[str, Functions] = {}
_indices: dict[str, int] = {}


def _sized_context(parameters: int) -> type:
    """hw_context whose arrays have their lengths."""

    def sized(name: str, length: Callable[[Any], int]) -> property:
        field = getattr(Context, name)

        def view(self: Any) -> Any:
            pointer = field.__get__(self)
            return (pointer._type_ * length(self)).from_address(ctypes.addressof(pointer.contents))

        return property(view)

    lengths = {"parameters": lambda self: parameters, "walls": lambda self: self.wall_count}
    return type("Context", (Context,), {name: sized(name, length) for name, length in lengths.items()})


def algorithm(
    step: Function,
    *,
    name: str,
    state_bytes: int = 0,
    configure: Function = None,
    reset: Function = None,
    parameters: Sequence[Parameter] = (),
    title: str = "",
    idea: str = "",
    equation: str = "",
) -> Algorithm:
    """Registers an algorithm for this process, by the C interface of docs/plugins.md.

    step(state, input) returns the force in newtons. configure(state, context) runs at the start and
    after each change of scene or parameters, reset(state) after it. The state has `state_bytes`
    bytes, zero at first, for each axis of each run; Python functions get it as an array of doubles,
    with IndexError beyond its end. An algorithm of the same name and parameters is replaced.
    """
    described = [_core.LawParameter(p.key, p.unit, p.minimum, p.maximum, p.fallback, p.meaning) for p in parameters]
    functions = Functions(
        state_bytes,
        {
            "step": Signature(True, one(Input)),
            "configure": Signature(False, one(_sized_context(len(described)))),
            "reset": Signature(False, None),
        },
    )
    steps, configures, resets = (
        functions.address(key, function)
        for key, function in (("step", step), ("configure", configure), ("reset", reset))
    )
    texts = (name, title or name, idea or title or name, equation)
    _core.add_law(*texts, state_bytes, described, steps, configures, resets, takes_lock(step))
    _kept[name] = functions
    others = dict(
        state_bytes=state_bytes, parameters=list(parameters), title=title, idea=idea, equation=equation
    )
    _given[name] = Given(step, configure, reset, others)
    return Algorithm(name)


def algorithms() -> list[str]:
    """The names of all algorithms: the built-in ones, then those of this process."""
    return _core.algorithm_names()


def index_of(chosen: Algorithm | Path) -> int:
    """Of a name, or of a plug-in's path, "./mine.so", which is loaded once."""
    name = chosen.name if isinstance(chosen, Algorithm) else name_or_file(chosen, "/")
    if name not in _indices:
        _indices[name] = _core.algorithm_index(name)
    return _indices[name]


def indices_of(chosen: Sequence[Algorithm | Path] | None) -> list[int]:
    """Of these, or of all built-in ones."""
    if chosen is None:
        return list(range(_core.first_plugin()))
    return [index_of(one) for one in chosen]


# Calls that run now, in any thread, and the hook before the first of them. A law's exception does not
# tell its call: all that run then hear of it.
_calls: list[list[BaseException]] = []
_calls_lock = threading.Lock()
_hook_before: list[Callable[[sys.UnraisableHookArgs], Any]] = []


def _hear(unraisable: sys.UnraisableHookArgs) -> None:
    if not _core.note_raised():
        for before in _hook_before:
            before(unraisable)
        return
    for raised in tuple(_calls):
        if unraisable.exc_value is not None and not raised:
            raised.append(unraisable.exc_value)


@contextmanager
def heard() -> Iterator[list[BaseException]]:
    """The exceptions of laws, which ctypes and numba cannot pass on, from here on."""
    raised: list[BaseException] = []
    with _calls_lock:
        if not _calls:
            _hook_before[:] = [sys.unraisablehook]
            sys.unraisablehook = _hear
        _calls.append(raised)
    try:
        yield raised
    finally:
        with _calls_lock:
            _calls[:] = [one for one in _calls if one is not raised]  # equal lists are others'
            if not _calls:
                sys.unraisablehook = _hook_before.pop()


def told(raised: list[BaseException], result: _Result) -> _Result:
    """The result of a run; raises LawError if a law raised an exception."""
    if raised:
        raise LawError(result) from raised[0]
    return result
