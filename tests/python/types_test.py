import os
import pathlib
import re

import pytest
from mypy import api

import hapticwall

SCRIPT = (pathlib.Path(__file__).parent / "typed_script.py").read_text(encoding="utf-8")
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "assets/examples/python"
WRONG = ["hw.load(3)", 'hw.run("tap").sumary', 'scene["a"] = None']


@pytest.fixture(scope="module")
def problems(tmp_path_factory):
    """The problems of a path for mypy --strict."""
    os.environ["MYPYPATH"] = os.environ["PYTHONPATH"]
    cache = tmp_path_factory.mktemp("cache")

    def of(path):
        out, errors, _ = api.run(["--strict", f"--cache-dir={cache}", str(path)])
        return re.findall(r"(?m)^.*?:(\d+): error: (.*)$", out) + [line for line in errors.splitlines()]

    return of


def test_the_module_is_strictly_typed(problems):
    assert problems(pathlib.Path(hapticwall.__file__).parent) == []


@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.stem)
def test_an_example_is_strictly_typed(problems, example):
    """But for libraries that have no types themselves."""
    assert [text for _, text in problems(example) if "missing library stubs" not in text] == []


def test_of_a_script_only_wrong_lines_are_refused(problems, tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT + "\n".join(WRONG) + "\n", encoding="utf-8")
    begin = len(SCRIPT.splitlines())
    assert [int(line) - begin for line, _ in problems(tmp_path / "script.py")] == [1, 2, 3]
