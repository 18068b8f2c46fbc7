"""The contact of docs/environments.md, written in every way that Python offers."""

import ctypes
import math

import numba
import numpy as np
from numba import types

import hapticwall as hw

PARAMETERS = [
    hw.Parameter("position_m", "m", -1.0, 1.0, 0.05),
    hw.Parameter("reference_force_n", "N", 0.0, 1e6, 5.0),
]


def configure(state, context):
    state[0], state[1] = context[0].parameters[0], context[0].parameters[1]


def pressed(state, motion):
    depth_m = motion.position_m - state[0]
    if not depth_m > 0.0:
        return 0.0
    ratio = depth_m / 0.01
    spring_n = state[1] * (ratio * math.sqrt(ratio))
    return max(0.0, spring_n * (1.0 + 0.5 * motion.velocity_m_per_s))


def depth(state, motion):
    return motion[0].position_m - state[0]


def force(state, motion):
    return pressed(state, motion[0])


compiled = numba.njit(pressed)
record = numba.from_dtype(np.dtype(hw.Motion))
signature = types.float64(types.CPointer(types.float64), types.CPointer(record))


@numba.cfunc(signature)
def numba_force(state, motion):
    return compiled(state, numba.carray(motion, 1)[0])


@numba.cfunc(signature)
def numba_depth(state, motion):
    return numba.carray(motion, 1)[0].position_m - state[0]


ctypes_force = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.POINTER(ctypes.c_double), ctypes.POINTER(hw.Motion))(force)


def tissue(force, depth, name):
    return hw.environment(
        force, name=name, state_bytes=16, configure=configure, depth=depth, parameters=PARAMETERS
    )


# A mass on a spring: state is known, position, speed.
def mass_force(state, motion):
    return 1000.0 * (motion[0].position_m - state[1]) if state[0] else 0.0


def mass_reset(state):
    state[0] = state[1] = state[2] = 0.0


def mass_advance(state, motion, applied_force_n):
    force_n = mass_force(state, motion)
    if not state[0]:
        state[0], state[1] = 1.0, motion[0].position_m
    state[2] += 1e-3 * force_n / 0.5
    state[1] += 1e-3 * state[2]


def mass():
    return hw.environment(
        mass_force, name="own-mass", state_bytes=24, reset=mass_reset, advance=mass_advance
    )
