"""How far an analysis or a sweep is: what callbacks are given, and a line or a bar for people."""
import sys
import threading
import time
from dataclasses import dataclass
from typing import Any, Callable, List, Optional

#: Seconds between two lines.
_BETWEEN_LINES = 0.1
_BAR = 30


@dataclass(frozen=True)
class Progress:
    """How far a call is.

    Fields:
        done: sweeps: points that have their row, refined sweeps: curves or surfaces that have theirs; analyses: steps
            along the branch.
        total: sweeps: points of the sweep, refined sweeps: its curves or surfaces; analyses: 0, since their number is
            not known.
        load_factor: of the last point of the path; sweeps: 0.
        branch: index of the path's branch, from 0; sweeps: 0.
        negative_eigenvalues: of the tangent stiffness; 0 is stable, -1 not counted; sweeps: 0.
        failed: sweeps: rows with an error; analyses: 0.
    """

    done: int
    total: int = 0
    load_factor: float = 0.0
    branch: int = 0
    negative_eigenvalues: int = 0
    failed: int = 0


#: Called with each Progress; False stops the call, anything else lets it go on.
OnProgress = Callable[[Progress], Any]


class Stop:
    """Stops the calls that were given it, from any thread; they raise Cancelled."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._requested = False
        self._actions: List[Callable[[], None]] = []

    @property
    def requested(self) -> bool:
        """Whether request() was called."""
        return self._requested

    def request(self) -> None:
        """Stops every call that was given this, and every later one. Can be repeated."""
        with self._lock:
            self._requested = True
            for action in self._actions:
                action()

    def attach(self, action: Callable[[], None]) -> Callable[[], None]:
        """Has an action done at the request, at once if it came already; what is returned takes it back."""
        with self._lock:
            self._actions.append(action)
            if self._requested:
                action()

        def detach() -> None:
            with self._lock:
                self._actions.remove(action)

        return detach


class ProgressLine:
    """A bar on standard error: that of tqdm where it is there, else a line of our own."""

    def __init__(self, total: int, wanted: Optional[bool]) -> None:
        self._total = total
        self._shown = _has_reader() if wanted is None else wanted
        self._bar: Any = None
        self._start = time.monotonic()
        self._next = 0.0
        self._width = 0
        if self._shown:
            self._bar = _tqdm(total)

    def show(self, progress: Progress) -> None:
        """Shows it, unless the last one was shown just now."""
        now = time.monotonic()
        last = progress.done >= self._total
        if not self._shown or (now < self._next and not last):
            return
        self._next = now + _BETWEEN_LINES
        if self._bar is not None:
            self._bar.update(progress.done - self._bar.n)
            return
        share = progress.done / max(1, self._total)
        rate = progress.done / max(1e-9, now - self._start)
        failed = f", {progress.failed} failed" if progress.failed else ""
        left = (self._total - progress.done) / max(1e-9, rate)
        bar = "#" * round(_BAR * share) + "." * (_BAR - round(_BAR * share))
        line = f"[{bar}] {progress.done}/{self._total}{failed}, {rate:.3g} points/s, {left:.0f} s left"
        sys.stderr.write("\r" + line.ljust(self._width))  # the end of a longer line before it is overwritten
        self._width = len(line)
        sys.stderr.flush()

    def close(self) -> None:
        """Ends the line."""
        if self._bar is not None:
            self._bar.close()
        elif self._shown and self._next:
            sys.stderr.write("\n")
            sys.stderr.flush()
        self._shown = False


def _has_reader() -> bool:
    """Whether somebody sees standard error as it is written: on a terminal or in a notebook."""
    return sys.stderr.isatty() or "ipykernel" in sys.modules


def _tqdm(total: int) -> Any:
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    return tqdm(total=total, unit="points", file=sys.stderr)
