"""Maps as xarray.Dataset."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, TypeAlias

from hapticwall._scene import Scene

if TYPE_CHECKING:
    from hapticwall._study import Map

# xarray.Dataset, which the module does not need.
Dataset: TypeAlias = Any

# Of the ends of names; longer ones first.
_UNITS = {"_m_per_s2": "m/s²", "_n_per_m": "N/m", "_j": "J", "_w": "W", "_n": "N", "_m": "m", "_s": "s"}


def unit_of(scene: Scene, key: str) -> str:
    """Of a key that a map varies; "" for a key that it refuses."""
    if key == "hand.path_speed_m_per_s":
        return "m/s"
    try:
        return scene.describe(key).unit
    except KeyError:
        return ""


def _attributes(key: str) -> dict[str, str]:
    found = next((unit for end, unit in _UNITS.items() if key.endswith(end)), "")
    return {"units": found} if found else {}


def dataset(found: Map) -> Dataset:
    xarray: Any = importlib.import_module("xarray")  # the module works without it

    axes = ("algorithm", found.y_key, found.x_key)
    numbers = {key: (axes, found[key], _attributes(key)) for key in found.columns if key != "verdict"}
    return xarray.Dataset(
        {"verdict": (axes, found.verdict), **numbers},
        coords={
            "algorithm": found.algorithms,
            found.y_key: (found.y_key, found.y, {"units": found.y_unit}),
            found.x_key: (found.x_key, found.x, {"units": found.x_unit}),
        },
    )
