"""Scenes: values with the keys of a scene file."""

from __future__ import annotations

import numbers
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np

from hapticwall import _core
from hapticwall._environment import Environment
from hapticwall._keys import Key, keys_of
from hapticwall._law import Algorithm, index_of
from hapticwall._path import Path, name_or_file
from hapticwall._travel import environment_traveller_of, scene_arrived, traveller_of

# What a key takes: a number, true or false, a word, an algorithm or environment, or the points of a path.
Value: TypeAlias = float | str | bool | Algorithm | Environment | Sequence[Sequence[float]]


def setting(value: object) -> float | str:
    """A number, or the text that --set takes."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Real):
        return float(value)
    if isinstance(value, str):
        return value
    if isinstance(value, (Algorithm, Environment)):
        return value.name
    if isinstance(value, (Sequence, np.ndarray)):
        return repr([[float(number) for number in point] for point in value])
    raise TypeError(f"a key takes a number, a text or [[time_s, position_m], ...], not {value!r}")


def _parts(key: str) -> Iterator[str | int]:
    for word, index in re.findall(r"([^.\[\]]+)(?:\[(\d+)\])?", key):
        yield word
        if index:
            yield int(index)


class Scene:
    """A scene. Its keys are those of a scene file and of --set, such as "hand.mass_kg".

    A key that the scene omits has the value None. Every change is checked at once: ValueError for a
    wrong value, KeyError for an unknown key, with the nearest name. Iteration gives keys(). Two scenes
    are equal if all values are. A scene can be pickled and copied; a copy changes by itself.
    """

    def __init__(self, core: _core.Scene) -> None:
        self._core = core

    @classmethod
    def from_text(cls, toml: str) -> Scene:
        """A scene from the text of a scene file, as str() gives it. ValueError says what is wrong with it."""
        if not isinstance(toml, str):
            raise TypeError(f"the text of a scene file is a str, not {toml!r}")
        return cls(_core.Scene.of_text(toml))

    def __getitem__(self, key: str) -> Any:
        if not isinstance(key, str):
            raise TypeError(f"a key is a text such as 'hand.mass_kg', not {key!r}")
        known, number = self._core.number(key)
        return number if known else self._look_up(key)

    def __setitem__(self, key: str, value: Value) -> None:
        self._core = self._core.replaced([(key, setting(value))])

    def replace(self, values: Mapping[str, Value]) -> Scene:
        """The scene with other values, which are checked together; this one stays as it is."""
        return Scene(self._core.replaced([(key, setting(value)) for key, value in values.items()]))

    def with_algorithm(self, algorithm: Algorithm | Path, **parameters: float) -> Scene:
        """The scene under this algorithm, with its default for every parameter that is not given.

        replace({"algorithm.name": ...}) keeps the parameters instead: a key that two algorithms
        share keeps its value.
        """
        settings = [(f"algorithm.{key}", setting(value)) for key, value in parameters.items()]
        return Scene(self._core.with_algorithm(index_of(algorithm), settings))

    def __contains__(self, key: object) -> bool:
        """True for every key that a scene can have, also if this one omits it."""
        if not isinstance(key, str):
            return False
        try:
            self[key]
        except KeyError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    def keys(self) -> list[str]:
        """The keys of all numbers of this scene."""
        return self._core.number_keys()

    def describe(self, key: str) -> Key:
        """Unit, range and default of a number, switch or choice. KeyError for an unknown key."""
        found = {described.key: described for described in keys_of(self._core)}
        usual = key.replace("wall[0].", "wall.", 1)
        if key in found or usual in found:
            return found[key if key in found else usual]
        self[key]
        raise KeyError(f"{key!r}: no number, switch or choice")

    def __eq__(self, other: object) -> bool:
        return self._core.equal(other._core) if isinstance(other, Scene) else NotImplemented

    def __copy__(self) -> Scene:
        return type(self)(self._core)  # a change makes another core

    def __deepcopy__(self, memo: object) -> Scene:
        return type(self)(self._core)

    def __reduce__(self) -> tuple[Any, ...]:
        """With its algorithms and environments. ValueError for one that cannot travel."""
        toml, paths = self._core.state()
        travellers = [traveller_of(index) for index in self._core.algorithms()]
        own = [name for name in self._core.environments() if _core.own_environment(name)]
        environments = [environment_traveller_of(name) for name in own]
        return scene_arrived, (type(self), travellers, environments, toml, paths)

    def __str__(self) -> str:
        """The scene as a scene file."""
        return self._core.toml()

    def __repr__(self) -> str:
        return f"<hapticwall.Scene {self['name']!r} under {self['algorithm.name']!r}>"

    def _look_up(self, key: str) -> Any:
        value: Any = tomllib.loads(self._core.toml())
        parts = list(_parts(key))
        if not parts:
            raise KeyError(f"{key!r}: not a key; it takes one such as 'hand.mass_kg'")
        try:
            for part in parts:
                value = value[0][part] if isinstance(value, list) and isinstance(part, str) else value[part]
        except (KeyError, IndexError, TypeError):
            self._core.check_key(key)
            return None
        return value


def load(name_or_path: Path) -> Scene:
    """A built-in scene by its name, a scene file, or the sidecar of a recording.

    A pathlib.Path is a file. ValueError says what is wrong with it, OSError that it cannot be read.
    """
    return Scene(_core.Scene.load(name_or_file(name_or_path, "/.")))


def scene_of(scene: Scene | Path) -> Scene:
    return scene if isinstance(scene, Scene) else load(scene)
