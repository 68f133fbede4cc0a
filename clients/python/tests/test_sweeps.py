"""Sweeps: forms of tables, resuming, executors, workers that die, progress."""
import concurrent.futures
import io
import json
import os
import pathlib
import random
import sys
import tempfile
import unittest
from unittest import mock

from .support import SWEEP, Case, column, command_line, local, shared_table, snapthrough

from snapthrough import _chunks, _engine, engines

FOLLOWED = (pathlib.Path(__file__).resolve().parents[3] / "examples" / "sweeps" / "ring_followed.json")


def sweep_of(count, **fields):
    """A sweep of some columns."""
    sweep = snapthrough.Sweep(column(), snapthrough.Critical(), "grid",
                              ["/summary/critical_load_factor", "/summary/critical_type"], **fields)
    return sweep.parameter("K", "/model/foundations/0/stiffness", range={"from": 1, "to": 100, "count": count})


class DiesOnce:
    """Computes points, but ends its process the first time that it has a certain one. Picklable."""

    def __init__(self, task, point, mark, always=False):
        self.task, self.point, self.mark, self.always = task, point, mark, always

    def __call__(self, first, count):
        if first <= self.point < first + count and (self.always or not os.path.exists(self.mark)):
            pathlib.Path(self.mark).touch()
            os._exit(9)
        return self.task(first, count)


class Forms(Case):
    def test_files_are_those_of_the_command_line_byte_for_byte(self):
        table = shared_table()
        self.assertEqual(table.to_csv(), command_line("sweep", "--csv", "-", text=SWEEP))
        self.assertEqual(table.to_json(), command_line("sweep", "-", text=SWEEP))
        self.assertEqual(table.to_ndjson(), command_line("sweep", "--ndjson", "-", text=SWEEP))
        with tempfile.TemporaryDirectory() as folder:
            table.to_csv(folder + "/table.csv")
            self.assertEqual(pathlib.Path(folder, "table.csv").read_bytes().decode("utf-8"), table.to_csv())
        stream = io.StringIO()
        table.to_csv(stream)
        self.assertEqual(stream.getvalue(), table.to_csv())

    def test_texts_that_csv_must_quote(self):
        document = json.loads(SWEEP)
        document["parameters"][0]["label"] = ['=1+1, "quoted"', "plain\nwith a line"]
        document["parameters"][0]["name"] = "feet, kind"
        document["parameters"][1]["range"]["count"] = 2
        text = json.dumps(document)
        self.assertEqual(local().sweep(text).table().to_csv(), command_line("sweep", "--csv", "-", text=text))

    def test_tables_are_read_again(self):
        table = shared_table()
        with tempfile.TemporaryDirectory() as folder:
            for name, write in (("t.json", table.to_json), ("t.ndjson", table.to_ndjson)):
                write(f"{folder}/{name}")
                again = snapthrough.read_table(f"{folder}/{name}")
                self.assertEqual(again.to_csv(), table.to_csv())
                self.assertEqual(again.points, table.points)

    def test_rows_are_dictionaries_in_the_order_of_points(self):
        run = local().sweep(sweep_of(30))
        self.assertEqual(len(run), 30)
        rows, sizes = [], []
        for row in run:
            rows.append(row)
            sizes.append(len(run.partial))
        self.assertEqual(rows, list(run.table()))
        self.assertEqual(sizes, sorted(sizes))
        self.assertEqual(rows[0]["K"], 1.0)
        self.assertIsNone(rows[0]["error"])
        self.assertEqual(run.table().column("/summary/critical_type"), ["bifurcation"] * 30)

    def test_frames_grow(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not there")
        run = local().sweep(sweep_of(300), workers=1)
        next(run)
        first = len(run.frame())
        self.assertLess(first, 300)
        self.assertEqual(len(run.table().to_pandas()), 300)
        self.assertEqual(run.table().to_numpy("K", "/summary/critical_load_factor").shape, (300, 2))

    def test_a_curve_that_is_followed_is_one_item(self):
        text = FOLLOWED.read_text(encoding="utf-8")
        self.assertEqual(local().sweep(text).table().to_csv(), command_line("sweep", "--csv", "-", text=text))


class Refined(Case):
    """The buckling load of a column over the stiffness of its base, on which the number of waves depends."""

    FACTOR = "/buckling/load_factors/0"

    def setUp(self):
        super().setUp()
        sweep = snapthrough.Sweep(column(), snapthrough.Buckling(), "grid", [self.FACTOR], refine=self.FACTOR)
        sweep.parameter("K", "/model/foundations/0/stiffness",
                        range={"from": 1, "to": 1000, "count": 5, "spacing": "log"})
        self.text = json.dumps(sweep.document)

    def factor_at(self, stiffness):
        """The load factor of an analysis of its own."""
        request = {name: json.loads(self.text)[name] for name in ("model", "analysis")}
        request["model"]["foundations"][0]["stiffness"] = stiffness
        return json.loads(command_line("solve", "-", text=json.dumps(request)))["buckling"]["load_factors"][0]

    def test_values_between_the_rows_of_a_file_are_near_those_of_own_analyses(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "column.json")
            path.write_text(command_line("sweep", "-", text=self.text), encoding="utf-8")
            table = snapthrough.read_table(path, sweep=self.text)
        self.assertEqual(table.to_csv(), command_line("sweep", "--csv", "-", text=self.text))
        pieces = table.column("piece")
        self.assertEqual((pieces, sorted(set(pieces))), (sorted(pieces), [0, 1, 2]))
        begins = [at for at in range(1, len(pieces)) if pieces[at] != pieces[at - 1]]
        self.assertEqual([at for at, change in enumerate(table.column("change")) if change is not None], begins)
        draws = random.Random(1)
        for stiffness in (10 ** draws.uniform(0, 3) for _ in range(20)):
            own = self.factor_at(stiffness)
            self.assertAlmostEqual(table.interpolated({"K": stiffness}), own, delta=0.01 * own)

    def test_files_are_those_of_the_command_line_byte_for_byte(self):
        table = local().sweep(self.text).table()
        self.assertEqual(table.to_csv(), command_line("sweep", "--csv", "-", text=self.text))
        self.assertEqual(table.to_json(), command_line("sweep", "-", text=self.text))
        self.assertEqual(table.to_ndjson(), command_line("sweep", "--ndjson", "-", text=self.text))


class Resuming(Case):
    def test_rows_that_are_there_are_not_computed_again(self):
        full = local().sweep(sweep_of(40)).table()
        part = snapthrough.Table(full.columns, 40)
        for index in [*range(7), *range(20, 30)]:
            part.append(index, full.rows[index], full.text_of(index).replace("bifurcation", "taken over"))
        resumed = local().sweep(sweep_of(40), resume=part).table()
        self.assertEqual(resumed.points, list(range(40)))
        taken = [point for point in range(40) if "taken over" in resumed.text_of(point)]
        self.assertEqual(taken, part.points)

    def test_a_file_that_was_cut_off(self):
        full = local().sweep(sweep_of(40)).table()
        with tempfile.TemporaryDirectory() as folder:
            path = folder + "/rows.ndjson"
            pathlib.Path(path).write_text(full.to_ndjson()[:-40], encoding="utf-8")
            self.assertEqual(len(snapthrough.read_table(path)), 39)
            self.assertEqual(local().sweep(sweep_of(40), resume=path).table().to_csv(), full.to_csv())
            missing = local().sweep(sweep_of(40), resume=folder + "/none.ndjson").table()
            self.assertEqual(missing.to_csv(), full.to_csv())

    def test_a_table_of_another_sweep_is_refused(self):
        other = shared_table()
        with self.assertRaisesRegex(snapthrough.UsageError, "columns"):
            local().sweep(sweep_of(40), resume=other)
        with self.assertRaisesRegex(snapthrough.UsageError, "point 39"):
            local().sweep(sweep_of(20), resume=local().sweep(sweep_of(40)).table())


class Executors(Case):
    def test_threads_and_processes_give_the_same_bytes(self):
        expected = local().sweep(sweep_of(150)).table().to_json()
        with concurrent.futures.ThreadPoolExecutor(3) as threads, \
                concurrent.futures.ProcessPoolExecutor(2) as pool:
            for executor in (None, threads, pool, engines.processes(2)):
                self.assertEqual(local().sweep(sweep_of(150), executor=executor).table().to_json(), expected)

    def run_with_deaths(self, executor, always):
        """A sweep of which one worker dies at point 57."""
        with tempfile.TemporaryDirectory() as folder:
            real = _engine.Engine.__init__

            def deadly(engine, task, *rest):
                real(engine, DiesOnce(task, 57, folder + "/mark", always), *rest)

            with mock.patch.object(_engine.Engine, "__init__", deadly):
                return local().sweep(sweep_of(200), executor=executor).table()

    def test_the_points_of_a_worker_that_died_are_tried_again(self):
        table = self.run_with_deaths(lambda: concurrent.futures.ProcessPoolExecutor(2), False)
        self.assertEqual(table.to_csv(), local().sweep(sweep_of(200)).table().to_csv())

    def test_points_with_which_workers_always_die_are_named(self):
        with self.assertRaises(snapthrough.WorkerDied) as caught:
            self.run_with_deaths(lambda: concurrent.futures.ProcessPoolExecutor(2), True)
        self.assertLessEqual(caught.exception.first, 57)
        self.assertGreaterEqual(caught.exception.last, 57)

    def test_an_executor_that_cannot_be_replaced_is_told(self):
        with concurrent.futures.ProcessPoolExecutor(2) as pool:
            with self.assertRaisesRegex(snapthrough.WorkerDied, "function that makes an executor"):
                self.run_with_deaths(pool, False)

    def test_what_the_library_refuses_is_raised_once(self):
        calls = []

        def refuses(document, path, first, count):
            calls.append(first)
            return 2, b'{"title": "x", "detail": "y", "errors": []}', 0.0

        with mock.patch.object(_chunks, "compute_chunk", refuses):
            with concurrent.futures.ThreadPoolExecutor(1) as pool, self.assertRaises(snapthrough.InvalidRequest):
                local().sweep(sweep_of(1000), executor=pool).table()
        self.assertLess(len(calls), 10)

    def test_items_are_not_cut(self):
        spans = _engine.missing_spans(100, 10, [*range(15), *range(40, 60), 75])
        self.assertEqual(spans, [(10, 30), (60, 40)])
        self.assertEqual(_engine.missing_spans(25, 10, range(20, 25)), [(0, 20)])


class Telling(Case):
    def test_progress_and_stopping_by_it(self):
        seen = []
        local().sweep(SWEEP, on_progress=seen.append).table()
        self.assertEqual((seen[-1].done, seen[-1].total, seen[-1].failed), (500, 500, 50))
        with self.assertRaises(snapthrough.Cancelled) as caught:
            local().sweep(SWEEP, on_progress=lambda progress: progress.done < 100).table()
        self.assertGreaterEqual(len(caught.exception.reached), 100)

    def test_the_line_on_a_terminal(self):
        for without_tqdm in (True, False):
            stream = io.StringIO()
            blocked = {"tqdm": None} if without_tqdm else {}
            with mock.patch.object(sys, "stderr", stream), mock.patch.dict(sys.modules, blocked):
                local().sweep(sweep_of(20), progress=True).table()
            self.assertIn("20/20", stream.getvalue())
            self.assertTrue(stream.getvalue().endswith("\n"))

    def test_nothing_is_written_elsewhere(self):
        stream = io.StringIO()
        with mock.patch.object(sys, "stderr", stream):
            local().sweep(sweep_of(20)).table()
        self.assertEqual(stream.getvalue(), "")


if __name__ == "__main__":
    unittest.main()
