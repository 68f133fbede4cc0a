"""A sweep that is being computed: an iterator over its rows that keeps them."""
from typing import Any, Dict, Iterator, Mapping, Optional, Sequence

from ._engine import Batch
from ._errors import Cancelled, Interrupted
from ._progress import OnProgress, Progress, ProgressLine, Stop
from ._table import Table

#: Rows in the order of points, some at a time.
Batches = Iterator[Batch]


class SweepRun(Iterator[Dict[str, Any]]):
    """Rows of a sweep as they are computed, in the order of its points; each a dictionary by column.

        run = local.sweep(document)
        for row in run:
            ...                      # run.partial and run.frame() grow
        run.table().to_csv("table.csv")

    Points are computed while somebody asks for rows. `columns` are the names of the columns, `total` is the number of
    points; of a refined sweep, the number of curves or surfaces, each of which has all its rows at once. Ctrl-C raises
    Interrupted, a Stop or a callback that gives False raises Cancelled; both have `reached`, the table as far as it
    came.
    """

    def __init__(self, columns: Sequence[str], total: int, batches: Batches, on_progress: Optional[OnProgress],
                 progress: Optional[bool], stop: Stop, about: Optional[Mapping[str, Any]] = None,
                 sweep: Any = None) -> None:
        self.columns = list(columns)
        self.total = total
        self._table = Table(columns, total, about)
        if sweep is not None and self._table.refined:
            self._table.with_sweep(sweep)
        self._batches = batches
        self._on_progress = on_progress
        self._line = ProgressLine(total, progress)
        self._stop = stop
        self._given = 0
        self._failed = 0
        self._ended = False

    @property
    def partial(self) -> Table:
        """The rows that are there; the same table as table(), which grows."""
        return self._table

    def frame(self) -> Any:
        """The rows that are there, as a pandas.DataFrame."""
        return self._table.to_pandas()

    def table(self) -> Table:
        """Waits for all rows and gives them."""
        try:
            while self._advance():
                pass
        except KeyboardInterrupt:
            raise self._interrupted() from None
        return self._table

    def __len__(self) -> int:
        return self.total

    def __iter__(self) -> "SweepRun":
        return self

    def __next__(self) -> Dict[str, Any]:
        try:
            while self._given >= len(self._table):
                if not self._advance():
                    raise StopIteration
        except KeyboardInterrupt:
            raise self._interrupted() from None
        self._given += 1
        return self._table[self._given - 1]

    def __repr__(self) -> str:
        of_total = "" if self._table.refined else f" of {self.total}"
        return f"SweepRun({len(self._table)}{of_total} rows; columns {', '.join(self.columns)})"

    def _advance(self) -> bool:
        """Takes the next rows; false when there are no more."""
        if self._ended:
            return False
        try:
            return self._take(next(self._batches, None))
        except Cancelled:
            self._close()
            raise Cancelled(self._table) from None
        except BaseException:
            self._close()
            raise

    def _take(self, batch: Optional[Batch]) -> bool:
        if batch is None:
            self._close()
            return False
        count, rows = batch
        for point, (row, text) in rows:
            self._table.append(point, row, text)
            self._failed += row[-1] is not None
        if self._table.refined:
            self._table.done += count
        now = Progress(done=self._table.done, total=self.total, failed=self._failed)
        self._line.show(now)
        if self._on_progress is not None and self._on_progress(now) is False:
            self._stop.request()
        if self._stop.requested and not self._table.complete:
            raise Cancelled()
        return True

    def _interrupted(self) -> Interrupted:
        self._close()
        return Interrupted(self._table)

    def _close(self) -> None:
        self._ended = True
        self._line.close()
        close = getattr(self._batches, "close", None)
        if close is not None:
            close()
