#!/usr/bin/env python3
"""Builds the documentation's site as mkdocs.yml says, every warning an error.

    check_site.py PROJECT

Fails where a link, an anchor or a picture leads nowhere, where a page is missing from the navigation,
where a command has no page of its own, where README.md links to what is not there, or where a page names a
source file that is not there (names with a placeholder in capitals, such as NAME, are passed over). Exit
status 77 (skipped) where mkdocs, its theme or its extensions are not installed.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def anchors(page):
    """The names that a built page can be entered at."""
    return set(re.findall(r'\bid="([^"]+)"', page.read_text(encoding="utf-8")))


def broken_anchors(site):
    """Links within the site whose #name the page they lead to does not have."""
    for page in sorted(site.rglob("*.html")):
        if page.name == "404.html":
            continue
        for link in re.findall(r'<a [^>]*href="([^"]+)"', page.read_text(encoding="utf-8")):
            if "#" not in link or re.match(r"\w+:", link):
                continue
            path, name = link.split("#", 1)
            target = (page.parent / path).resolve() if path else page
            if target.is_dir():
                target /= "index.html"
            if name and target.suffix == ".html" and target.exists() and name not in anchors(target):
                yield f"{page.relative_to(site)}: {link}: no such place on that page"


def missing_files(project):
    """Files of the tree that a page names and that are not there: `model/loop/acoustics.h`."""
    folders = "app|bench|cmake|configs|diagnosis|docs|estimation|io|model|results|rig|tests|trial"
    named = re.compile(rf"`((?:{folders})/[\w./-]+\.\w+)`")
    pages = [project / "README.md", project / "CONTRIBUTING.md"]
    for page in pages + sorted((project / "docs").rglob("*.md")):
        for number, line in enumerate(page.read_text(encoding="utf-8").split("\n"), 1):
            for path in named.findall(line):
                if not re.search(r"NAME", path) and not (project / path).exists():
                    yield f"{page.relative_to(project)}:{number}: {path}: no such file"


def faults_of_the_tree(project):
    yield from missing_files(project)
    registry = "app/command_line/command.h"
    commands = re.findall(r"^  X\((\w+)\)", (project / registry).read_text(encoding="utf-8"), re.MULTILINE)
    if not commands:
        yield f"{registry}: no commands found"
    readme = (project / "README.md").read_text(encoding="utf-8")
    navigation = (project / "mkdocs.yml").read_text(encoding="utf-8")
    for command in (name.lower() for name in commands):
        page = f"{command}.md"
        if not (project / "docs" / page).exists():
            yield f"docs/{page}: the command has no page"
        if f"docs/{page}" not in readme:
            yield f"README.md: the command {command} is not in it"
    for page in sorted((project / "docs").rglob("*.md")):
        if str(page.relative_to(project / "docs")) not in navigation:
            yield f"mkdocs.yml: {page.name} is not in the navigation"
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", readme):
        if not re.match(r"\w+:", link) and not (project / link).exists():
            yield f"README.md: {link}: no such file"


def main():
    project = pathlib.Path(sys.argv[1]).resolve()
    faults = list(faults_of_the_tree(project))
    for fault in faults:
        print(fault)
    if faults:
        return 1
    mkdocs = shutil.which("mkdocs")
    if mkdocs is None:
        skip("mkdocs is not installed (Debian: mkdocs mkdocs-material)")
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder) / "site"
        done = subprocess.run([mkdocs, "build", "--strict", "--config-file", project / "mkdocs.yml",
                               "--site-dir", site], text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            lacks = re.search(r"Unrecognised theme name.*|Failed to load extension.*|No module named.*",
                              done.stdout)
            if lacks:
                skip(lacks[0])
            print(done.stdout)
            return 1
        faults = list(broken_anchors(site))
        for fault in faults:
            print(fault)
        print(f"{len(list(site.rglob('index.html')))} pages, {len(faults)} broken links")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
