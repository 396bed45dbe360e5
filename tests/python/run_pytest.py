"""Runs the tests of the Python package against a program that is built already.

    run_pytest.py HOWL SOURCE_DIR [pytest's options]

Exit status 77, after saying why, where a package that the tests need is not installed.
"""
import importlib.util
import os
import subprocess
import sys

SKIP = 77
NEEDED = ["pytest", "numpy", "pandas", "yaml"]


def main():
    howl, source = sys.argv[1:3]
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        print(f"skipped: {sys.executable} has no {', '.join(missing)} "
              "(python3-pytest python3-numpy python3-pandas python3-yaml)")
        return SKIP
    package = os.path.join(source, "python")
    environment = dict(os.environ, HOWL_PROGRAM=howl, PYTHONPATH=package,
                       PYTHONDONTWRITEBYTECODE="1")
    command = [sys.executable, "-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider",
               "-c", os.path.join(package, "pyproject.toml"), os.path.join(package, "tests"),
               *sys.argv[3:]]
    return subprocess.run(command, env=environment, cwd=package).returncode


if __name__ == "__main__":
    sys.exit(main())
