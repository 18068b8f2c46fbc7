"""Uses the installed module; a bare environment has it and NumPy alone."""

import importlib.metadata
import math
import pathlib

import hapticwall as hw


def configure(state, context):
    state[0] = context[0].device_damping_n_s_per_m


def step(state, input):
    tick = input[0]
    bound = state[0] * abs(tick.velocity_m_per_s)
    wanted = tick.wall_force_n - tick.previous_force_n
    return tick.previous_force_n + math.copysign(min(abs(wanted), bound), wanted)


run = hw.run("press", algorithm="energy-bounding")
assert run.summary["verdict"] == "settled", run.summary
assert run.samples["force_n"].max() > 1.0
assert len(hw.batch([hw.load("tap"), hw.load("light")])) == 2
with hw.Session("press") as session:
    session.step()
mine = hw.algorithm(step, name="mine", state_bytes=8, configure=configure)
assert hw.run("press", algorithm=mine).summary["verdict"] == "settled"

files = importlib.metadata.files("hapticwall")
assert files is not None
licences = "".join(path.read_text() for path in files if "licenses" in path.parts)
for part in ("Haptic Wall", "Eigen", "toml++", "JSON for Modern C++", "{fmt}", "libpng", "libmd", "nanobind", "robin-map"):
    assert part in licences, part
assert not any("tests" in path.parts for path in files)
assert importlib.metadata.version("hapticwall") == hw.__version__
assert pathlib.Path(hw.__file__).parent.joinpath("py.typed").is_file()
