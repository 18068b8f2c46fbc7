"""Laws of a module, which travel to other processes."""

import os
import signal
import threading

import hapticwall as hw


def limited(state, tick):
    return min(tick[0].wall_force_n, 2.0)


def raises(state, tick):
    if tick[0].tick == 30:
        raise ZeroDivisionError("at tick 30")
    return tick[0].wall_force_n


waiting, started, may_raise = threading.Event(), threading.Event(), threading.Event()


def waits(state, tick):
    if tick[0].tick == 0:
        waiting.set()
        started.wait(60.0)
    return tick[0].wall_force_n


def raises_late(state, tick):
    if tick[0].tick == 30:
        started.set()
        may_raise.wait(60.0)
        raise ZeroDivisionError("late")
    return tick[0].wall_force_n


def read_switch(state, context):
    state[0] = context[0].parameters[0]


def kills(state, tick):
    if state[0] == 1.0 and tick[0].tick == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return tick[0].wall_force_n


def registered():
    """Those laws, in this process."""
    deadly = [hw.Parameter("deadly", "", 0.0, 1.0, 0.0, "1: ends the process")]
    return {
        "limited": hw.algorithm(limited, name="limited"),
        "waits": hw.algorithm(waits, name="waits"),
        "raises late": hw.algorithm(raises_late, name="raises-late"),
        "raises": hw.algorithm(raises, name="raises"),
        "kills": hw.algorithm(kills, name="kills", state_bytes=8, configure=read_switch, parameters=deadly),
    }
