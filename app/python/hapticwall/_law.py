"""Algorithms by name, by file, and of one's own."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeVar

from hapticwall import _core


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


_State = ctypes.POINTER(ctypes.c_double)
_STEP = ctypes.CFUNCTYPE(ctypes.c_double, _State, ctypes.POINTER(Input))
_CONFIGURE = ctypes.CFUNCTYPE(None, _State, ctypes.POINTER(Context))
_RESET = ctypes.CFUNCTYPE(None, _State)
_Callback: type = _STEP.__mro__[-2]  # of all ctypes callbacks, without a public name

_Result = TypeVar("_Result")

# A function of a law: an address, an object with one (numba's @cfunc), a ctypes callback, or a
# Python function.
Function: TypeAlias = int | Callable[..., Any] | Any


@dataclass(frozen=True)
class Parameter:
    """A key of [algorithm]. Without a fallback configure() gets NaN and chooses."""

    key: str
    unit: str = ""
    minimum: float = 0.0
    maximum: float = 1e6
    fallback: float = float("nan")
    meaning: str = ""


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


# By the name of a law: what its addresses belong to.
_kept: dict[str, tuple[Any, ...]] = {}
_indices: dict[str, int] = {}


def _callback(function: Function, prototype: Any) -> tuple[int, Any, bool]:
    """Address, what must live as long, and whether a call takes the interpreter's lock."""
    if function is None:
        return 0, None, False
    if isinstance(function, int):
        return function, None, False
    address = getattr(function, "address", None)
    if isinstance(address, int):
        return address, function, False
    callback: Any = function if isinstance(function, _Callback) else prototype(function)
    return ctypes.cast(callback, ctypes.c_void_p).value or 0, callback, True


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
    bytes, zero at first, for each axis of each run; Python functions get it as a pointer to doubles.
    An algorithm of the same name and parameters is replaced.
    """
    described = [_core.LawParameter(p.key, p.unit, p.minimum, p.maximum, p.fallback, p.meaning) for p in parameters]
    steps, configures, resets = _callback(step, _STEP), _callback(configure, _CONFIGURE), _callback(reset, _RESET)
    texts = (name, title or name, idea or title or name, equation)
    _core.add_law(*texts, state_bytes, described, steps[0], configures[0], resets[0], steps[2])
    _kept[name] = (steps[1], configures[1], resets[1])
    return Algorithm(name)


def algorithms() -> list[str]:
    """The names of all algorithms: the built-in ones, then those of this process."""
    return _core.algorithm_names()


def index_of(chosen: Algorithm | str) -> int:
    """Of a name, or of a plug-in's path, "./mine.so", which is loaded once."""
    name = chosen.name if isinstance(chosen, Algorithm) else chosen
    if name not in _indices:
        _indices[name] = _core.algorithm_index(name)
    return _indices[name]


def indices_of(chosen: Sequence[Algorithm | str] | None) -> list[int]:
    """Of these, or of all built-in ones."""
    if chosen is None:
        return list(range(_core.first_plugin()))
    return [index_of(one) for one in chosen]


@contextmanager
def heard() -> Iterator[list[BaseException]]:
    """The exceptions of laws, which ctypes and numba cannot pass on, from here on."""
    raised: list[BaseException] = []
    before = sys.unraisablehook

    def hear(unraisable: sys.UnraisableHookArgs) -> None:
        if not _core.note_raised():
            before(unraisable)
        elif unraisable.exc_value is not None and not raised:
            raised.append(unraisable.exc_value)

    sys.unraisablehook = hear
    try:
        yield raised
    finally:
        sys.unraisablehook = before


def told(raised: list[BaseException], result: _Result) -> _Result:
    """The result of a run; raises LawError if a law raised an exception."""
    if raised:
        raise LawError(result) from raised[0]
    return result
