#!/usr/bin/env python3
"""check.py SITE: fails when a link, an anchor or a picture of the built site leads nowhere.

Sphinx checks the links of the pages; this reads its result as a browser does. A link to another host is
checked for its form alone: the check needs no network.
"""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """The links and the anchors of one page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = set(), {""}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value is not None:
                self.links.add(value)
            elif name in ("id", "name"):
                self.anchors.add(value)


def problem_of(link, path, pages):
    """Why a browser that shows the page `path` cannot follow the link, or ""."""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme in ("http", "https"):
        return "" if "." in parts.netloc and not set(link) & set(" <>\"'`") else "no address"
    if parts.scheme or parts.netloc:
        return "" if parts.scheme in ("data", "mailto") else f"the scheme '{parts.scheme}'"
    target = path
    if parts.path:
        target = (path.parent / urllib.parse.unquote(parts.path)).resolve()
    if not target.is_file():
        return "no such file"
    anchor = urllib.parse.unquote(parts.fragment)
    if target in pages and anchor not in pages[target].anchors:
        return "no such anchor"
    return ""


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    links, problems = 0, []
    for path, page in pages.items():
        for link in sorted(page.links):
            links += 1
            problem = problem_of(link, path, pages)
            if problem:
                problems.append(f"{path.relative_to(site)}: {link}: {problem}")
    print(f"{len(pages)} pages, {links} links")
    sys.exit("\n".join(problems) or 0)


if __name__ == "__main__":
    main()
