"""Shows how far a computation is, where somebody looks: a terminal or a notebook."""

from __future__ import annotations

import sys
from typing import Any, Optional, Union

from ._program import Observer, Progress

ProgressArgument = Union[bool, Observer, None]


def in_notebook() -> bool:
    if "IPython" not in sys.modules:
        return False
    from IPython import get_ipython

    shell = get_ipython()
    return shell is not None and shell.__class__.__name__ == "ZMQInteractiveShell"


class _Line:
    """One line on standard error that each state overwrites."""

    def __init__(self) -> None:
        self._length = 0

    def __call__(self, state: Progress) -> None:
        count = "" if state.done is None else f" {state.done} of {state.total},"
        self._show(f"{state.what}:{count} {state.text}")

    def close(self) -> None:
        if self._length:
            self._show("")
            sys.stderr.write("\r")
            sys.stderr.flush()

    def _show(self, text: str) -> None:
        sys.stderr.write("\r" + text.ljust(self._length))
        sys.stderr.flush()
        self._length = len(text)


class _Bars:
    """tqdm's bar, one for each stretch of work."""

    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None

    def __call__(self, state: Progress) -> None:
        bar = self._bar
        new = bar is None or bar.desc.rstrip(": ") != state.what or bar.total != state.total
        if new or (state.done is not None and state.done < bar.n):
            self.close()
            self._bar = bar = self._tqdm(total=state.total, desc=state.what, leave=False)
        if state.done is None:
            bar.set_postfix_str(state.text)
        else:
            bar.update(state.done - bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None


class Shown:
    """A context that gives the observer of a computation, or None where nobody looks."""

    def __init__(self, wanted: ProgressArgument) -> None:
        self._view: Optional[Any] = None
        self.observer: Optional[Observer] = None
        if callable(wanted):
            self.observer = wanted
            return
        if wanted is None:
            wanted = in_notebook() or (sys.stderr is not None and sys.stderr.isatty())
        if not wanted:
            return
        try:
            from tqdm.auto import tqdm

            self._view = _Bars(tqdm)
        except ImportError:
            self._view = _Line()
        self.observer = self._view

    def __enter__(self) -> "Shown":
        return self

    def __exit__(self, *_: object) -> None:
        if self._view is not None:
            self._view.close()
