"""The source distribution, and the module in a bare environment. `./dev wheels` builds and tries wheels."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import venv

import numpy
import pytest
from scikit_build_core.build import build_sdist

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """The unpacked source distribution."""
    folder = tmp_path_factory.mktemp("sources")
    here = pathlib.Path.cwd()
    os.chdir(ROOT)
    try:
        name = build_sdist(str(folder))
    finally:
        os.chdir(here)
    subprocess.run(["tar", "-xzf", folder / name, "-C", folder], check=True)
    return folder / name.removesuffix(".tar.gz")


def test_the_source_distribution_has_the_module_alone(sources):
    files = [path.relative_to(sources) for path in sources.rglob("*") if path.is_file()]
    for wanted in ("CMakeLists.txt", "LICENSE", "PKG-INFO", "app/python/module.cpp", "core/scene.h"):
        assert pathlib.Path(wanted) in files
    folders = {path.parts[0] for path in files if len(path.parts) > 1}
    assert folders == {"app", "assets", "cmake", "core", "device", "docs"}
    assert not [path for path in files if "test" in path.name and "python-tests" not in path.name]
    assert len(files) < 500


def quoted_includes(path):
    return re.findall(r'(?m)^\s*#\s*include\s+"([^"]+)"', path.read_text(encoding="utf-8"))


def test_the_source_distribution_has_every_file_that_is_compiled(sources, tmp_path):
    """CMake lists the sources; their #include lines lead to the headers. `./dev wheels` compiles them."""
    subprocess.run(
        ["cmake", "-S", sources, "-B", tmp_path, "-G", "Ninja", "-DHAPTICWALL_PROGRAM=OFF"]
        + ["-DHAPTICWALL_PYTHON_MODULE=ON", f"-DPython_EXECUTABLE={sys.executable}"],
        check=True,
        capture_output=True,
    )
    commands = json.loads((tmp_path / "compile_commands.json").read_text(encoding="utf-8"))
    found, left = set(), [pathlib.Path(command["file"]) for command in commands]
    left = [path for path in left if path.suffix != ".S"]
    while left:
        path = left.pop()
        if path in found:
            continue
        assert path.is_file(), path
        found.add(path)
        for name in quoted_includes(path):
            if name.startswith(("/", "app/", "core/", "device/")):
                left.append(sources / name)  # an absolute name stays as it is
    assert sources / "app/python/module.cpp" in found and sources / "core/scene.h" in found
    assert len(found) > 200


def test_the_readme_of_the_package_links_nowhere(sources):
    """A package index shows it without the files beside it."""
    assert "](" not in (sources / "app/python/README.md").read_text(encoding="utf-8")
    assert "# Haptic Wall for Python" in (sources / "PKG-INFO").read_text(encoding="utf-8")


def test_the_module_needs_numpy_alone(tmp_path):
    venv.create(tmp_path / "bare", with_pip=False)
    python = tmp_path / "bare/bin/python"
    packages = next((tmp_path / "bare/lib").glob("python*/site-packages"))
    shutil.copytree(pathlib.Path(os.environ["PYTHONPATH"]) / "hapticwall", packages / "hapticwall")
    for name in ("numpy", "numpy.libs"):
        (packages / name).symlink_to(pathlib.Path(numpy.__file__).parent.parent / name)
    script = (ROOT / "tests/package/try_module.py").read_text(encoding="utf-8")
    script = script[: script.index("files = importlib")]  # the rest is about a wheel
    subprocess.run([python, "-I", "-c", script], check=True, cwd=tmp_path)
