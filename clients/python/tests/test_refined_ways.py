"""The way of the rows of refined sweeps: from a library and from a service, which are made by hand."""
import json
import pathlib
import tempfile
import unittest
import urllib.parse

from .support import Case, snapthrough
from .test_refined import LOAD, TYPE, row, sweep_document

from snapthrough import _engine
from snapthrough._http import Response
from snapthrough._library import DONE, Answer, Library, NativeStop


def curve_rows(number):
    """Rows of one curve of a sweep: as many as its number, and one."""
    return [row([float(number), float(at)], 10.0 * number + at, 0) for at in range(number + 1)]


def document_of(first, count, total):
    """The table of some curves, as the library and the service give it."""
    numbers = range(first, min(total, first + count))
    return {"total": total, "unit": 1, "columns": ["EI", "q", LOAD, TYPE, "piece", "change", "error"],
            "rows": [one for number in numbers for one in curve_rows(number)],
            "points": [4097 * number + at for number in numbers for at in range(number + 1)],
            "program": {"name": "made by hand"}, "request_sha256": "0"}


class HandMade(Library):
    """A library whose sweeps have tables that were made by hand."""

    path = "made by hand"
    total = 9

    def __init__(self):
        pass

    def new_stop(self):
        return NativeStop.__new__(NativeStop)

    def sweep(self, document, first, count, stop=None):
        return Answer(DONE, json.dumps(document_of(first, count, self.total)).encode())


class HandMadeService:
    """A transport to a service whose curves are done in an order that was made by hand."""

    done = ((), (1, 2), (0, 1, 2), (0, 1, 2, 3))
    step = 0

    def send(self, method, path, body=None, headers=None):
        address = urllib.parse.urlsplit(path)
        query = {name: int(value) for name, value in urllib.parse.parse_qsl(address.query) if value.isdigit()}
        if address.path == "/v1/sweeps/7/table":
            document = {**document_of(0, 0, 4), "rows": [], "points": []}
            for number in self.done[self.step]:
                if query["first"] <= number < query["first"] + query["count"]:
                    document["rows"] += document_of(number, 1, 4)["rows"]
                    document["points"] += document_of(number, 1, 4)["points"]
        elif address.path == "/v1/sweeps/7/request":
            document = Ways.DOCUMENT
        else:
            document = {"id": "7", "points": 4, "counts": {"remaining": 4 - len(self.done[self.step])}}
        return Response(200, {}, json.dumps(document).encode())


class HandMadeClient(snapthrough.Client):
    """A client of that service."""

    def __init__(self):
        super().__init__("http://127.0.0.1:9")
        self._http = HandMadeService()

    def sweep_events(self, sweep, last_id=""):
        for self._http.step in range(1, len(self._http.done)):
            yield None


class Ways(Case):
    DOCUMENT = sweep_document({"output": LOAD}, ("q", 0, 9, "linear"), others=[("EI", list(range(9)))])

    def local(self):
        local = snapthrough.Local.__new__(snapthrough.Local)
        local._library = HandMade()
        return local

    def test_rows_of_whole_curves_come_in_their_order(self):
        seen = []
        run = self.local().sweep(self.DOCUMENT, workers=3, on_progress=seen.append)
        first = next(run)
        table = run.table()
        self.assertEqual((first["EI"], first["q"], len(run)), (0.0, 0.0, 9))
        self.assertEqual(table.rows, [one for number in range(9) for one in curve_rows(number)])
        self.assertEqual(table.points[:4], [0, 4097, 4098, 8194])
        self.assertEqual((seen[-1].done, seen[-1].total, table.complete), (9, 9, True))
        self.assertEqual(table.interpolated({"EI": 4, "q": 1.5}), 41.5)

    def test_batches_wait_for_the_curves_before_them(self):
        batches = [(2, (1, ["c"])), (0, (2, ["a", "b1", "b2"])), (3, (2, []))]
        self.assertEqual(list(_engine.curves_in_order(iter(batches), 5)),
                         [(2, ["a", "b1", "b2"]), (1, ["c"]), (2, [])])
        with self.assertRaisesRegex(snapthrough.SnapthroughError, "from number 0 on"):
            list(_engine.curves_in_order(iter(batches[:1]), 5))

    def test_rows_of_an_earlier_run_are_not_taken_over(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "rows.ndjson")
            run = self.local().sweep(self.DOCUMENT, resume=path)
            path.write_text(run.table().to_ndjson(), encoding="utf-8")
            with self.assertRaisesRegex(snapthrough.UsageError, "resume: rows of a refined sweep"):
                self.local().sweep(self.DOCUMENT, resume=path)

    def test_a_service_gives_whole_curves_in_their_order(self):
        client, seen = HandMadeClient(), []
        run = client.sweep(self.DOCUMENT, on_progress=lambda progress: seen.append((progress.done, len(run.partial))))
        table = run.table()
        self.assertEqual(table.rows, [one for number in range(4) for one in curve_rows(number)])
        self.assertEqual(seen, [(1, 1), (2, 3), (3, 6), (4, 10)])
        self.assertEqual((table.complete, table.interpolated({"EI": 3, "q": 0.5})), (True, 30.5))
        again = client.table("7")
        self.assertEqual((again.complete, again.interpolated({"EI": 3, "q": 2.5})), (True, 32.5))
        self.assertEqual(client.table("7", 2, 1).rows, curve_rows(2))


if __name__ == "__main__":
    unittest.main()
