"""tests/package/release_notes, and the files that the workflow of a release names."""

import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def notes(root, tag="v1.2.3"):
    return subprocess.run(
        [ROOT / "tests/package/release_notes", tag, root], capture_output=True, text=True
    )


@pytest.fixture
def sources(tmp_path):
    """The files of a version that is ready."""
    (tmp_path / "CMakeLists.txt").write_text('project(hapticwall VERSION 1.2.3 DESCRIPTION "x")\n')
    (tmp_path / "CITATION.cff").write_text("title: x\nversion: 1.2.3\ndate-released: 2027-01-02\n")
    (tmp_path / "CHANGELOG.md").write_text(
        "# Changelog\n\n## 1.2.3 (2027-01-02)\n\nNew.\n\n### Added\n\n* More.\n\n## 1.2.2 (2026-01-02)\n\nOld.\n"
    )
    return tmp_path


def test_a_version_that_is_ready_gives_its_section(sources):
    done = notes(sources)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "New.\n\n### Added\n\n* More.\n\n"


@pytest.mark.parametrize(
    "file, old, new, told",
    [
        ("CMakeLists.txt", "1.2.3", "1.2.4", "CMakeLists.txt has version 1.2.4"),
        ("CITATION.cff", "1.2.3", "1.2.2", "CITATION.cff has another version"),
        ("CITATION.cff", "date-released: 2027-01-02\n", "", "CITATION.cff has no date"),
        ("CHANGELOG.md", "2027-01-02", "unreleased", "write '## 1.2.3 (YYYY-MM-DD)'"),
        ("CHANGELOG.md", "## 1.2.3", "## 1.2.2", "write '## 1.2.3 (YYYY-MM-DD)'"),
    ],
)
def test_a_version_that_is_not_ready_is_refused(sources, file, old, new, told):
    text = (sources / file).read_text()
    (sources / file).write_text(text.replace(old, new))
    done = notes(sources)
    assert done.returncode != 0
    assert told in done.stderr
    assert done.stdout == ""


def test_the_workflow_calls_commands_that_exist():
    yaml = pytest.importorskip("yaml")
    steps = yaml.safe_load((ROOT / ".github/workflows/release.yml").read_text())["jobs"]
    text = str(steps)
    known = (ROOT / "dev").read_text()
    commands = re.findall(r"\./dev (\w+)", text)
    assert set(commands) == {"package", "wheels", "test", "web", "site"}
    for command in commands:
        assert re.search(rf"^    {command}\) ", known, re.MULTILINE), command
    for script in re.findall(r"tests/\w+/\w+", text):
        assert (ROOT / script).is_file(), script
