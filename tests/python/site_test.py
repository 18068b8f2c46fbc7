"""The site of README, docs/ and the module's docstrings (`./dev site`)."""

import os
import pathlib
import shutil
import subprocess
import sys

import hapticwall as hw

ROOT = pathlib.Path(__file__).resolve().parents[2]


def built(folder, root=ROOT):
    return subprocess.run(
        [ROOT / "site/build", sys.executable, os.environ["PYTHONPATH"], folder, root],
        capture_output=True,
        text=True,
    )


def checked(folder):
    return subprocess.run(
        [sys.executable, ROOT / "site/check.py", folder], capture_output=True, text=True
    )


def copied(folder):
    """What the site is built from, to be spoilt."""
    folder.mkdir()
    for name in ("docs", "site"):
        shutil.copytree(ROOT / name, folder / name)
    for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md"):
        shutil.copy(ROOT / name, folder)
    for name in ("CMakeLists.txt", "LICENSE", "app", "assets", "core", "device"):
        (folder / name).symlink_to(ROOT / name)
    return folder


def append(path, text):
    with path.open("a", encoding="utf-8") as page:
        page.write(text)


def test_the_site_has_every_page_and_every_name_of_the_module(tmp_path):
    done = built(tmp_path / "site")
    assert done.returncode == 0, done.stderr
    for page in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]:
        assert (tmp_path / "site" / page.relative_to(ROOT)).with_suffix(".html").is_file(), page
    names = (tmp_path / "site/site/api.html").read_text(encoding="utf-8")
    for name in hw.__all__:
        assert f'id="hapticwall.{name}"' in names, name
    first = (tmp_path / "site/index.html").read_text(encoding="utf-8")
    assert "docs/window.html" in first


def test_a_broken_link_fails_the_build(tmp_path):
    root = copied(tmp_path / "root")
    append(root / "README.md", "\n[page](docs/no-page.md)\n")
    append(root / "docs/python.md", "\n[anchor](maps.md#no-anchor)\n")
    append(root / "docs/maps.md", "\n[folder](../assets/no-folder)\n")
    append(root / "docs/hands.md", "\n![picture](pictures/no-picture.png)\n")
    (root / "docs/no-menu.md").write_text("# In no menu\n", encoding="utf-8")
    done = built(tmp_path / "site", root)
    assert done.returncode != 0
    for place in ("docs/no-page.md", "no-anchor", "no-folder", "no-picture.png", "docs/no-menu.md"):
        assert place in done.stderr, done.stderr


def test_the_check_of_a_site_finds_what_leads_nowhere(tmp_path):
    (tmp_path / "b.html").write_text('<p id="here"></p>', encoding="utf-8")
    links = ["b.html#here", "b.html#gone", "c.html", "https://example.org/a", "https://no host/", "ftp://a.b"]
    page = "".join(f'<a href="{link}"></a>' for link in links)
    (tmp_path / "a.html").write_text(page, encoding="utf-8")
    assert checked(tmp_path).stderr.splitlines() == [
        "a.html: b.html#gone: no such anchor",
        "a.html: c.html: no such file",
        "a.html: ftp://a.b: the scheme 'ftp'",
        "a.html: https://no host/: no address",
    ]
