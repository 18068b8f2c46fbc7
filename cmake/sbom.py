#!/usr/bin/env python3
"""sbom.py PROGRAM: what the program is made of, as SPDX 2.3 (JSON), on standard output.

Names, licences and home pages are those of the first table of docs/dependencies.md; versions and
checksums are those of this machine's packages and of cmake/gui-sources.txt. Ends with 1, and says so,
where a package is not installed, or where the program is linked against something that the table
leaves out.
"""

import datetime
import hashlib
import json
import pathlib
import re
import subprocess
import sys

# The C and C++ runtime, which comes with every system.
TOOLCHAIN = {"glibc", "gcc-12", "gcc-13", "gcc-14", "gcc-15"}
COLUMNS = 6


class Missing(Exception):
    """Something that the list would be wrong without."""


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def rows(text):
    """The rows of the table `Part of the program`: name, home page, packages, licence."""
    table = text.split("## Part of the program", 1)[1].split("\n## ", 1)[0].split("\n### ", 1)[0]
    for line in table.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        link = re.match(r"\[(.+?)\]\((.+?)\)", cells[0])
        if len(cells) == COLUMNS and link:
            yield link[1], link[2], re.findall(r"`(.+?)`", cells[1]), cells[4].split()[0]


def installed(package):
    """Version and source package."""
    try:
        status, version, source = output(
            "dpkg-query", "-W", "-f=${db:Status-Status} ${Version} ${source:Package}", package
        ).split()
    except subprocess.CalledProcessError as problem:
        raise Missing(f"{package} is not installed") from problem
    if status != "installed":
        raise Missing(f"{package} is not installed")
    return version, source


def pinned(text):
    """The source distribution that no package has: name, version, SHA-256."""
    return re.search(r"^([\w-]+)==([\d.]+) --hash=sha256:([0-9a-f]{64})$", text, re.MULTILINE).groups()


def identifier(name):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.]+", "-", name)


def entry(name, version, licence, home):
    return {
        "name": name,
        "SPDXID": identifier(name),
        "versionInfo": version,
        "licenseDeclared": licence,
        "licenseConcluded": "NOASSERTION",
        "copyrightText": "NOASSERTION",
        "downloadLocation": "NOASSERTION",
        "homepage": home,
        "filesAnalyzed": False,
    }


def reference(locator):
    return [
        {
            "referenceCategory": "PACKAGE-MANAGER",
            "referenceType": "purl",
            "referenceLocator": locator,
        }
    ]


def distribution_name():
    return output("sh", "-c", ". /etc/os-release && echo $ID")


def packaged(name, home, packages, licence):
    version, source = installed(packages[0])
    found = entry(name, version, licence, home)
    found["externalRefs"] = reference(f"pkg:deb/{distribution_name()}/{source}@{version}")
    return found, {installed(package)[1] for package in packages}


def from_sources(name, home, licence, distribution):
    project, version, sha256 = distribution
    found = entry(name, f"of {project} {version}", licence, home)
    found["checksums"] = [{"algorithm": "SHA256", "checksumValue": sha256}]
    found["externalRefs"] = reference(f"pkg:pypi/{project}@{version}")
    return found


def linked(program):
    """Source packages of the libraries that the program names."""
    for library in re.findall(r"\(NEEDED\).*\[(.+?)\]", output("readelf", "-d", program)):
        places = output("dpkg", "-S", f"*/{library}").splitlines()
        yield library, installed(places[0].split(": ")[0])[1]


def our_own(program):
    name, version = output(program, "--version").split()[:2]
    found = entry(name, version, "MIT", "NOASSERTION")
    found["checksums"] = [
        {"algorithm": "SHA256", "checksumValue": hashlib.sha256(program.read_bytes()).hexdigest()}
    ]
    return found


def time_of_commit(root):
    seconds = int(output("git", "-C", str(root), "log", "-1", "--format=%ct"))
    return datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")


def document(program, root):
    ours = our_own(program)
    distribution = pinned((root / "cmake/gui-sources.txt").read_text(encoding="utf-8"))
    parts, sources = [], set(TOOLCHAIN)
    for name, home, packages, licence in rows((root / "docs/dependencies.md").read_text(encoding="utf-8")):
        if packages:
            found, its_sources = packaged(name, home, packages, licence)
            sources |= its_sources
        else:
            found = from_sources(name, home, licence, distribution)
        parts.append(found)
    unlisted = [f"{library} ({source})" for library, source in linked(program) if source not in sources]
    if unlisted:
        raise Missing("docs/dependencies.md does not list " + ", ".join(unlisted))
    relation = {"spdxElementId": ours["SPDXID"], "relationshipType": "DEPENDS_ON"}
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"{ours['name']} {ours['versionInfo']}",
        "documentNamespace": "urn:sha256:" + ours["checksums"][0]["checksumValue"],
        "creationInfo": {
            # Of the commit: the same list for the same program.
            "created": time_of_commit(root),
            "creators": ["Tool: hapticwall sbom.py"],
        },
        "packages": [ours, *parts],
        "relationships": [
            {
                "spdxElementId": "SPDXRef-DOCUMENT",
                "relationshipType": "DESCRIBES",
                "relatedSpdxElement": ours["SPDXID"],
            },
            *({**relation, "relatedSpdxElement": part["SPDXID"]} for part in parts),
        ],
    }


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    try:
        json.dump(document(pathlib.Path(sys.argv[1]).resolve(), root), sys.stdout, indent=2)
    except Missing as problem:
        sys.exit(f"error: {problem}")
    print()


if __name__ == "__main__":
    main()
