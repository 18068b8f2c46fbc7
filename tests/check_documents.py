#!/usr/bin/env python3
"""check_documents.py PROGRAM ROOT WORK [PYTHON MODULES]: runs the blocks of code of README, CONTRIBUTING,
docs/ and the module's README, and finds lines that are too long for a diff.

The words behind a fence say what a block is:
  sh               commands that end with status 0, in a folder that has the recording NAME.csv
  toml             a scene, or tables in the place of those of the scene `press`
  python           a script that goes on where the one before it on the page ended; without PYTHON, which
                   finds the module in the folder MODULES, text
  csv FILE         a file for the scenes of this page
  LANGUAGE WORD    WORD is a key of ELSEWHERE, or for another language the name that its own test uses
A block without words is text; one that looks like a command or like TOML is refused.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

# Why a block does not run here.
ELSEWHERE = {
    "pandas": "tests/python/experiment_test.py",
    "psychopy": "was tried by hand, with the version and the date on the page",
    "measured": "was tried by hand, with the versions and the date on the page",
    "sources": "builds the program",
    "ffmpeg": "takes ffmpeg, which is no dependency; docs/pictures/film.webp was made by these lines",
    "root": "needs another user's rights; ./dev test --hid-guest drives the emulator",
    "display": "opens the window; tests/app/ui/page/experiment_test.cpp plays these lists",
    "cluster": "takes 64 machines; tests/app/command/map_test.cpp joins parts of a map",
    "commands": "./dev test --adding-an-algorithm, -environment, -estimator and --adding-a-study",
    "long": "takes minutes; worst_hand_test.cpp and accuracy_hands_test.cpp try fewer hands",
    "settings": "tests/app/ui/window/settings_file_test.cpp",
    "rust": "takes rustc; tests/python/paper_law_test.py",
    "device-file": "tests/app/file/scene_device_test.cpp and dialect_file_test.cpp",
}
TIMEOUT_S = 240
LARGEST_GRID = 8
COLUMNS = 100


def blocks(text):
    """The words behind each fence, and the lines inside."""
    fence = None
    for line in text.splitlines():
        mark = re.match(r" *(```+)(.*)", line)
        if fence is None and mark:
            fence, words, lines = mark[1], mark[2].split(), []
        elif fence is not None and line.strip() == fence:
            yield words, "\n".join(lines) + "\n"
            fence = None
        elif fence is not None:
            lines.append(line)


def long_lines(text):
    """Numbers of the lines beyond COLUMNS, except tables and blocks of code."""
    fence = None
    for number, line in enumerate(text.splitlines(), 1):
        mark = re.match(r" *(```+)", line)
        if mark and fence is None:
            fence = mark[1]
        elif fence is not None:
            fence = None if line.strip() == fence else fence
        elif len(line) > COLUMNS and not line.lstrip().startswith("|"):
            yield number


def small(script):
    """Large maps take minutes: the same command with fewer values."""
    return re.sub(
        r"(?<=:)\d+(?=(:log)?(\s|$))", lambda count: str(min(int(count[0]), LARGEST_GRID)), script
    )


def complete(scene, root):
    """Tables without a device stand in for those of `press`."""
    if "[device]" in scene:
        return scene
    press = (root / "assets/scenes/press.toml").read_text(encoding="utf-8")
    parts = re.split(r"(?m)^(?=\[)", press)
    # An environment takes the place of the walls.
    given = scene + ("[[wall]]" if "[environment]" in scene else "")
    return "".join(part for part in parts if part.split("\n")[0] not in given) + scene


def run(work, script, shell=("sh", "-ec")):
    """The problem, or ""."""
    environment = {**os.environ, "PATH": f"{work}:{os.environ['PATH']}"}
    done = subprocess.run(
        [*shell, script], cwd=work, env=environment, capture_output=True, text=True, timeout=TIMEOUT_S
    )
    return "" if done.returncode == 0 else f"status {done.returncode}: {done.stderr}"


def run_python(work, text, python, modules):
    """The problem of all scripts of the page so far, or ""."""
    page = work / "page.py"
    with page.open("a", encoding="utf-8") as script:
        script.write(text)
    return run(work, str(page), ("env", f"PYTHONPATH={modules}", str(python)))


def leave_partial(work):
    """The recording as a kill leaves it: with half a row, under the names of an unfinished one."""
    for name in ("NAME.csv", "NAME.toml"):
        (work / name).rename(work / f"{name}.partial")
    with (work / "NAME.csv.partial").open("a", encoding="utf-8") as rows:
        rows.write("500,0.5,0.0")


def problem_of(words, text, work, root, python):
    if not words:
        looks_like_code = re.search(r"(?m)^ *((\./)?(hapticwall|dev) |\[\w+\]|\$ )", text)
        return "it looks like code; name its language" if looks_like_code else ""
    if words[0] == "csv":
        (work / words[1]).write_text(text, encoding="utf-8")
    elif len(words) > 1:
        known = words[0] not in ("sh", "toml", "python") or words[1] in ELSEWHERE
        return "" if known else f"no reason is known for '{words[1]}'"
    elif words[0] == "toml":
        (work / "page.toml").write_text(complete(text, root), encoding="utf-8")
        return run(work, "hapticwall run page.toml --duration 0.01")
    elif words[0] == "python":
        return run_python(work, text, *python) if python else ""
    elif words[0] == "sh":
        if "hapticwall recover" in text:
            leave_partial(work)
        return run(work, small(text))
    else:
        return f"the language '{words[0]}' is unknown"
    return ""


def prepared(work, program, root):
    """A new folder with the program, the sources and a recording."""
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    (work / "hapticwall").symlink_to(program)
    for folder in ("assets", "core", "device"):
        (work / folder).symlink_to(root / folder)
    problem = run(work, "hapticwall run press --csv NAME.csv --duration 0.5")
    if problem:
        sys.exit(problem)


def main():
    # Not resolved: the Python of a virtual environment is a link.
    program, root, work, *python = (pathlib.Path(argument).absolute() for argument in sys.argv[1:])
    first = [root / name for name in ("README.md", "CONTRIBUTING.md", "app/python/README.md")]
    pages = [*first, *sorted((root / "docs").rglob("*.md"))]
    ran, problems = 0, []
    for page in [*pages, root / "CHANGELOG.md", root / "site/api.md"]:
        for number in long_lines(page.read_text(encoding="utf-8")):
            problems.append(f"{page.relative_to(root)}:{number}: more than {COLUMNS} columns")
    for page in pages:
        prepared(work, program, root)
        # Scenes name files that the page shows further down.
        found = sorted(blocks(page.read_text(encoding="utf-8")), key=lambda block: block[0][:1] != ["csv"])
        for words, text in found:
            ran += words in (["sh"], ["toml"], ["python"])
            problem = problem_of(words, text, work, root, python)
            if problem:
                problems.append(f"{page.relative_to(root)}: {' '.join(words)} {problem}\n{text}")
    if ran < 10:
        problems.append(f"only {ran} blocks ran")
    sys.exit("\n".join(problems) or 0)


if __name__ == "__main__":
    main()
