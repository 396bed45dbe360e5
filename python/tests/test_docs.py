"""The examples of docs/python.md print what the page shows."""

import doctest
import re

import pytest
from conftest import PROJECT


def test_the_pages_examples(monkeypatch):
    monkeypatch.chdir(PROJECT)
    page = (PROJECT / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```pycon\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    assert len(blocks) >= 3
    names = {}
    for i, block in enumerate(blocks):
        case = doctest.DocTestParser().get_doctest(block, names, f"block {i + 1}", "python.md", 0)
        report = []
        runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
        runner.run(case, out=report.append, clear_globs=False)
        if runner.failures:
            pytest.fail("".join(report))
        names = case.globs
