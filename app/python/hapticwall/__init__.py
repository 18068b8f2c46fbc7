"""Haptic Wall: virtual walls on the simulator, under any stabilising algorithm.

SI units throughout. docs/python.md shows every function at work.
"""

from hapticwall import _core
from hapticwall._environment import (
    Environment,
    EnvironmentContext,
    Motion,
    environment,
    environments,
    load_environment,
)
from hapticwall._executor import Unfinished
from hapticwall._experiment import Answer, Experiment, ExperimentError, Felt, Trial, observer
from hapticwall._functions import Parameter
from hapticwall._keys import Key, keys, scenes
from hapticwall._law import Algorithm, Context, Input, LawError, Wall, algorithm, algorithms
from hapticwall._named_study import Axis, accuracy, boundary, studies, study
from hapticwall._run import Recording, Run, batch, compare, read, rerun, run
from hapticwall._scene import Scene, Value, load
from hapticwall._session import Sample, Session
from hapticwall._study import Map, WorstHand, map, worst_hand  # noqa: A004

__version__: str = _core.version

__all__ = [
    "Algorithm",
    "Answer",
    "Axis",
    "Context",
    "Environment",
    "EnvironmentContext",
    "Experiment",
    "ExperimentError",
    "Felt",
    "Input",
    "Key",
    "LawError",
    "Map",
    "Motion",
    "Parameter",
    "Recording",
    "Run",
    "Sample",
    "Scene",
    "Session",
    "Trial",
    "Unfinished",
    "Value",
    "Wall",
    "WorstHand",
    "accuracy",
    "algorithm",
    "algorithms",
    "batch",
    "boundary",
    "compare",
    "environment",
    "environments",
    "keys",
    "load",
    "load_environment",
    "map",
    "observer",
    "read",
    "rerun",
    "run",
    "scenes",
    "studies",
    "study",
    "worst_hand",
]
