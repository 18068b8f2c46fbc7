"""Time of a tick of one law, written in several ways, and of many runs, beside `hapticwall map`."""

import os
import subprocess
import time

import numpy as np

import hapticwall as hw
import laws

REPETITIONS = 25
CELLS = (40, 25)


def processor_s(work):
    """Of this process and of the programs that it starts: other programs disturb it less than a clock."""
    begin = os.times()
    work()
    return sum(os.times()[:4]) - sum(begin[:4])


def ticks(scene, chosen):
    """Nanoseconds, the least of interleaved runs."""
    long = hw.load(scene).replace({"duration_s": 60.0})
    found = {name: [] for name in chosen}
    for _ in range(REPETITIONS):
        for name, law in chosen.items():
            begin = time.process_time()
            count = hw.run(long, law).summary["ticks"]
            found[name].append((time.process_time() - begin) / count * 1e9)
    return {name: min(values) for name, values in found.items()}


def many():
    x = np.geomspace(300, 1e5, CELLS[0])
    y = np.geomspace(0.1, 10.0, CELLS[1])
    press = hw.load("press")
    keys = ("wall.stiffness_n_per_m", "device.damping_n_s_per_m")
    ranges = ["--x", f"{keys[0]}=300:1e5:{CELLS[0]}:log", "--y", f"{keys[1]}=0.1:10:{CELLS[1]}:log"]
    return {
        "hapticwall map": lambda: subprocess.run(
            [os.environ["HAPTICWALL"], "map", "press", *ranges, "--algorithms", "energy-bounding", "--quiet"],
            check=True,
            capture_output=True,
        ),
        "map()": lambda: hw.map("press", x=(keys[0], x), y=(keys[1], y), algorithms=["energy-bounding"]),
        "batch()": lambda: hw.batch([press.replace({keys[0]: a, keys[1]: b}) for a in x for b in y]),
        "run() in a loop": lambda: [hw.run(press.replace({keys[0]: a, keys[1]: b})) for a in x for b in y],
    }


def main():
    chosen = {"built in": "energy-bounding", **laws.written()}
    found = {scene: ticks(scene, chosen) for scene in ("press", "golden-soft")}
    for name in chosen:
        press, soft = (found[scene][name] for scene in found)
        ratio = press / found["press"]["built in"]
        print(f"| {name} | {press:.0f} | {ratio:.2f} | {soft:.0f} |")
    for name, work in many().items():
        least = min(processor_s(work) for _ in range(7))
        print(f"{name}: {least:.2f} s of processor time for {CELLS[0] * CELLS[1]} runs")


if __name__ == "__main__":
    main()
