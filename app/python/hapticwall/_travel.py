"""Algorithms and environments that travel to another process: by name, as a file with its SHA-256, or as importable functions."""

from __future__ import annotations

import hashlib
import importlib
import os
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hapticwall import _core
from hapticwall._environment import (
    FUNCTIONS,
    GivenEnvironment,
    environment,
    given_environment,
    load_environment,
    travelling_functions,
)
from hapticwall._functions import Function
from hapticwall._law import Algorithm, Given, algorithm, given, index_of

# Of two tasks in one process, the second waits for the algorithm of the first.
_arriving = threading.RLock()


@dataclass(frozen=True)
class Place:
    """A function as "module:qualname"."""

    module: str
    qualname: str

    def function(self) -> Any:
        found: Any = importlib.import_module(self.module)
        for name in self.qualname.split("."):
            found = getattr(found, name)
        return found


def _place_of(owner: str, role: str, function: Function) -> Place | None:
    """ValueError for a function that no module defines under its name."""
    if function is None:
        return None
    source = getattr(function, "__wrapped__", function)  # what numba has compiled
    place = Place(str(getattr(source, "__module__", "")), str(getattr(source, "__qualname__", "")))
    try:
        if place.function() is function:
            return place
    except (ImportError, AttributeError, ValueError):
        pass
    raise ValueError(
        f"{owner}: its {role} cannot travel; define it at the top of a module, "
        "as a Python function or by numba's @cfunc, not as a lambda, an address or a ctypes callback"
    )


@dataclass(frozen=True)
class BuiltIn:
    name: str

    def arrive(self) -> int:
        return _core.algorithm_index(self.name)


@dataclass(frozen=True)
class PluginFile:
    """A plug-in by its absolute path. Another file than that of the sender is refused."""

    name: str
    path: str
    sha256: str

    def arrive(self) -> int:
        if self.name in _core.algorithm_names():
            index = _core.algorithm_index(self.name)
        else:
            with open(self.path, "rb") as file:
                self._check(hashlib.sha256(file.read()).hexdigest())  # before its code runs
            index = index_of(self.path)
        self._check(_core.plugin_file(index)[1])
        return index

    def _check(self, sha256: str) -> None:
        if sha256 != self.sha256:
            raise ValueError(f"{self.path}: not the plug-in that was sent; SHA-256 {self.sha256} is wanted")


@dataclass(frozen=True)
class Law:
    """A law of one's own, by the places of its functions."""

    name: str
    step: Place
    configure: Place | None
    reset: Place | None
    others: dict[str, Any]  # the other arguments of algorithm()

    def arrive(self) -> int:
        step, configure, reset = (place and place.function() for place in (self.step, self.configure, self.reset))
        wanted = Given(step, configure, reset, self.others)
        if not wanted.same(given(self.name)):  # the import may have registered it, or a fork has it
            algorithm(step, name=self.name, configure=configure, reset=reset, **self.others)
        return index_of(Algorithm(self.name))


@dataclass(frozen=True)
class EnvironmentFile:
    """The environment of a plug-in by its absolute path. Another file than that of the sender is refused."""

    name: str
    path: str
    sha256: str

    def arrive(self) -> None:
        if self.name not in _core.environment_names():
            with open(self.path, "rb") as file:
                self._check(hashlib.sha256(file.read()).hexdigest())  # before its code runs
            load_environment(self.path)
        self._check(_core.environment_file(self.name)[1])

    def _check(self, sha256: str) -> None:
        if sha256 != self.sha256:
            raise ValueError(f"{self.path}: not the plug-in that was sent; SHA-256 {self.sha256} is wanted")


@dataclass(frozen=True)
class OwnEnvironment:
    """An environment of one's own, by the places of its functions."""

    name: str
    places: tuple[Place | None, ...]  # in the order of FUNCTIONS
    others: dict[str, Any]  # the other arguments of environment()

    def arrive(self) -> None:
        functions = tuple(place and place.function() for place in self.places)
        if GivenEnvironment(functions, self.others).same(given_environment(self.name)):
            return  # the import may have registered it, or a fork has it
        given_functions: dict[str, Any] = dict(zip(FUNCTIONS, functions, strict=True))
        environment(name=self.name, **given_functions, **self.others)


Traveller = BuiltIn | PluginFile | Law
EnvironmentTraveller = EnvironmentFile | OwnEnvironment


def environment_traveller_of(name: str) -> EnvironmentTraveller:
    """Of an environment that is not built in. ValueError if it cannot travel."""
    path, sha256 = _core.environment_file(name)
    if path:
        return EnvironmentFile(name, os.path.abspath(path), sha256)
    own = given_environment(name)
    if own is None:
        raise ValueError(f"environment {name!r} cannot travel: it is not of hapticwall.environment()")
    places = travelling_functions(own, lambda role, function: _place_of(f"environment {name!r}", role, function))
    return OwnEnvironment(name, places, own.others)


def traveller_of(index: int) -> Traveller:
    """Of an algorithm of this process. ValueError if it cannot travel."""
    name = _core.algorithm_names()[index]
    if index < _core.first_plugin():
        return BuiltIn(name)
    path, sha256 = _core.plugin_file(index)
    if path:
        return PluginFile(name, os.path.abspath(path), sha256)
    law = given(name)
    if law is None:
        raise ValueError(f"algorithm {name!r} cannot travel: it is not of hapticwall.algorithm()")
    owner = f"algorithm {name!r}"
    step = _place_of(owner, "step", law.step)
    assert step is not None
    configure, reset = _place_of(owner, "configure", law.configure), _place_of(owner, "reset", law.reset)
    return Law(name, step, configure, reset, law.others)


def arrived(travellers: list[Traveller]) -> list[int]:
    """Their indices in this process, which registers or loads them if it must."""
    with _arriving:
        return [traveller.arrive() for traveller in travellers]


def scene_arrived(
    kind: Callable[[_core.Scene], Any],
    travellers: list[Traveller],
    environments: list[EnvironmentTraveller],
    toml: str,
    paths: list[_core.PathState],
) -> Any:
    """A scene after its algorithms and environments."""
    arrived(travellers)
    with _arriving:
        for one in environments:
            one.arrive()
    return kind(_core.Scene.of_state(toml, paths))
