"""Progress of long calls: a callback, or a bar."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Union

    #: A function of the name of the stage and its finished share, 0 to 1; True: a bar of tqdm, if it is installed, else
    #: a line on standard error; None or False: nothing. An exception of the function ends the call and leaves it.
    Progress = Union[Callable[[str, float], object], bool, None]


@contextmanager
def shown(progress: Progress) -> Iterator[Callable[[str, float], object] | None]:
    """The function to pass to the library, while the call runs."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        bar = _Bar()
        try:
            yield bar
        finally:
            bar.close()
    else:
        yield progress


class _Bar:
    """A bar for each stage."""

    def __init__(self) -> None:
        self._stage = ""
        self._bar: Any = None
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self._make = None
        else:
            self._make = tqdm

    def __call__(self, stage: str, done: float) -> None:
        if self._make is None:
            import sys

            print(f"\r{stage}: {100 * done:.0f} %   ", end="", file=sys.stderr, flush=True)
            self._stage = stage
            return
        if stage != self._stage:
            self.close()
            self._stage = stage
            self._bar = self._make(total=1.0, desc=stage, bar_format="{desc}: {percentage:3.0f}%|{bar}| {elapsed}")
        self._bar.update(max(done - self._bar.n, 0.0))

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None
        elif self._make is None and self._stage:
            import sys

            print(file=sys.stderr)
