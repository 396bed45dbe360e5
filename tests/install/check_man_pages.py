#!/usr/bin/env python3
"""The manual pages: without a warning of man and mandoc, and as complete as --help.

    check_man_pages.py HOWL HOWL_RIG

Exit status 77 (skipped) where neither man nor mandoc is installed.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def output(*words, **options):
    return subprocess.run(words, check=True, capture_output=True, text=True, **options).stdout


def pages(howl, rig):
    """(name, source, what --help says) of each."""
    yield "howl", output(howl, "help", "man"), output(howl, "--help")
    for command in output(howl, "help", "commands").split():
        yield f"howl-{command}", output(howl, "help", "man", command), output(howl, "help", command)
    yield "howl_rig", output(rig, "--man"), output(rig, "--help")


def warnings(path):
    """What the tools that are here find wrong with the page; style, such as long lines, is none."""
    environment = dict(os.environ, LC_ALL="C.UTF-8", MANROFFSEQ="", MANWIDTH="100")
    tools = [["mandoc", "-Tlint", "-Wwarning", path], ["man", "--warnings", "-l", "-E", "UTF-8", "-Tutf8", "-Z", path]]
    for words in tools:
        if shutil.which(words[0]):
            run = subprocess.run(words, capture_output=True, text=True, env=environment)
            found = run.stderr + (run.stdout if words[0] == "mandoc" else "")
            if run.returncode != 0 or found:
                yield f"{words[0]}: {found.strip() or run.returncode}"


def shown(path):
    """The page as a reader sees it, blanks of any width alike."""
    if shutil.which("mandoc"):
        text = output("mandoc", "-Tutf8", "-Owidth=1000", path)
    else:
        text = output("man", "-l", "-E", "UTF-8", path, env=dict(os.environ, MANWIDTH="1000", MANPAGER="cat"))
    return re.sub(r"\s+", " ", re.sub(r".\x08", "", text)).replace("\u2019", "'").replace("`", "")


def plain(text):
    return re.sub(r"\s+", " ", text).replace("`", "").strip()


def main():
    howl, rig = sys.argv[1:3]
    if not shutil.which("mandoc") and not shutil.which("man"):
        print("skipped: neither man nor mandoc is installed")
        return SKIPPED
    faults = []
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, source, said in pages(howl, rig):
            count += 1
            path = os.path.join(folder, f"{name}.1")
            with open(path, "w", encoding="utf-8") as file:
                file.write(source)
            faults += [f"{name}: {warning}" for warning in warnings(path)]
            page = shown(path)
            if not re.search(rf"NAME {name} [-\u2013\u2014] \w", page):
                faults.append(f"{name}: the section NAME does not begin with the name")
            options = re.findall(r"^  (--\S+(?: \S+)?) +(\S.*)$", said, re.M)
            if not options:
                faults.append(f"{name}: --help lists no option")
            for option, text in options:
                if plain(f"{option.split()[0]}") not in page or plain(text) not in page:
                    faults.append(f"{name}: {option} {text}: not on the page")
            if name not in ("howl", "howl_rig"):
                details = said.split("\n\n")[1]
                if plain(details) not in page:
                    faults.append(f"{name}: not on the page: {details}")
    for fault in faults:
        print(fault)
    print(f"{count} manual pages, {len(faults)} faults")
    return 1 if faults or count < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
