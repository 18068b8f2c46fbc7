"""The law of docs/algorithms/energy-bounding.md, written in every way that Python offers."""

import ctypes
import math
import os
import sys

import numba
import numpy as np
from numba import types

import hapticwall as hw

PARAMETERS = [
    hw.Parameter("damping_n_s_per_m", "N·s/m", 0.0, 1e6),
    hw.Parameter("rest_force_step_n", "N", 0.0, 1e6),
]


def configure(state, context):
    scene = context[0]
    damping, rest = scene.parameters[0], scene.parameters[1]
    state[0] = scene.device_damping_n_s_per_m if math.isnan(damping) else damping
    hidden = 0.0075 * state[0] if scene.encoder_m > 0.0 else sys.float_info.max
    state[1] = hidden if math.isnan(rest) else rest


def bounded(state, tick):
    speed = abs(tick.velocity_m_per_s)
    bound = state[0] * speed if speed != 0.0 else state[1]
    wanted = tick.wall_force_n - tick.previous_force_n
    if abs(wanted) <= bound:
        return tick.wall_force_n
    return tick.previous_force_n + math.copysign(bound, wanted)


def step(state, tick):
    return bounded(state, tick[0])


compiled = numba.njit(bounded)
record = numba.from_dtype(np.dtype(hw.Input))


@numba.cfunc(types.float64(types.CPointer(types.float64), types.CPointer(record)))
def numba_step(state, tick):
    return compiled(state, numba.carray(tick, 1)[0])


Double = ctypes.POINTER(ctypes.c_double)
ctypes_step = ctypes.CFUNCTYPE(ctypes.c_double, Double, ctypes.POINTER(hw.Input))(step)


def law(step, name):
    return hw.algorithm(step, name=name, state_bytes=16, configure=configure, parameters=PARAMETERS)


def written():
    """Name and algorithm of each."""
    plugins = os.environ["HAPTICWALL_TEST_PLUGINS"]
    return {
        "C": f"{plugins}/bounding_c.so",
        "C++": f"{plugins}/bounding_cpp.so",
        "numba, its address": law(numba_step.address, "by-address"),
        "numba": law(numba_step, "numba"),
        "a ctypes callback": law(ctypes_step, "ctypes"),
        "Python": law(step, "plain"),
    }
