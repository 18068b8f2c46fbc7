"""The site of docs/, README and the Python module, by Sphinx with MyST: `./dev site`.

The pages stay as a code host shows them. The menu and the entry of the page about Python's names are
added here, as the pages are read.
"""

import pathlib
import re
import shutil

from pygments.lexers.special import TextLexer
from sphinx import addnodes

ROOT = pathlib.Path(__file__).resolve().parent.parent

project = "Haptic Wall"
author = copyright = "The Haptic Wall developers"  # noqa: A001
release = re.search(r"project\(hapticwall VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]

extensions = ["myst_parser", "sphinx.ext.autodoc"]
root_doc = "README"
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/**.md", "site/api.md"]
exclude_patterns = ["build", ".*", "[act]*/**"]  # folders that hold no page are not searched

html_theme = "furo"
html_title = f"Haptic Wall {release}"
html_favicon = "../assets/desktop/org.hapticwall.hapticwall.svg"
html_copy_source = False
html_show_sphinx = False
highlight_language = "none"
default_role = "code"  # docstrings quote as Markdown does

myst_heading_anchors = 6  # the anchors of headings are those of code hosts

autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True, "undoc-members": True}
autodoc_preserve_defaults = True

# A page in no group fails the build.
MENU = {
    "Start": [
        "docs/window",
        "docs/browser",
        "docs/command-line",
        "docs/film",
        "docs/study",
        "docs/sessions",
        "docs/experiments",
    ],
    "Walls and hands": [
        "docs/physics",
        "docs/algorithms/README",
        "docs/environments",
        "docs/estimators",
        "docs/hands",
        "docs/measured-hands",
        "docs/verdicts",
        "docs/accuracy",
        "docs/maps",
        "docs/worst-hand",
    ],
    "Devices": [
        "docs/device",
        "docs/feel-without-a-device",
        "docs/identify",
        "docs/real-loops",
        "docs/realtime",
        "docs/safety",
        "docs/dialects",
        "docs/wheels",
        "docs/hid-protocol",
        "docs/hardware-test-plan",
    ],
    "Python and data": [
        "docs/python",
        "site/api",
        "docs/clusters",
        "docs/from-a-paper-to-a-law",
        "docs/plugins",
        "docs/recording",
        "docs/streams",
    ],
    "Development": [
        "CONTRIBUTING",
        "docs/architecture",
        "docs/adding-an-algorithm",
        "docs/adding-an-environment",
        "docs/adding-an-estimator",
        "docs/adding-a-study",
        "docs/dependencies",
        "docs/performance",
        "CHANGELOG",
    ],
}


def add_menu(app, page, source):
    """Appends the menu, which only the site has, to the page that stands first."""
    groups = MENU if page == "README" else {}
    if page == "docs/algorithms/README":
        names = sorted(path.stem for path in (ROOT / "docs/algorithms").glob("[a-z]*.md"))
        groups = {"Algorithms": [f"docs/algorithms/{name}" for name in names]}
    for caption, pages in groups.items():
        places = "\n".join(f"/{place}" for place in pages)
        source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n{places}\n```\n"


def lead_to_page(app, page, source):
    """*Try it* opens the page for browsers where the site has it, and its description elsewhere."""
    if page == "README" and (ROOT / "build/web/page/index.html").is_file():
        before, after = source[0].split("**[Try it in a browser](docs/browser.md)**")
        source[0] = f'{before}<a href="try/index.html"><strong>Try it in a browser</strong></a>{after}'


def unlink_folders(app, page):
    """A link to a folder of the sources, which the site lacks, becomes text."""
    here = pathlib.Path(page["source"]).parent
    for link in list(page.findall(addnodes.pending_xref)):
        if (here / link["reftarget"]).is_dir():
            link.replace_self(link.children)


def mark_code(app, kind, name, value, options, lines):
    """An indented block of a docstring is code, as in Markdown."""
    if lines[:1] == ["Structure/Union member"]:  # ctypes says no more
        lines.clear()
    starts = [
        at
        for at in range(2, len(lines))
        if lines[at].startswith("    ") and not lines[at - 1] and not lines[at - 2].startswith("    ")
    ]
    for at in reversed(starts):
        lines[at:at] = ["::", ""]


def write_first_page(app, problem):
    """A server of files opens index.html."""
    if problem is None and app.builder.format == "html":
        shutil.copyfile(app.outdir / "README.html", app.outdir / "index.html")


def setup(app):
    for language in ("csv", "hex"):
        app.add_lexer(language, TextLexer)
    app.connect("source-read", add_menu)
    app.connect("source-read", lead_to_page)
    app.connect("doctree-read", unlink_folders)
    app.connect("autodoc-process-docstring", mark_code)
    app.connect("build-finished", write_first_page)
