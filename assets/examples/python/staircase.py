#!/usr/bin/env python3
"""A 2-down-1-up staircase on stiffness: two right answers make the next trial harder, a wrong one
easier. It ends near the difference that is told in 70.7 % of the trials (Levitt 1971).

    ./staircase.py P01               # a person, in the window
    ./staircase.py P01 --rehearse    # a simulated observer, without a window

The same command resumes after an end at any moment.
"""
import math
import sys

import hapticwall as hw

REFERENCE_N_PER_M = 1000.0
KEY = "wall.stiffness_n_per_m"


class Staircase:
    """Gives trials whose wall b is stiffer by the share `difference`."""

    def __init__(self, trials: int = 80, difference: float = 0.5, factor: float = 1.25) -> None:
        self.trials, self.difference, self.factor = trials, difference, factor
        self.right, self.direction = 0, 0
        self.reversals: list[float] = []

    def next(self) -> hw.Trial | None:
        if self.trials == 0:
            return None
        stiffness = REFERENCE_N_PER_M * (1.0 + self.difference)
        return {"a": {KEY: REFERENCE_N_PER_M}, "b": {KEY: round(stiffness, 3)}, "correct": "b",
                "difference": self.difference, "reversals": len(self.reversals)}

    def answer(self, answer: hw.Answer) -> None:
        self.trials -= 1
        self.right = self.right + 1 if answer["correct"] else 0
        if answer["correct"] and self.right < 2:
            return
        direction = -1 if answer["correct"] else 1
        if self.direction == -direction:
            self.reversals.append(self.difference)
        self.direction, self.right = direction, 0
        self.difference *= self.factor**direction

    def threshold(self) -> float | None:
        """The geometric mean of the reversals without the first four, as a share; None if too few."""
        used = self.reversals[4:]
        return math.exp(sum(map(math.log, used)) / len(used)) if used else None


if __name__ == "__main__":
    participant = sys.argv[1]
    observer = hw.observer(KEY, jnd=0.1, lapses=0.02) if "--rehearse" in sys.argv[2:] else None
    staircase = Staircase()
    hw.Experiment(staircase, scene="press", participant=participant,
                  answers=f"staircase-{participant}.csv", observer=observer).run()
    print(f"{len(staircase.reversals)} reversals, threshold: {staircase.threshold()}")
