"""Paths of files, as the core takes them."""

from __future__ import annotations

import os
from typing import TypeAlias

Path: TypeAlias = str | os.PathLike[str]


def path_text(path: Path) -> str:
    text = os.fspath(path)
    if not isinstance(text, str):
        raise TypeError(f"a path is a str or a pathlib.Path, not {path!r}")
    if "\0" in text:
        raise ValueError(f"a path takes no null character: {text!r}")
    return text


def file_text(path: Path) -> str:
    """The path of a file that can be opened, else OSError."""
    text = path_text(path)
    with open(text, "rb"):
        return text


def name_or_file(name_or_path: Path, signs: str) -> str:
    """A name, or the path of a file that can be opened. A str is a path if it has one of these signs."""
    text = path_text(name_or_path)
    if isinstance(name_or_path, str):
        return file_text(text) if any(sign in text for sign in signs) else text
    return file_text(os.path.join(os.curdir, text))  # with a "/": it is no name
