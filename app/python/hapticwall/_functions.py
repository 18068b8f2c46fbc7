"""Functions of a law or an environment as the addresses that C calls."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

_Callback: Any = ctypes.CFUNCTYPE(None).__mro__[-2]  # of all ctypes callbacks, without a public name

# A function of a law or an environment: an address, an object with one (numba's @cfunc), a ctypes
# callback, or a Python function.
Function: TypeAlias = int | Callable[..., Any] | Any


@dataclass(frozen=True)
class Parameter:
    """A key of [algorithm] or [environment]. Without a fallback configure() gets NaN and chooses."""

    key: str
    unit: str = ""
    minimum: float = 0.0
    maximum: float = 1e6
    fallback: float = float("nan")
    meaning: str = ""


@dataclass(frozen=True)
class Signature:
    """Of a function behind its state: whether it returns a double, its structure, and a double after it."""

    returns: bool
    structure: type | None
    number: bool = False


def one(kind: type) -> Any:
    """An array of one, so that an index beyond it is an IndexError. `contents` as of a pointer."""
    array: Any = kind
    return type(kind.__name__, (array * 1,), {"contents": property(lambda self: self[0])})


class Functions:
    """The functions of one law or environment as addresses."""

    def __init__(self, state_bytes: int, signatures: Mapping[str, Signature]) -> None:
        self.kept: list[Any] = []  # what the addresses belong to
        self.state_bytes = state_bytes
        self.signatures = signatures

    def address(self, name: str, function: Function) -> int:
        if function is None or isinstance(function, int):
            return function or 0
        self.kept.append(function)
        address = getattr(function, "address", None)
        if isinstance(address, int):
            self._check(name, getattr(function, "ctypes", None))
            return address
        callback: Any = function
        if isinstance(function, _Callback):
            self._check(name, callback)
        else:
            callback = self._of_python(name, callback)
            self.kept.append(callback)
        return ctypes.cast(callback, ctypes.c_void_p).value or 0

    def _of_python(self, name: str, function: Callable[..., Any]) -> Any:
        doubles = self.state_bytes // ctypes.sizeof(ctypes.c_double)
        # Without a state the host's pointer may be NULL.
        nothing = None if doubles else (ctypes.c_double * 0)()
        state_type = ctypes.POINTER(ctypes.c_double * max(doubles, 1))
        signature = self.signatures[name]
        if signature.structure is None:
            return ctypes.CFUNCTYPE(None, state_type)(
                lambda state: function(state.contents if nothing is None else nothing)
            )
        result = ctypes.c_double if signature.returns else None
        structure: Any = ctypes.POINTER(signature.structure)
        if signature.number:
            return ctypes.CFUNCTYPE(result, state_type, structure, ctypes.c_double)(
                lambda state, other, number: function(
                    state.contents if nothing is None else nothing, other.contents, number
                )
            )
        return ctypes.CFUNCTYPE(result, state_type, structure)(
            lambda state, other: function(state.contents if nothing is None else nothing, other.contents)
        )

    def _check(self, name: str, callback: Any) -> None:
        """What the types of a callback tell. A pointer to doubles does not tell how many."""
        if not isinstance(callback, _Callback):
            return
        if self.signatures[name].returns and callback.restype is not ctypes.c_double:
            raise TypeError(f"{name} must return a double (ctypes.c_double), not {callback.restype}")
        state = getattr(callback.argtypes[0], "_type_", None) if callback.argtypes else None
        size = ctypes.sizeof(state) if isinstance(state, type) else 0
        if size > max(self.state_bytes, ctypes.sizeof(ctypes.c_double)):
            raise ValueError(f"{name} takes a state of {size} bytes; state_bytes is {self.state_bytes}")


def takes_lock(function: Function) -> bool:
    """Whether a call takes the interpreter's lock."""
    return not isinstance(function, int) and not isinstance(getattr(function, "address", None), int)
