"""The keys of scenes, and the built-in scenes."""

from __future__ import annotations

from dataclasses import dataclass

from hapticwall import _core


@dataclass(frozen=True)
class Key:
    """A key of a scene. Both ends belong to the range, unless `minimum_excluded`.

    `kind` is "number", "whole number", "switch" or "choice". `default` is the number of a scene file
    that omits the key; None for a part that is then absent, for a required number, and for a default
    that depends on the scene, which `default_text` says in words.
    """

    key: str
    kind: str
    unit: str
    minimum: float
    maximum: float
    minimum_excluded: bool
    required: bool
    default: float | None
    default_text: str
    choices: list[str]
    meaning: str


def keys_of(scene: _core.Scene) -> list[Key]:
    return [Key(**described) for described in _core.keys_of(scene)]


def keys() -> list[Key]:
    """The keys of a scene with one axis, a hand and a wall. Those of axis y are device.y.KEY and hand.y.KEY."""
    return [Key(**described) for described in _core.keys()]


def scenes() -> dict[str, str]:
    """The built-in scenes: name and description."""
    return dict(_core.scenes())
