"""Haptic Wall: virtual walls on the simulator, under any stabilising algorithm.

SI units throughout. docs/python.md shows every function at work.
"""

from hapticwall._law import Algorithm, Context, Input, LawError, Parameter, Wall, algorithm, algorithms
from hapticwall._run import Recording, Run, batch, compare, read, rerun, run
from hapticwall._scene import Scene, Value, load
from hapticwall._session import Sample, Session
from hapticwall._study import Map, WorstHand, map, worst_hand  # noqa: A004

__all__ = [
    "Algorithm",
    "Context",
    "Input",
    "LawError",
    "Map",
    "Parameter",
    "Recording",
    "Run",
    "Sample",
    "Scene",
    "Session",
    "Value",
    "Wall",
    "WorstHand",
    "algorithm",
    "algorithms",
    "batch",
    "compare",
    "load",
    "map",
    "read",
    "rerun",
    "run",
    "worst_hand",
]
