#!/usr/bin/env python3
"""Makes the Debian packages of a build by cpack and looks into them.

    check_packages.py BUILD PROJECT [--keep FOLDER]

Whether each has what it should, with a manual page for each program and command, stripped, and without a
word of the machine that built it; and where lintian is installed, that it finds no error and no warning.
--keep leaves the packages in FOLDER. Exit status 77 (skipped) where what cpack needs (dpkg-dev, file) is missing.
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
# A quarter of the time that xz takes, which users get.
FASTER = ["-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip"]


def output(*words):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True).stdout


class Package:
    def __init__(self, path, folder):
        self.path = path
        self.name = output("dpkg-deb", "-f", path, "Package").strip()
        self.folder = folder / self.name
        self.folder.mkdir(parents=True)
        output("dpkg-deb", "-x", path, self.folder)
        self.faults = []

    def field(self, name):
        return output("dpkg-deb", "-f", self.path, name).strip()

    def expect(self, holds, fault):
        if not holds:
            self.faults.append(f"{self.path.name}: {fault}")

    def needs(self, path):
        self.expect((self.folder / path).is_file(), f"{path} is missing")

    def needs_same(self, path, source):
        """The file, byte for byte that of the sources."""
        self.needs(path)
        if (self.folder / path).is_file():
            self.expect((self.folder / path).read_bytes() == source.read_bytes(), f"{path}: is not {source}")


def check_every(package, version, build):
    package.expect(package.field("Version") == f"{version}-1", f"version {package.field('Version')}")
    package.expect(re.fullmatch(r".+ <\S+@\S+>", package.field("Maintainer")), "no maintainer with an address")
    description = package.field("Description").split("\n")
    package.expect(len(description) > 2 and description[0] not in description[1], "no description of its own")
    for file in ("copyright", "changelog.Debian.gz", "changelog.gz"):
        package.needs(f"usr/share/doc/{package.name}/{file}")
    for line in output("dpkg-deb", "-c", package.path).splitlines():
        package.expect(line.split()[1] == "root/root", f"not of root: {line}")
    for path in package.folder.rglob("*"):
        if path.is_file():
            package.expect(str(build).encode() not in path.read_bytes(), f"{path.name} names the folder {build}")


def check_program(package, project, build):
    for program in ("howl", "howl_rig"):
        package.needs(f"usr/bin/{program}")
        sections = output("readelf", "-S", "-W", package.folder / "usr/bin" / program)
        package.expect(".text" in sections and ".symtab" not in sections, f"{program} is not stripped")
        package.needs(f"usr/share/man/man1/{program}.1.gz")
    commands = output(build / "howl", "help", "commands").split()
    package.expect(len(commands) > 10, "howl help commands lists none")
    for command in commands:
        package.needs(f"usr/share/man/man1/howl-{command}.1.gz")
        package.needs_same(f"usr/share/doc/howl/{command}.md", project / f"docs/{command}.md")
    for config in (project / "configs").rglob("*"):
        if config.is_file():
            package.needs_same(f"usr/share/howl/{config.relative_to(project)}", config)
    completion = project / "app/help/completion"
    package.needs_same("usr/share/bash-completion/completions/howl", completion / "howl.bash")
    package.needs_same("usr/share/zsh/vendor-completions/_howl", completion / "howl.zsh")
    package.needs_same("usr/share/fish/vendor_completions.d/howl.fish", completion / "howl.fish")
    package.needs("usr/share/howl/config_schema.json")
    package.expect(re.search(r"\blibc6 \(>= ", package.field("Depends")), "does not depend on libc6")
    package.expect("gnuplot" in package.field("Recommends"), "does not recommend gnuplot")
    package.expect(not list(package.folder.rglob("*.h")), "has headers")


def check_development(package, project):
    listed = re.findall(r"^ +(\S+\.h)\)?$", (project / "cmake/installed_headers.cmake").read_text(), re.M)
    package.expect(len(listed) > 40, "cmake/installed_headers.cmake names no headers")
    for header in listed:
        package.needs_same(f"usr/include/howl/{header}", project / header)
    for library in ("model", "estimation"):
        package.expect(list(package.folder.rglob(f"libhowl_{library}.a")), f"libhowl_{library}.a is missing")
    package.expect(list(package.folder.rglob("howl-config.cmake")), "howl-config.cmake is missing")
    package.expect("libceres-dev" in package.field("Depends"), "does not depend on libceres-dev")
    package.expect(not (package.folder / "usr/bin").exists(), "has programs")


def lintian(paths):
    """What it finds, line by line; None where it is not installed."""
    if not shutil.which("lintian"):
        return None
    run = subprocess.run(["lintian", "--allow-root", "--fail-on", "error,warning", *map(str, paths)],
                         capture_output=True, text=True)
    return run.stdout.splitlines() if run.returncode else []


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("project", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--keep", type=pathlib.Path)
    given = parser.parse_args()
    for tool in ("dpkg-deb", "dpkg-shlibdeps", "file"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed (dpkg-dev, file)")
            return SKIPPED
    version = re.search(r"VERSION ([\d.]+) LANGUAGES", (given.project / "CMakeLists.txt").read_text())[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run = subprocess.run(["cpack", "-B", folder / "made", *FASTER], cwd=given.build, capture_output=True, text=True)
        if run.returncode:
            print(run.stdout + run.stderr)
            return 1
        paths = sorted((folder / "made").glob("*.deb"))
        packages = {each.name: each for each in (Package(path, folder / "read") for path in paths)}
        if set(packages) != {"howl", "libhowl-dev"}:
            print(f"cpack made {sorted(packages)}, expected howl and libhowl-dev")
            return 1
        for package in packages.values():
            check_every(package, version, given.build)
        check_program(packages["howl"], given.project, given.build)
        check_development(packages["libhowl-dev"], given.project)
        faults = [fault for package in packages.values() for fault in package.faults]
        found = lintian(paths)
        if found is None:
            print("lintian is not installed: the packages are checked without it")
        faults += found or []
        if given.keep:
            given.keep.mkdir(parents=True, exist_ok=True)
            for path in paths:
                shutil.copy(path, given.keep)
    for fault in faults:
        print(fault)
    print(f"{', '.join(path.name for path in paths)}: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
