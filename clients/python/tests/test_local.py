"""Local: analyses in this process."""
import copy
import json
import os
import pickle
import signal
import socket
import threading
import time
import unittest
import warnings

from .support import EXPECTED, LIBRARY, Case, column, interrupt_after, local, request, snapthrough, without_time


class Shared(Case):
    def solve(self, name):
        """What a shared request comes to, in the words of expected.json."""
        steps = []
        on_progress = (lambda progress: len(steps) < 20 and steps.append(progress) is None) \
            if name == "cancelled" else None
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            told = {"outcome": "done"}
            try:
                local().solve(request(name), on_progress=on_progress)
            except snapthrough.InvalidRequest as error:
                told = {"outcome": "wrong", "errors": [[finding.pointer, finding.code] for finding in error.findings]}
            except snapthrough.AnalysisFailed as error:
                told = {"outcome": "failed", "code": error.code}
                self.assertEqual(error.reached.failure.code, error.code)
            except snapthrough.Cancelled as error:
                told = {"outcome": "cancelled"}
                self.assertGreaterEqual(len(error.reached.branches[0].load_factor), 20)
        if caught:
            told["warnings"] = [str(warning.message).split(":")[0] for warning in caught]
            self.assertEqual({warning.filename for warning in caught}, {__file__})
        return told

    def test_each_comes_to_what_is_expected(self):
        for name, expected in EXPECTED.items():
            with self.subTest(name):
                self.assertEqual(self.solve(name), expected)

    def test_the_same_request_gives_the_same_document(self):
        first, second = (local().solve(request("arch")) for _ in range(2))
        self.assertEqual(without_time(first.document), without_time(second.document))

    def test_what_failed_keeps_what_was_reached(self):
        with self.assertRaises(snapthrough.AnalysisFailed) as caught:
            local().solve(request("failing"))
        self.assertEqual(caught.exception.reached.static.load_factor, [0.5])
        self.assertEqual(caught.exception.reached.not_reached, [200])
        self.assertIn("beyond_critical_point", str(caught.exception))

    def test_findings_are_listed_in_the_message(self):
        with self.assertRaises(snapthrough.InvalidRequest) as caught:
            local().solve(request("wrong"))
        self.assertIn("/model/sections/0/EI: EI must be positive", str(caught.exception))
        self.assertEqual(len(str(caught.exception).splitlines()), 3)

    def test_what_is_no_json_is_a_wrong_request(self):
        with self.assertRaises(snapthrough.InvalidRequest) as caught:
            local().solve(b'{"model": ')
        self.assertEqual(caught.exception.findings[0].code, "malformed")


class Stopping(Case):
    def test_ctrl_c_ends_an_analysis_and_keeps_what_was_reached(self):
        for on_progress in (None, lambda progress: None):
            interrupt_after(0.3)
            with self.assertRaises(KeyboardInterrupt) as caught:
                local().solve(request("cancelled"), on_progress=on_progress)
            self.assertEqual(caught.exception.reached.summary.termination, "cancelled")

    def test_a_call_after_ctrl_c_is_solved(self):
        interrupt_after(0.2)
        with self.assertRaises(KeyboardInterrupt):
            local().solve(request("cancelled"))
        self.assertEqual(local().solve(request("arch")).summary.critical_type, "bifurcation")

    def test_handlers_are_left_as_they_were(self):
        reader, writer = socket.socketpair()
        self.addCleanup(reader.close)
        self.addCleanup(writer.close)
        writer.setblocking(False)
        before = signal.set_wakeup_fd(writer.fileno())
        self.addCleanup(signal.set_wakeup_fd, before)
        interrupt_after(0.2)
        with self.assertRaises(KeyboardInterrupt):
            local().solve(request("cancelled"))
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        self.assertEqual(signal.set_wakeup_fd(writer.fileno()), writer.fileno())
        self.assertEqual(reader.recv(10), bytes([signal.SIGINT]))  # who learned of signals before still does

    def test_a_programs_own_handler_runs_and_the_call_goes_on(self):
        pressed = []
        before = signal.signal(signal.SIGINT, lambda *_: pressed.append(True))
        self.addCleanup(signal.signal, signal.SIGINT, before)
        interrupt_after(0.1)
        while not pressed:  # a call may end before the signal comes
            result = local().solve(column(), snapthrough.Path(stop={"steps": 5000}, step={"max": 1e-5},
                                                              discretization={"elements": 20}))
        self.assertEqual((pressed, result.summary.termination), ([True], "steps"))

    def test_ctrl_c_ends_a_sweep_and_keeps_its_rows(self):
        sweep = snapthrough.Sweep(column(), snapthrough.Critical(), "grid", ["/summary/critical_load_factor"])
        sweep.parameter("K", "/model/foundations/0/stiffness", range={"from": 1, "to": 100, "count": 1000000})
        sweeping = local().sweep(sweep)
        next(sweeping)
        interrupt_after(0.3)
        with self.assertRaises(KeyboardInterrupt) as caught:
            sweeping.table()
        self.assertGreater(len(caught.exception.reached), 0)
        self.assertFalse(caught.exception.reached.complete)

    def test_a_stop_ends_it_from_another_thread(self):
        stop = snapthrough.Stop()
        threading.Timer(0.2, stop.request).start()
        with self.assertRaises(snapthrough.Cancelled) as caught:
            local().solve(request("cancelled"), stop=stop)
        self.assertEqual(caught.exception.reached.summary.termination, "cancelled")
        with self.assertRaises(snapthrough.Cancelled):  # it stops every later call, too
            local().solve(request("cancelled"), stop=stop)

    def test_an_exception_of_a_callback_stops_the_call_and_is_raised(self):
        def broken(progress):
            raise ZeroDivisionError(progress.done)

        with self.assertRaises(ZeroDivisionError):
            local().solve(request("cancelled"), on_progress=broken)
        raised = []

        def other_thread():
            try:
                local().solve(request("cancelled"), on_progress=broken)
            except ZeroDivisionError as error:
                raised.append(error)

        thread = threading.Thread(target=other_thread)
        thread.start()
        thread.join()
        self.assertEqual(len(raised), 1)

    def test_callbacks_are_called_on_the_callers_thread(self):
        threads = set()
        local().solve(request("arch"), on_progress=lambda progress: threads.add(threading.current_thread()))
        self.assertEqual(threads, {threading.current_thread()})

    def test_a_callback_may_solve(self):
        inner = []

        def nested(progress):
            if not inner:
                inner.append(local().solve(column(), snapthrough.Critical()))

        local().solve(request("arch"), on_progress=nested)
        self.assertEqual(inner[0].summary.critical_type, "bifurcation")


class Calls(Case):
    def test_threads_get_the_same_documents(self):
        expected = without_time(local().solve(request("arch")).document)
        shared, found = local(), []
        threads = [threading.Thread(target=lambda: found.append(without_time(shared.solve(request("arch")).document)))
                   for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [expected] * 8)

    def test_a_forked_process_solves(self):
        local().solve(column(), snapthrough.Critical())
        child = os.fork()
        if child == 0:
            status = 1
            try:
                status = 0 if local().solve(column(), snapthrough.Critical()).summary.critical_load_factor else 1
            finally:
                os._exit(status)
        deadline = time.monotonic() + 20
        while os.waitpid(child, os.WNOHANG) == (0, 0):
            self.assertLess(time.monotonic(), deadline, "the child hangs")
            time.sleep(0.01)

    def test_the_package_has_the_version_of_the_library(self):
        self.assertEqual(snapthrough.__version__, local().version)

    def test_check_names_every_mistake(self):
        check = local().check(request("wrong"))
        self.assertFalse(check.valid)
        self.assertEqual([[finding.pointer, finding.code] for finding in check.errors], EXPECTED["wrong"]["errors"])
        self.assertEqual(local().check(request("arch")).size.points, 1)

    def test_a_library_that_is_not_there_is_told(self):
        with self.assertRaises(snapthrough.LibraryNotFound) as caught:
            snapthrough.Local("/nowhere/libsnapthrough.so.1")
        self.assertIn("/nowhere/libsnapthrough.so.1", str(caught.exception))
        self.assertIn("PYTHONSNAPTHROUGH_LIBRARY", str(caught.exception))

    def test_the_environment_names_the_library(self):
        os.environ["PYTHONSNAPTHROUGH_LIBRARY"] = LIBRARY
        self.addCleanup(os.environ.pop, "PYTHONSNAPTHROUGH_LIBRARY")
        self.assertEqual(snapthrough.Local().library, LIBRARY)

    def test_results_are_stored_and_read_again(self):
        result = local().solve(request("pile"))
        again = snapthrough.Result.from_json(result.json)
        self.assertEqual(again.document, result.document)
        self.assertEqual(repr(again), repr(result))
        self.assertEqual(pickle.loads(pickle.dumps(result)).document, result.document)
        self.assertEqual(copy.deepcopy(result).summary, result.summary)
        with self.assertRaises(ValueError):
            snapthrough.Result.from_json(b"{}")

    def test_repr_says_what_was_found(self):
        text = repr(local().solve(request("warnings")))
        self.assertIn("Frame of three unequal bays", text)
        self.assertIn("warning nearly_unstable", text)

    def test_arrays_of_numpy_stand_in_documents(self):
        try:
            import numpy
        except ImportError:
            self.skipTest("numpy is not there")
        analysis = snapthrough.Static(load_factors=numpy.linspace(0.1, 0.3, 3))
        model = column().point_load("head", numpy.array([0, numpy.float32(-1)]))
        self.assertEqual(local().solve(model, analysis).static.load_factor, [0.1, 0.2, 0.3])


class Tables(Case):
    def test_columns_are_those_of_each_table(self):
        for name, tables in {"arch": ["points", "critical_points", "states"], "static": ["static", "states"],
                             "buckling": ["buckling"], "vibration": ["static", "vibrations", "states"]}.items():
            self.assertEqual(local().solve(request(name)).tables(), tables)

    def test_a_table_that_is_not_there_is_told(self):
        result = local().solve(request("buckling"))
        with self.assertRaisesRegex(ValueError, "static"):
            result.columns("static")
        with self.assertRaisesRegex(ValueError, "none of points"):
            result.columns("shapes")

    def test_points_of_all_branches(self):
        result = local().solve(request("frame"))
        columns = result.columns()
        self.assertEqual(columns["branch"], [branch.id for branch in result.branches for _ in branch.load_factor])
        self.assertEqual(columns["sway"], [value for branch in result.branches for value in branch.monitors["sway"]])

    def test_vibrations_have_a_row_for_each_load_factor_and_mode(self):
        columns = local().solve(request("vibration")).columns()
        self.assertEqual(list(zip(columns["load_factor"], columns["mode"])),
                         [(load, mode) for load in (0.0, 10.0, 25.0) for mode in (1, 2)])
        self.assertAlmostEqual(columns["omega_squared"][0], 1.8751040687 ** 4, places=3)
        self.assertEqual(columns["imaginary"][:4], [0.0] * 4)
        self.assertLess(columns["imaginary"][4], -1.0)
        self.assertEqual(columns["imaginary"][5], -columns["imaginary"][4])

    def test_frequencies_of_static_rows(self):
        document = json.loads(request("vibration"))
        document["analysis"] = {"type": "static", "load_factors": [0, 10], "output": {"frequencies": 2}}
        result, vibrations = local().solve(document), local().solve(request("vibration")).vibrations
        for mine, other in zip(result.static.frequencies, vibrations):
            for square, expected in zip(mine.omega_squared, other.frequencies.omega_squared):
                self.assertAlmostEqual(square / expected, 1, places=3)
        result.static.document["frequencies"][0] = None  # a one-sided support touches without pressure there
        self.assertIsNone(result.static.frequencies[0])

    def test_frames_and_arrays(self):
        try:
            import numpy
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("numpy and pandas are not there")
        result = local().solve(request("arch"))
        for table in result.tables():
            columns, frame, array = result.columns(table), result.to_pandas(table), result.to_numpy(table)
            self.assertEqual(list(frame.columns), list(columns))
            self.assertEqual(array.dtype.names, tuple(columns))
            self.assertEqual(frame["load_factor"].tolist(), columns["load_factor"])
            numpy.testing.assert_array_equal(array["load_factor"], columns["load_factor"])


if __name__ == "__main__":
    unittest.main()
