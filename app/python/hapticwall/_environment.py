"""Environments of one's own: the force of what the handle touches."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from hapticwall import _core
from hapticwall._functions import Function, Functions, Parameter, Signature, one, takes_lock
from hapticwall._path import Path, path_text

FUNCTIONS = ("configure", "reset", "force", "advance", "depth", "stiffness_hint")


class Motion(ctypes.Structure):
    """hw_motion of hapticwall/environment.h: the handle at a tick. numpy.dtype(Motion) is its form for numba."""

    _fields_ = [
        ("size", ctypes.c_uint32),
        ("axis", ctypes.c_uint32),
        ("axes", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("time_s", ctypes.c_double),
        ("position_m", ctypes.c_double),
        ("velocity_m_per_s", ctypes.c_double),
        ("other_position_m", ctypes.c_double),
        ("other_velocity_m_per_s", ctypes.c_double),
    ]


class EnvironmentContext(ctypes.Structure):
    """hw_environment_context of hapticwall/environment.h: the scene, for configure()."""

    _fields_ = [
        ("size", ctypes.c_uint32),
        ("axis", ctypes.c_uint32),
        ("period_s", ctypes.c_double),
        ("parameters", ctypes.POINTER(ctypes.c_double)),
    ]


def _sized_context(parameters: int) -> type:
    """hw_environment_context whose array has its length."""
    field: Any = EnvironmentContext.parameters

    def view(self: Any) -> Any:
        pointer = field.__get__(self)
        return (ctypes.c_double * parameters).from_address(ctypes.addressof(pointer.contents))

    return type("EnvironmentContext", (EnvironmentContext,), {"parameters": property(view)})


@dataclass(frozen=True)
class Environment:
    """An environment: the value of the key "environment.name"."""

    name: str


@dataclass(frozen=True)
class GivenEnvironment:
    """The arguments of environment(): its functions, and all others by their names."""

    functions: tuple[Function, ...]  # in the order of FUNCTIONS
    others: dict[str, Any]

    def same(self, other: GivenEnvironment | None) -> bool:
        """The same functions with the same arguments. NaN as a fallback equals NaN."""
        return (
            other is not None
            and all(a is b for a, b in zip(self.functions, other.functions, strict=True))
            and repr(self.others) == repr(other.others)
        )


_given: dict[str, GivenEnvironment] = {}
_kept: dict[str, Functions] = {}  # what the addresses belong to


def given_environment(name: str) -> GivenEnvironment | None:
    """What environment() has got for this name."""
    return _given.get(name)


def environment(
    force: Function,
    *,
    name: str,
    state_bytes: int = 0,
    configure: Function = None,
    reset: Function = None,
    advance: Function = None,
    depth: Function = None,
    stiffness_hint: Function = None,
    parameters: Sequence[Parameter] = (),
    title: str = "",
    idea: str = "",
    equation: str = "",
) -> Environment:
    """Registers an environment for this process, by the C interface of docs/environments.md.

    force(state, motion) returns the force in newtons and changes nothing; a positive one pushes out of
    the wall. configure(state, context) runs at the start and after each change of scene or parameters,
    reset(state) after it, advance(state, motion, applied_force_n) after each tick. depth(state, motion)
    in metres is above 0 in contact; without it a contact is where the force is not 0.
    stiffness_hint(state, motion) in N/m is for the algorithms that need a spring. The state has
    `state_bytes` bytes, zero at first, for each axis of each run. An environment of the same name,
    parameters and functions is replaced.
    """
    described = [_core.LawParameter(p.key, p.unit, p.minimum, p.maximum, p.fallback, p.meaning) for p in parameters]
    motion = one(Motion)
    signatures = {name: Signature(True, motion) for name in ("force", "depth", "stiffness_hint")}
    signatures["configure"] = Signature(False, one(_sized_context(len(described))))
    signatures["reset"] = Signature(False, None)
    signatures["advance"] = Signature(False, motion, number=True)
    functions = Functions(state_bytes, signatures)
    all_of_them = (configure, reset, force, advance, depth, stiffness_hint)
    addresses = [functions.address(role, one_of) for role, one_of in zip(FUNCTIONS, all_of_them, strict=True)]
    texts = [name, title or name, idea or title or name, equation]
    _core.add_environment(texts, state_bytes, described, addresses, takes_lock(force))
    _kept[name] = functions
    others = dict(
        state_bytes=state_bytes, parameters=list(parameters), title=title, idea=idea, equation=equation
    )
    _given[name] = GivenEnvironment(all_of_them, others)
    return Environment(name)


def load_environment(path: Path) -> Environment:
    """The environment in a plug-in's file, "./mine.so", which is loaded once."""
    return Environment(_core.load_environment(path_text(path)))


def environments() -> list[str]:
    """The names of all environments: walls, the other built-in ones, then those of this process."""
    return _core.environment_names()


def travelling_functions(given: GivenEnvironment, place_of: Callable[[str, Function], Any]) -> tuple[Any, ...]:
    """The places of the functions, in the order of FUNCTIONS."""
    return tuple(place_of(role, function) for role, function in zip(FUNCTIONS, given.functions, strict=True))
