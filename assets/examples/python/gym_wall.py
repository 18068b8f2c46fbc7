#!/usr/bin/env python3
"""A Gymnasium environment on a scene of Haptic Wall: the agent is the hand and learns to press.

    pip install gymnasium
    ./gym_wall.py

Observation: position, m, and velocity, m/s. Action: force of the hand, in 10 N, held for 10 ticks.
Reward of a step: 1 for a wall force of 2 N, less by the distance to it, in 2 N.
"""
from typing import Any

import gymnasium
import hapticwall as hw
import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[Any]
# The hand of the scene lets go.
FREE = dict.fromkeys(("hand.stiffness_n_per_m", "hand.damping_n_s_per_m",
                      "hand.grip_stiffness_n_per_m", "hand.grip_damping_n_s_per_m"), 0.0)


class WallEnv(gymnasium.Env[Numbers, Numbers]):
    observation_space = gymnasium.spaces.Box(-10.0, 10.0, (2,), np.float64)
    action_space = gymnasium.spaces.Box(-1.0, 1.0, (1,), np.float32)

    def __init__(self, scene: str = "press", algorithm: str = "force-bounding", **values: float) -> None:
        self.scene = hw.load(scene).replace({**FREE, **values})
        self.algorithm = algorithm
        self.session: hw.Session | None = None

    def reset(self, *, seed: int | None = None,
              options: dict[str, Any] | None = None) -> tuple[Numbers, dict[str, Any]]:
        super().reset(seed=seed)
        self.close()
        self.session = hw.Session(self.scene, self.algorithm)
        return np.array([self.session.position_m, 0.0]), {}

    def step(self, action: Numbers) -> tuple[Numbers, float, bool, bool, dict[str, Any]]:
        assert self.session is not None, "reset() comes first"
        force_n = 10.0 * float(action[0])
        row = self.session.step(hand_force_n=force_n)
        for _ in range(9):
            row = self.session.step(hand_force_n=force_n)
        seen = np.clip([row.position_m, row.velocity_m_per_s], -10.0, 10.0)
        lost = self.session.diverged or abs(row.position_m) > 1.0
        over = self.session.time_s >= self.scene["duration_s"]
        return seen, 1.0 - abs(row.force_n - 2.0) / 2.0, lost, over, {"force_n": row.force_n}

    def close(self) -> None:
        if self.session is not None:
            self.session.close()


def main() -> None:
    env = WallEnv()
    (position_m, velocity_m_per_s), total, over, steps = env.reset(seed=1)[0], 0.0, False, 0
    while not over:
        pull = np.array([0.2 - 0.3 * velocity_m_per_s], dtype=np.float32)
        (position_m, velocity_m_per_s), reward, lost, over, _ = env.step(pull)
        total, over, steps = total + reward, over or lost, steps + 1
    print(f"position {position_m:.4f} m, mean reward {total / steps:.3f}")
    env.close()


if __name__ == "__main__":
    main()
