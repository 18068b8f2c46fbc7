#!/usr/bin/env python3
"""An arm of MuJoCo as the hand: it pushes the handle of a scene of Haptic Wall against the wall.

    pip install mujoco
    ./mujoco_hand.py

Upper arm and forearm lie in a plane, without gravity. Shoulder and elbow hold the tip of the arm on a
spring that moves into the wall. A spring and a damper, the grip, join the tip to the handle; both
simulators take its force, held through a tick of 1 ms.
"""
from typing import Any

import hapticwall as hw
import mujoco
import numpy as np
import numpy.typing as npt

ARM = """
<mujoco>
  <option timestep="0.001" gravity="0 0 0" integrator="implicitfast"/>
  <worldbody>
    <body pos="-0.40 -0.30 0">
      <joint name="shoulder" type="hinge" axis="0 0 1" damping="0.3"/>
      <geom type="capsule" fromto="0 0 0 0 0.30 0" size="0.03" mass="1.5"/>
      <body pos="0 0.30 0">
        <joint name="elbow" type="hinge" axis="0 0 1" damping="0.3"/>
        <geom type="capsule" fromto="0 0 0 0.40 0 0" size="0.02" mass="1.0"/>
        <site name="tip" pos="0.40 0 0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
GRIP_N_PER_M, GRIP_N_S_PER_M = 800.0, 10.0
PULL_N_PER_M, PULL_N_S_PER_M = 200.0, 20.0  # of the muscles, at the tip
# The hand of the scene lets go.
FREE = dict.fromkeys(("hand.stiffness_n_per_m", "hand.damping_n_s_per_m",
                      "hand.grip_stiffness_n_per_m", "hand.grip_damping_n_s_per_m"), 0.0)


def push(scene: str = "press", algorithm: str = "force-bounding",
         duration_s: float = 4.0) -> tuple[npt.NDArray[np.float64], dict[str, Any]]:
    """The rows of time, tip, handle and grip force, and the summary of the session."""
    model = mujoco.MjModel.from_xml_string(ARM)
    data = mujoco.MjData(model)
    tip = model.site("tip").id
    jacobian = np.zeros((3, model.nv))
    mujoco.mj_forward(model, data)
    rows = []
    with hw.Session(hw.load(scene).replace({**FREE, "duration_s": duration_s}), algorithm) as session:
        start_m, goal_m = session.position_m, session.scene["wall.position_m"] + 0.02
        velocity_m_per_s = 0.0
        while session.time_s < duration_s:
            mujoco.mj_jacSite(model, data, jacobian, None, tip)
            moving = jacobian @ data.qvel
            x_m, y_m = start_m + data.site_xpos[tip][0], data.site_xpos[tip][1]
            aim_m = start_m + (goal_m - start_m) * min(1.0, session.time_s)
            grip_n = GRIP_N_PER_M * (x_m - session.position_m) + GRIP_N_S_PER_M * (moving[0] - velocity_m_per_s)
            muscles = np.array([PULL_N_PER_M * (aim_m - x_m), -PULL_N_PER_M * y_m, 0.0]) - PULL_N_S_PER_M * moving
            data.qfrc_applied[:] = jacobian.T @ (muscles - [grip_n, 0.0, 0.0])
            row = session.step(hand_force_n=grip_n)
            velocity_m_per_s = row.velocity_m_per_s
            rows.append((row.time_s, x_m, row.true_position_m, grip_n, row.force_n, row.true_hand_work_j))
            mujoco.mj_step(model, data)
        return np.array(rows), session.summary


def main() -> None:
    rows, summary = push()
    print(f"{summary['verdict']}, grip {rows[-1, 3]:.2f} N, wall {rows[-1, 4]:.2f} N, handle {rows[-1, 2]:.4f} m")


if __name__ == "__main__":
    main()
