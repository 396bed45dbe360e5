#!/usr/bin/env python3
"""Runs the examples of README.md and docs/ and compares what they print with what the pages show.

    check_examples.py HOWL PROJECT [--update] [--only PAGE] [--without WORD ...]

An example is an indented block that begins with `$ build/howl ...`; further lines with `$` run after
it, and what follows is what the last of them prints. A line `...` stands for any lines. Numbers may differ by two
units of their last digit, and by two percent; all other text has to be as it is. --update writes what
the program prints now into the pages: all of it, or where the block has lines `...` line for line what is
found again.
Examples whose config is not in configs/, or whose records are not on this machine, are passed over,
saying so. Exit status 1 where a page shows what the program does not say.
"""

import argparse
import difflib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
INDENT = "    "


def examples(lines):
    """(first line, end, commands) of each block; the shown lines follow the commands."""
    i = 0
    while i < len(lines):
        if not lines[i].startswith(INDENT + "$ build/howl"):
            i += 1
            continue
        start, commands = i, []
        while i < len(lines) and lines[i].startswith(INDENT + "$ "):
            commands.append(lines[i][len(INDENT) + 2:].split(" #")[0].strip())
            i += 1
        first = i
        while i < len(lines) and (lines[i].startswith(INDENT)
                                  or (not lines[i].strip() and i + 1 < len(lines)
                                      and lines[i + 1].startswith(INDENT)
                                      and not lines[i + 1].startswith(INDENT + "$ "))):
            i += 1
        yield start, first, i, commands


def last_digit(text):
    mantissa = text.lower().split("e")[0]
    decimals = len(mantissa.split(".")[1]) if "." in mantissa else 0
    exponent = int(text.lower().split("e")[1]) if "e" in text.lower() else 0
    return 10.0 ** (exponent - decimals)


def same(shown, printed):
    """Text as it is, blanks between columns apart; numbers to two units of the last digit or 2 %."""
    if re.sub(r"\s+", " ", NUMBER.sub("#", shown)).strip() != re.sub(
            r"\s+", " ", NUMBER.sub("#", printed)).strip():
        return False
    for a, b in zip(NUMBER.findall(shown), NUMBER.findall(printed)):
        allowed = max(2.0 * max(last_digit(a), last_digit(b)), 0.02 * abs(float(a)))
        if abs(float(a) - float(b)) > allowed:
            return False
    return True


def segments(shown):
    """Runs of shown lines between the lines `...`, by their first index."""
    run, first = [], 0
    for i, line in enumerate(shown + ["..."]):
        if line.strip() == "...":
            if run:
                yield first, run
            run = []
            continue
        if not run:
            first = i
        run.append(line)


def misses(shown, printed):
    """The first shown line that the program does not print where it should, or None."""
    at = 0
    anchored = True  # the block begins where the output does
    for first, run in segments(shown):
        anchored = first == 0
        places = [at] if anchored else range(at, len(printed) - len(run) + 1)
        best = 0
        for place in places:
            length = 0
            while (length < len(run) and place + length < len(printed)
                   and same(run[length], printed[place + length])):
                length += 1
            if length == len(run):
                at = place + length
                break
            best = max(best, length)
        else:
            return run[best]
    return None


def updated(shown, printed):
    if not any(line.strip() == "..." for line in shown):
        return printed
    result = list(shown)
    at = 0
    for first, run in segments(shown):
        def likeness(place):
            return sum(difflib.SequenceMatcher(None, NUMBER.sub("#", a), NUMBER.sub("#", b)).ratio()
                       for a, b in zip(run, printed[place:place + len(run)])) / len(run)
        places = [0] if first == 0 else range(at, max(len(printed) - len(run), at) + 1)
        place = max(places, key=likeness)
        for k in range(len(run)):
            if place + k < len(printed):
                result[first + k] = printed[place + k]
        at = place + len(run)
    return result


def missing_config(commands, project):
    for command in commands:
        for word in command.split():
            if not word.endswith(".yaml") or word.startswith("out/"):
                continue
            path = project / word
            if not path.exists():
                return f"{word} is the reader's own"
            for variable in re.findall(r"\$\{(\w+)\}", path.read_text(encoding="utf-8")):
                if variable not in os.environ:
                    return f"{variable} is not set"
    return None


def run(howl, commands, folder):
    printed = []
    for command in commands:
        arguments = re.findall(r'"[^"]*"|\S+', command)[1:]
        done = subprocess.run([howl] + [a.strip('"') for a in arguments], cwd=folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
        printed = done.stdout.split("\n")[:-1]
    return printed


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("howl")
    parser.add_argument("project", type=pathlib.Path)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--only", help="a page, by its name")
    parser.add_argument("--without", action="append", default=[], help="commands with this word")
    options = parser.parse_args()
    failed = compared = 0
    pages = [options.project / "README.md"] + sorted((options.project / "docs").rglob("*.md"))
    with tempfile.TemporaryDirectory() as folder:
        for name in ("configs", "results"):
            os.symlink(options.project.resolve() / name, pathlib.Path(folder) / name)
        for page in pages:
            if options.only and page.name != options.only:
                continue
            lines = page.read_text(encoding="utf-8").split("\n")
            edits = []
            for start, first, end, commands in examples(lines):
                place = f"{page.name}:{start + 1}: {'; '.join(commands)}"
                left_out = missing_config(commands, options.project)
                for word in options.without:
                    if any(word in command.split() for command in commands):
                        left_out = f"without {word}"
                if left_out:
                    print(f"passed over: {place}: {left_out}")
                    continue
                printed = run(str(pathlib.Path(options.howl).resolve()), commands, folder)
                shown = [line[len(INDENT):] for line in lines[first:end]]
                compared += 1
                if options.update:
                    edits.append((first, end, [(INDENT + line).rstrip() for line in
                                               updated(shown, printed)]))
                    continue
                missed = misses(shown, printed)
                if missed is not None:
                    failed += 1
                    print(f"{place}\n  shows:  {missed}\n  prints: "
                          + "\n          ".join(printed[:60]))
            changed = list(lines)
            for first, end, new in reversed(edits):
                changed[first:end] = new
            if changed != lines:
                page.write_text("\n".join(changed), encoding="utf-8")
    print(f"{compared} examples compared, {failed} show what the program does not print")
    return 1 if failed or compared == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
