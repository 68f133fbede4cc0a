"""Client: the same answers by a service, and what a network adds."""
import csv
import gzip
import http.server
import io
import json
import pathlib
import socket
import ssl
import subprocess
import tempfile
import threading
import time
import unittest
import warnings

from .support import (EXPECTED, SWEEP, Case, Service, column, interrupt_after, local, request, shared_table,
                      snapthrough, without_time)


class WithService(Case):
    @classmethod
    def setUpClass(cls):
        cls.service = Service()
        cls.client = snapthrough.Client(cls.service.url)

    @classmethod
    def tearDownClass(cls):
        cls.service.stop()


class SameAnswers(WithService):
    def outcome(self, solver, name):
        """What a solver makes of a shared request: document or exception, and warnings."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                told = ("done", without_time(solver.solve(request(name)).document))
            except snapthrough.InvalidRequest as error:
                told = ("wrong", str(error), [finding.document for finding in error.findings])
            except snapthrough.AnalysisFailed as error:
                told = ("failed", error.code, error.detail, without_time(error.reached.document))
        return told, [str(warning.message) for warning in caught]

    def test_the_thirteen_requests_bit_for_bit(self):
        for name, expected in EXPECTED.items():
            if name == "cancelled":
                continue
            with self.subTest(name):
                mine, service = self.outcome(local(), name), self.outcome(self.client, name)
                self.assertEqual(mine, service)
                self.assertEqual(service[0][0], expected["outcome"])
                self.assertEqual(len(service[1]), len(expected.get("warnings", [])))

    def test_a_cancelled_request(self):
        steps = []
        with self.assertRaises(snapthrough.Cancelled):
            self.client.solve(request("cancelled"), on_progress=lambda progress: steps.append(progress) or False)
        self.assertGreaterEqual(len(steps), 1)
        self.assertEqual(next(self.client.jobs()).status, "dismissed")

    def test_the_sweep_of_500_points_byte_for_byte(self):
        mine, service = shared_table(), self.client.sweep(SWEEP).table()
        self.assertEqual(mine.rows, service.rows)
        self.assertEqual(mine.to_csv(), service.to_csv())
        self.assertEqual(mine.to_json(), service.to_json())
        self.assertEqual((len(service), service.failed), (500, 50))

    def test_a_wrong_sweep(self):
        document = json.loads(SWEEP)
        document["outputs"].append("/summary/critical_load")
        found = []
        for solver in (local(), self.client):
            with self.assertRaises(snapthrough.InvalidRequest) as caught:
                solver.sweep(document)
            found.append(str(caught.exception))
        self.assertEqual(found[0], found[1])
        self.assertIn("did you mean /summary/critical_load_factor", found[0])

    def test_checks(self):
        for text in (request("arch"), request("wrong"), SWEEP, "{}", "{"):
            self.assertEqual(local().check(text).document, self.client.check(text).document)

    def test_tables_have_the_columns_and_values_of_the_services_csv(self):
        for name, tables in {"frame": ["points", "critical_points", "states"], "static": ["static", "states"],
                             "buckling": ["buckling"], "vibration": ["vibrations", "static", "states"]}.items():
            result = local().solve(request(name))
            job = self.client.wait(self.client.submit(request(name)))
            for table in tables:
                response = self.client._http.send("GET", f"/v1/jobs/{job.id}/result?format=csv&table={table}")
                head, *rows = csv.reader(io.StringIO(response.body.decode("utf-8"), newline=""))
                columns = result.columns(table)
                self.assertEqual(list(columns), head)
                for mine, theirs in zip(zip(*columns.values()), rows):
                    self.assertEqual([same_form(value) for value in mine], [as_number(value) for value in theirs])
                self.assertEqual(len(rows), len(columns["load_factor"]))


def same_form(value):
    """A value as as_number() has its field."""
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else float(value) if isinstance(value, (int, float)) else value


def as_number(field):
    """The number of a field of CSV, or the field."""
    try:
        return float(field)
    except ValueError:
        return field


class Jobs(WithService):
    def test_a_job_from_its_submission_to_its_removal(self):
        job = self.client.submit(request("pile"), label="pile 7", metadata={"site": "north"})
        self.assertEqual(self.client.wait(job).status, "successful")
        self.assertEqual([found.id for found in self.client.jobs(label="pile 7")], [job.id])
        self.assertEqual(self.client.job(job.id).metadata, {"site": "north"})
        self.assertEqual(self.client.request(job), json.loads(request("pile")))
        self.assertEqual(len(self.client.result(job).states), 2)
        self.client.remove(job)
        with self.assertRaises(snapthrough.ServiceError) as caught:
            self.client.job(job)
        self.assertEqual((caught.exception.status, caught.exception.problem.type),
                         (410, "urn:snapthrough:problem:deleted"))

    def test_events_of_a_job(self):
        events = list(self.client.events(self.client.submit(request("arch"))))
        self.assertEqual(events[-1].name, "end")
        self.assertEqual(events[-1].data.status, "successful")
        found = [event.data for event in events if event.name == "critical_point" and event.data.final]
        self.assertEqual([point.type for point in found], ["bifurcation", "limit_max"])
        again = list(self.client.events(events[-1].data.id, last_id=events[-2].id))
        self.assertEqual([event.id for event in again], [events[-1].id])

    def test_events_of_a_sweep(self):
        sweep = self.client.submit_sweep(SWEEP, label="shared")
        events = list(self.client.sweep_events(sweep))
        self.assertEqual(events[-1].data.counts.failed, 50)
        self.assertEqual(self.client.sweep_status(sweep).label, "shared")
        self.assertEqual([found.id for found in self.client.sweeps(label="shared")], [sweep.id])
        self.assertEqual(len(self.client.table(sweep, 490, 100)), 10)
        self.client.remove_sweep(sweep)

    def test_progress_of_an_analysis(self):
        found = []
        snapthrough.Client(self.service.url).solve(
            column(title="progress"), snapthrough.Path(stop={"steps": 400}, step={"max": 1e-4},
                                                       discretization={"elements": 40}), on_progress=found.append)
        self.assertTrue(all(isinstance(progress, snapthrough.Progress) for progress in found))

    def test_ctrl_c_dismisses_the_job(self):
        for on_progress in (None, lambda progress: None):
            interrupt_after(0.5)
            with self.assertRaises(KeyboardInterrupt):
                self.client.solve(request("cancelled"), on_progress=on_progress)
            self.assertEqual(next(self.client.jobs()).status, "dismissed")

    def test_ctrl_c_dismisses_the_sweep(self):
        sweep = snapthrough.Sweep(column(), snapthrough.Critical(), "grid", ["/summary/critical_load_factor"])
        sweep.parameter("K", "/model/foundations/0/stiffness", range={"from": 1, "to": 100, "count": 100000})
        sweeping = self.client.sweep(sweep)
        next(sweeping)
        interrupt_after(0.3)
        with self.assertRaises(KeyboardInterrupt) as caught:
            sweeping.table()
        self.assertGreater(len(caught.exception.reached), 0)
        self.assertEqual(next(self.client.sweeps()).status, "dismissed")

    def test_a_stop_dismisses_the_job(self):
        stop = snapthrough.Stop()
        threading.Timer(0.4, stop.request).start()
        with self.assertRaises(snapthrough.Cancelled):
            self.client.solve(request("cancelled"), stop=stop)
        self.assertEqual(next(self.client.jobs()).status, "dismissed")

    def test_limits_and_examples(self):
        self.assertGreater(self.client.limits().sweep_points, 1000)
        self.assertTrue(self.client.check(next(iter(self.client.examples().values()))).valid)

    def test_module_functions_after_connect(self):
        snapthrough.connect(self.service.url)
        self.addCleanup(setattr, snapthrough, "_connected", None)
        self.assertEqual(snapthrough.solve(request("ring")).summary.critical_type, "bifurcation")
        self.assertTrue(snapthrough.check(request("ring")).valid)

    def test_the_service_closing_a_kept_connection_is_not_seen(self):
        self.client.limits()
        self.client._http._of_thread.kept.connection.sock.shutdown(socket.SHUT_RDWR)
        self.assertGreater(self.client.limits().sweep_points, 1000)


class Keys(Case):
    def test_a_key_is_sent_and_wanted(self):
        import hashlib
        digest = hashlib.sha256(b"secret").hexdigest()
        service = Service(f'[[keys]]\nowner = "me"\nsha256 = "{digest}"\n')
        self.addCleanup(service.stop)
        with self.assertRaises(snapthrough.ServiceError) as caught:
            snapthrough.Client(service.url).limits()
        self.assertEqual(caught.exception.status, 401)
        self.assertGreater(snapthrough.Client(service.url, "secret").limits().sweep_points, 0)


class Scripted(http.server.BaseHTTPRequestHandler):
    """Answers with what the test laid ready, and keeps what came."""

    protocol_version = "HTTP/1.1"
    answers = []
    seen = []

    def do_GET(self):
        status, headers, body = self.answers.pop(0)
        self.seen.append(dict(self.headers))
        self.send_response(status)
        for name, value in {"Content-Length": str(len(body)), **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


class Refusals(Case):
    def setUp(self):
        super().setUp()
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Scripted)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)
        self.url = f"http://127.0.0.1:{self.server.server_port}"
        Scripted.answers, Scripted.seen = [], []

    def test_a_busy_service_is_asked_again_after_its_pause(self):
        Scripted.answers = [(429, {"Retry-After": "0.2"}, b"{}"), (503, {"Retry-After": "0.1"}, b"{}"),
                            (200, {}, b'{"nodes": 7}')]
        start = time.monotonic()
        self.assertEqual(snapthrough.Client(self.url).limits().nodes, 7)
        self.assertGreaterEqual(time.monotonic() - start, 0.3)

    def test_patience_ends(self):
        body = json.dumps({"type": "urn:snapthrough:problem:queue-full", "title": "Full", "status": 429,
                           "detail": "1000 jobs wait"}).encode()
        Scripted.answers = [(429, {"Retry-After": "30"}, body)]
        with self.assertRaises(snapthrough.ServiceError) as caught:
            snapthrough.Client(self.url, patience=1).limits()
        self.assertEqual(str(caught.exception), "429 queue-full: 1000 jobs wait")

    def test_compressed_responses_are_read(self):
        Scripted.answers = [(200, {"Content-Encoding": "gzip"}, gzip.compress(b'{"nodes": 7}'))]
        client = snapthrough.Client(self.url)
        self.assertEqual(client.limits().nodes, 7)
        self.assertNotEqual(Scripted.seen[0].get("Accept-Encoding"), "gzip")  # of no use on the loopback device

    def test_events_that_break_off_are_taken_up_after_what_was_seen(self):
        job = json.dumps({"id": "7", "status": "running"})
        first = f"id: 1\nevent: status\ndata: {job}\n\nid: 2\nevent: news\ndata: {{}}\n\n".encode()
        last = f": a comment\nid: 3\nevent: end\ndata: {job}\n\n".encode()
        stream = {"Content-Type": "text/event-stream"}
        Scripted.answers = [(200, stream, first), (200, stream, b""), (200, stream, last)]
        self.assertEqual([event.name for event in snapthrough.Client(self.url).events("7")], ["status", "end"])
        self.assertEqual([seen.get("Last-Event-ID") for seen in Scripted.seen], [None, "1", "1"])
        Scripted.answers = [(200, stream, b"")] * 5
        with self.assertRaisesRegex(snapthrough.ServiceError, "5 times"):
            list(snapthrough.Client(self.url).events("7"))

    def test_what_is_no_problem_document_is_told(self):
        Scripted.answers = [(502, {}, b"<html>bad gateway</html>")]
        with self.assertRaisesRegex(snapthrough.ServiceError, "502"):
            snapthrough.Client(self.url).limits()
        Scripted.answers = [(200, {}, b"<html>login</html>")]
        with self.assertRaisesRegex(snapthrough.ServiceError, "no JSON"):
            snapthrough.Client(self.url).limits()

    def test_no_service_is_told(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        with self.assertRaisesRegex(snapthrough.ServiceError, "no answer from"):
            snapthrough.Client(f"http://127.0.0.1:{port}").limits()

    def test_a_service_that_does_not_answer_is_told(self):
        client = snapthrough.Client(self.url, timeout=0.3)
        Scripted.answers = [(200, {}, b"{}"), (200, {"Content-Length": "10"}, b"{}")]
        client.limits()
        with self.assertRaisesRegex(snapthrough.ServiceError, "(?i)timed out"):
            client.limits()

    def test_an_address_that_is_none_is_told(self):
        for url in ("ftp://host", "http://", "http://host/?x=1"):
            with self.assertRaisesRegex(ValueError, "url"):
                snapthrough.Client(url)

    def test_https(self):
        with tempfile.TemporaryDirectory() as folder:
            made = subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj",
                                   "/CN=localhost", "-addext", "subjectAltName=DNS:localhost", "-keyout",
                                   folder + "/key.pem", "-out", folder + "/certificate.pem"], capture_output=True)
            self.assertEqual(made.returncode, 0, made.stderr)
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(folder + "/certificate.pem", folder + "/key.pem")
            self.server.socket = context.wrap_socket(self.server.socket, server_side=True)
            url = f"https://localhost:{self.server.server_port}"
            Scripted.answers = [(200, {}, b'{"nodes": 7}')]
            trusted = ssl.create_default_context(cafile=str(pathlib.Path(folder) / "certificate.pem"))
            self.assertEqual(snapthrough.Client(url, context=trusted).limits().nodes, 7)
            with self.assertRaisesRegex(snapthrough.ServiceError, "(?i)certificate"):
                snapthrough.Client(url).limits()


if __name__ == "__main__":
    unittest.main()
