#!/usr/bin/env python3
"""tidy.py BUILD_FOLDER CACHE_FOLDER FILE...: clang-tidy over files, on all cores.

Skips files that were clean before and have not changed since. The key is the SHA-256 of the
preprocessed text, the settings and clang-tidy's version. The exit status is 1 after findings.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys

OURS_ONLY = [
    "--quiet",
    "--extra-arg=-Wno-unknown-warning-option",
    "--extra-arg=-Wno-ignored-optimization-argument",
]


def compile_commands(build):
    with open(build / "compile_commands.json", encoding="utf-8") as file:
        return {entry["file"]: entry for entry in json.load(file)}


def preprocessed(entry):
    """The text that the compiler sees."""
    command = shlex.split(entry["command"])
    compiler = next(i for i, word in enumerate(command) if word.endswith(("c++", "g++", "clang++")))
    command = command[compiler:]
    out = command.index("-o")
    del command[out : out + 2]
    command[command.index("-c")] = "-E"
    for option in ("-MD", "-P"):
        while option in command:
            command.remove(option)
    for option in ("-MT", "-MF"):
        if option in command:
            at = command.index(option)
            del command[at : at + 2]
    # __FILE__ without the path of the checkout.
    command[1:1] = ["-P", f"-fmacro-prefix-map={pathlib.Path.cwd().resolve()}="]
    return subprocess.run(command, cwd=entry["directory"], capture_output=True, check=True).stdout


def nested_settings(file):
    """The text of the .clang-tidy files in the folders between the file and the root."""
    root = pathlib.Path.cwd().resolve()
    folders = [folder for folder in pathlib.Path(file).parents if root in folder.parents]
    return b"".join(
        (folder / ".clang-tidy").read_bytes()
        for folder in folders
        if (folder / ".clang-tidy").exists()
    )


def key_of(entry, settings):
    digest = hashlib.sha256(settings)
    digest.update(nested_settings(entry["file"]))
    digest.update(preprocessed(entry))
    # Comments can disable a check.
    digest.update(pathlib.Path(entry["file"]).read_bytes())
    return digest.hexdigest()


def check(name, entry, build, cache, settings):
    """The findings of clang-tidy; empty for a clean file."""
    if entry is None:
        return ""  # compiled by no target of this build
    try:
        known = cache / key_of(entry, settings)
    except (subprocess.CalledProcessError, ValueError, StopIteration) as problem:
        return f"{name}: cannot be preprocessed: {problem}\n"
    if known.exists():
        return ""
    run = subprocess.run(
        ["clang-tidy", *OURS_ONLY, "-p", str(build), name], capture_output=True, text=True, check=False
    )
    if run.returncode == 0 and not run.stdout.strip():
        known.touch()
        return ""
    return run.stdout or f"{name}: clang-tidy ended with {run.returncode}\n{run.stderr}"


def main():
    build, cache, *files = sys.argv[1:]
    build, cache = pathlib.Path(build), pathlib.Path(cache)
    cache.mkdir(parents=True, exist_ok=True)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    settings = version + pathlib.Path(".clang-tidy").read_bytes()
    commands = compile_commands(build)
    found = False
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [
            pool.submit(check, name, commands.get(os.path.realpath(name)), build, cache, settings)
            for name in files
        ]
        for job in concurrent.futures.as_completed(jobs):
            text = job.result()
            found = found or bool(text)
            sys.stdout.write(text)
            sys.stdout.flush()
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
