#!/usr/bin/env python3
"""The just noticeable difference of stiffness by QUEST+ (Watson 2017): each trial is the one that
tells most about the observer.

    pip install questplus
    ./questplus_jnd.py P01               # a person, in the window
    ./questplus_jnd.py P01 --rehearse    # a simulated observer, without a window
"""
import math
import sys
from collections.abc import Generator

import numpy as np
import questplus

import hapticwall as hw

REFERENCE_N_PER_M = 1000.0
KEY = "wall.stiffness_n_per_m"
QUARTILE = 0.6745  # of the normal distribution: chosen in 75 % of the trials


def trials(count: int, found: dict[str, float]) -> Generator[hw.Trial, hw.Answer, None]:
    """`found` gets the bias and the JND, as shares of the reference."""
    quest = questplus.QuestPlus(
        stim_domain={"intensity": np.linspace(-0.4, 0.4, 41)},  # logarithm of b/a
        param_domain={"mean": np.linspace(-0.1, 0.1, 9), "sd": np.geomspace(0.03, 0.6, 25),
                      "lower_asymptote": [0.01], "lapse_rate": [0.01]},
        outcome_domain={"response": ["b", "a"]},
        func="norm_cdf", stim_scale="linear")
    for _ in range(count):
        ratio = float(quest.next_stim["intensity"])
        answer = yield {"a": {KEY: REFERENCE_N_PER_M},
                        "b": {KEY: round(REFERENCE_N_PER_M * math.exp(ratio), 3)},
                        "correct": "b" if ratio > 1e-9 else "a" if ratio < -1e-9 else "",
                        "kind": "catch" if abs(ratio) < 1e-9 else "test", "log_ratio": ratio}
        quest.update(stim={"intensity": ratio}, outcome={"response": answer["chosen"].lower()})
        estimate = quest.param_estimate
        found["bias"] = math.expm1(estimate["mean"])
        found["jnd"] = math.expm1(QUARTILE * estimate["sd"])


if __name__ == "__main__":
    participant = sys.argv[1]
    result: dict[str, float] = {}
    observer = hw.observer(KEY, jnd=0.1, lapses=0.02) if "--rehearse" in sys.argv[2:] else None
    hw.Experiment(trials(60, result), scene="press", participant=participant,
                  answers=f"questplus-{participant}.csv", observer=observer).run()
    print(f"JND {100 * result['jnd']:.1f} %, bias {100 * result['bias']:.1f} %")
