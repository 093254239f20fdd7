"""How far a long call is."""
import contextlib
import sys
import time
from collections.abc import Callable, Iterator
from typing import Optional, TextIO, Union

#: What the calls take as `progress`: True draws a bar, a function is called with the share done, 0 to 1, and the name
#: of the call.
Progress = Union[bool, Callable[[float, str], object], None]


class Bar:
    """One line on a terminal that is rewritten in place, of calls that take longer than a second.

    Parameters
    ----------
    out : file
        Where it is written.
    """

    width = 30

    def __init__(self, out: TextIO) -> None:
        self._out = out
        self._begun = time.monotonic()
        self._drawn = False

    def __call__(self, fraction: float, text: str) -> None:
        """Tells that the work `text` is done to a share `fraction`, 0 to 1."""
        passed = time.monotonic() - self._begun
        if passed < 1:
            return
        filled = round(self.width * fraction)
        left = f"  {passed * (1 - fraction) / fraction:.0f} s left" if fraction > 0.01 else ""
        bar = "#" * filled + "." * (self.width - filled)
        self._out.write(f"\r\033[K{text}  [{bar}]  {100 * fraction:3.0f} %{left}")
        self._out.flush()
        self._drawn = True

    def close(self) -> None:
        """Wipes the line."""
        if self._drawn:
            self._out.write("\r\033[K")
            self._out.flush()


@contextlib.contextmanager
def telling(progress: Progress) -> Iterator[Optional[Callable[[float, str], object]]]:
    """The function that is told how far a call is, or None; a bar is wiped when the call is over."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        bar = Bar(sys.stderr)
        try:
            yield bar
        finally:
            bar.close()
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress is True, a function of a fraction and a text, or None, not {progress!r}")
