"""submit, wait and fetch against a service, and against servers that answer as one in trouble does.

  python3 tests/remote/remote_test.py BINARY
"""
import contextlib
import hashlib
import http.server
import json
import pathlib
import os
import pty
import re
import shutil
import signal
import ssl
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from service import PATIENCE, SOURCE, Service, eventually, plain_environment  # noqa: E402

BINARY = ""
EXAMPLES = SOURCE / "examples"


def run(*arguments, text="", env=None, seconds=240):
    """Exit status, standard output and standard error of the program."""
    done = subprocess.run([BINARY, *map(str, arguments)], input=text, capture_output=True, text=True, timeout=seconds,
                          check=False, env=env or plain_environment())
    return done.returncode, done.stdout, done.stderr


def get(url):
    return subprocess.run(["curl", "-sS", url], capture_output=True, check=True, text=True).stdout


def answers(service, job):
    """How often a service has told the status of a job."""
    return (service.path / "log").read_text(encoding="utf-8").count(f'"path":"/v1/jobs/{job}"')


def long_request():
    """A path of so many steps that it runs for minutes."""
    request = json.loads((EXAMPLES / "column_winkler.json").read_text(encoding="utf-8"))
    request["analysis"] = {"type": "path", "discretization": {"elements": 60, "order": 4},
                           "step": {"initial": 1e-6, "max": 1e-6}, "stop": {"steps": 1000000}}
    return json.dumps(request)


class AgainstAService(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.service = Service(BINARY, arguments=["--max-table-rows", "7"])
        cls.service.start()

    @classmethod
    def tearDownClass(cls):
        cls.service.__exit__()

    def ask(self, command, *arguments, **more):
        return run(command, *arguments, "--service", self.service.url, **more)

    def status_of(self, job):
        return json.loads(get(f"{self.service.url}/v1/jobs/{job}"))["status"]

    def submit(self, document, *arguments, text=""):
        status, out, err = self.ask("submit", document, *arguments, text=text)
        self.assertEqual((status, err), (0, ""))
        return out.strip()

    def test_a_result_is_that_of_solve(self):
        document = EXAMPLES / "arch_outside_base_k1e7.json"
        job = self.submit(document)
        self.assertEqual(self.ask("wait", job), (0, "successful\n", ""))
        status, out, err = self.ask("fetch", job)
        self.assertEqual(status, 0, err)
        fetched, solved = json.loads(out), json.loads(run("solve", document)[1])
        for result in (fetched, solved):
            result["diagnostics"].pop("wall_time_s")
        self.assertEqual(fetched, solved)
        self.assertEqual(self.ask("fetch", job, "--csv")[1], run("solve", "--csv", document)[1])
        self.assertEqual(self.ask("fetch", job, "--table", "critical_points")[1],
                         run("solve", "--table", "critical_points", document)[1])

    def test_warnings_are_shown_without_being_asked_for(self):
        document = EXAMPLES / "frame_nearly_unstable.json"
        job = self.submit(document)
        self.ask("wait", job)
        warnings = run("solve", document)[2]
        self.assertIn("Warning: ", warnings)
        self.assertEqual(self.ask("fetch", job)[2], warnings)
        self.assertEqual(self.ask("fetch", job, "--csv")[2], warnings)

    def test_a_sweep_is_that_of_the_command_line(self):
        document = json.loads((EXAMPLES / "sweeps" / "frame_bays.json").read_text(encoding="utf-8"))
        document["parameters"][0]["range"]["count"] = 23   # four parts of seven rows
        text = json.dumps(document)
        sweep = self.submit("-", text=text)
        self.assertEqual(self.ask("wait", sweep)[:2], (0, "successful\n"))
        self.assertEqual(self.ask("fetch", sweep, "--csv")[1], run("sweep", "-", "--csv", text=text)[1])
        self.assertEqual(self.ask("fetch", sweep, "--ndjson")[1], run("sweep", "-", "--ndjson", text=text)[1])
        table = json.loads(self.ask("fetch", sweep)[1])
        self.assertEqual(table["points"], list(range(23)))
        self.assertEqual(table["rows"], json.loads(run("sweep", "-", text=text)[1])["rows"])

    def test_a_table_of_one_part_is_the_bytes_of_the_service(self):
        document = EXAMPLES / "sweeps" / "lining_thickness.json"
        sweep = self.submit(document)
        self.ask("wait", sweep)
        table = json.loads(self.ask("fetch", sweep)[1])
        self.assertEqual(table["rows"], json.loads(run("sweep", document)[1])["rows"])

    def test_mistakes_are_told_as_check_tells_them(self):
        for member, value in (("model", None), ("analysis", {"type": "walk"})):
            request = json.loads((EXAMPLES / "arch_no_base.json").read_text(encoding="utf-8"))
            request[member] = value
            told = run("check", "-", text=json.dumps(request))
            self.assertEqual(told[0], 2)
            self.assertEqual(self.ask("submit", "-", text=json.dumps(request)), told)
            self.assertEqual(self.ask("submit", "-", "--label", "a", text=json.dumps(request)), told)
        self.assertEqual(self.ask("submit", "-", text="{")[0::2], run("check", "-", text="{")[0::2])
        sweep = {**json.loads((EXAMPLES / "sweeps" / "frame_bays.json").read_text(encoding="utf-8")), "outputs": ["/nothing"]}
        self.assertEqual(self.ask("submit", "-", text=json.dumps(sweep)), run("check", "-", text=json.dumps(sweep)))

    def test_a_label_is_stored_and_a_wrong_one_refused(self):
        job = self.submit(EXAMPLES / "arch_no_base.json", "--label", 'bay "7" \\ ü')
        done = subprocess.run(["curl", "-sS", f"{self.service.url}/v1/jobs/{job}"], capture_output=True, check=True)
        self.assertEqual(json.loads(done.stdout)["label"], 'bay "7" \\ ü')
        status, out, err = self.ask("submit", EXAMPLES / "arch_no_base.json", "--label", "x" * 201)
        self.assertEqual((status, out), (2, ""))
        self.assertIn("/label: ", err)
        envelope = json.dumps({"request": json.loads((EXAMPLES / "arch_no_base.json").read_text(encoding="utf-8"))})
        self.assertEqual(self.ask("submit", "-", text=envelope)[0], 0)
        self.assertEqual(self.ask("submit", "-", "--label", "a", text=envelope)[0], 1)

    def test_the_same_idempotency_key_is_the_same_job(self):
        first = self.submit(EXAMPLES / "arch_no_base.json", "--idempotency-key", "night-7")
        self.assertEqual(self.submit(EXAMPLES / "arch_no_base.json", "--idempotency-key", "night-7"), first)
        status, out, err = self.ask("submit", EXAMPLES / "arch_outside_base_k1e7.json", "--idempotency-key", "night-7")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("idempotency-key-reused", err)

    def test_an_analysis_that_fails_gives_what_it_reached(self):
        request = json.loads((EXAMPLES / "arch_no_base.json").read_text(encoding="utf-8"))
        request["analysis"] = {"type": "static", "load_factors": [1.0, 1e6]}
        text = json.dumps(request)
        solved = run("solve", "-", text=text)
        self.assertEqual(solved[0], 3, "the arch does not carry that load")
        job = self.submit("-", text=text)
        status, out, err = self.ask("wait", job)
        self.assertEqual((status, out), (3, "failed\n"))
        self.assertIn(err.strip(), solved[2])
        status, out, err = self.ask("fetch", job)
        self.assertEqual((status, err), (3, solved[2]))
        self.assertEqual(json.loads(out)["failure"], json.loads(solved[1])["failure"])
        self.assertEqual(self.ask("fetch", job, "--csv")[:2], (3, ""))

    def test_rows_with_errors_are_told(self):
        document = json.loads((EXAMPLES / "sweeps" / "lining_thickness.json").read_text(encoding="utf-8"))
        document["parameters"][0] = {"name": "t", "values": [0.1, -1.0], "targets": [{"pointer": "/model/sections/0/EI"}]}
        sweep = self.submit("-", text=json.dumps(document))
        status, out, err = self.ask("wait", sweep)
        self.assertEqual((status, out), (3, "failed\n"))
        self.assertIn("points could not be completed", err)
        status, out, err = self.ask("fetch", sweep, "--csv")
        self.assertEqual((status, len(out.splitlines())), (3, 5))
        self.assertIn("points could not be completed", err)

    def test_what_has_not_ended_is_told_by_the_status(self):
        job = self.submit("-", text=long_request())
        begun = time.monotonic()
        status, out, err = self.ask("wait", job, "--timeout", "1")
        self.assertEqual(status, 4, err)
        self.assertIn(out, ("accepted\n", "running\n"))
        self.assertGreaterEqual(time.monotonic() - begun, 1.0)
        self.assertEqual(self.ask("fetch", job)[:2], (4, ""))
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "result.json"
            self.assertEqual(self.ask("fetch", job, "-o", output)[0], 4)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])
        answered = answers(self.service, job)
        waiting = subprocess.Popen([BINARY, "wait", job, "--service", self.service.url], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, env=plain_environment())
        self.assertTrue(eventually(lambda: answers(self.service, job) > answered), "it asks, and then waits")
        waiting.send_signal(signal.SIGINT)
        out, err = waiting.communicate(timeout=PATIENCE)
        self.assertEqual((waiting.returncode, out), (130, ""))
        self.assertIn(job, err)
        self.assertIn(self.status_of(job), ("accepted", "running"), "it did not wait for the end")
        subprocess.run(["curl", "-sS", "-d", "", f"{self.service.url}/v1/jobs/{job}/dismiss"], capture_output=True, check=True)
        self.assertEqual(self.ask("wait", job), (3, "dismissed\n", "The job was dismissed\n"))
        self.assertEqual(self.ask("fetch", job), (3, "", "The job was dismissed\n"))

    def test_a_terminal_shows_how_far_it_is(self):
        job = self.submit("-", text=long_request())
        self.assertTrue(eventually(lambda: self.status_of(job) == "running"))
        master, slave = pty.openpty()
        waiting = subprocess.Popen([BINARY, "wait", job, "--service", self.service.url, "--timeout", "2"],
                                   stdout=subprocess.PIPE, stderr=slave, env=plain_environment())
        out = waiting.communicate(timeout=PATIENCE)[0]
        os.close(slave)
        shown = os.read(master, 10000).decode()
        os.close(master)
        self.assertEqual((waiting.returncode, out), (4, b"running\n"))
        self.assertTrue(shown.startswith("\r"), shown)
        subprocess.run(["curl", "-sS", "-X", "DELETE", f"{self.service.url}/v1/jobs/{job}"], capture_output=True, check=True)

    def test_files_get_their_name_when_they_are_whole(self):
        job = self.submit(EXAMPLES / "arch_no_base.json")
        self.ask("wait", job)
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder) / "result.json"
            self.assertEqual(self.ask("fetch", job, "-o", output), (0, "", ""))
            self.assertEqual(output.read_text(encoding="utf-8"), self.ask("fetch", job)[1])
            self.assertEqual([path.name for path in pathlib.Path(folder).iterdir()], ["result.json"])
            self.assertEqual(self.ask("fetch", job, "-o", pathlib.Path(folder) / "none" / "result.json")[0], 1)

    def test_wrong_arguments_are_told(self):
        nobody = "01a21330-745b-7209-86f5-ddfe0289a59e"
        for arguments, told in ((("wait", nobody), "no-such-sweep"), (("fetch", nobody), "no-such-sweep"),
                                (("wait", "../limits"), "is no id"), (("submit", "none.json"), "cannot read none.json")):
            status, out, err = self.ask(*arguments)
            self.assertEqual((status, out), (1, ""))
            self.assertIn(told, err)
        for address in ("127.0.0.1:8080", "ftp://127.0.0.1", "http://", "http://a?b"):
            status, out, err = run("wait", nobody, "--service", address)
            self.assertEqual((status, out), (1, ""))
            self.assertIn(address, err)

    def test_the_environment_names_the_service(self):
        env = plain_environment(SNAPTHROUGH_SERVICE=self.service.url)
        status, out, _ = run("submit", EXAMPLES / "arch_no_base.json", env=env)
        self.assertEqual(status, 0)
        self.assertEqual(run("wait", out.strip(), env=env)[1], "successful\n")

    def test_a_service_that_restarts_is_waited_for(self):
        with Service(BINARY) as service:
            job = run("submit", "-", "--service", service.url, text=long_request())[1].strip()
            waiting = subprocess.Popen([BINARY, "wait", job, "--service", service.url, "--patience", "600"],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=plain_environment())
            self.assertTrue(eventually(lambda: answers(service, job) > 0))
            service.stop()
            self.assertIn("trying again", waiting.stderr.readline())
            service.start()
            subprocess.run(["curl", "-sS", "-d", "", f"{service.url}/v1/jobs/{job}/dismiss"], capture_output=True, check=True)
            out, err = waiting.communicate(timeout=PATIENCE)
            self.assertEqual((waiting.returncode, out), (3, "dismissed\n"), err)


class ThePage(unittest.TestCase):
    def test_its_commands_do_what_it_says(self):
        page = (SOURCE / "docs" / "howto" / "use-a-service-from-the-command-line.md").read_text(encoding="utf-8")
        blocks = re.findall(r"^```sh\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), 3)
        with Service(BINARY) as service, tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "examples").symlink_to(EXAMPLES)
            (pathlib.Path(folder) / "snapthrough").symlink_to(BINARY)
            script = "set -euo pipefail\n" + "".join(blocks).replace("http://127.0.0.1:8080", service.url)
            env = plain_environment(PATH=f"{folder}:{os.environ['PATH']}")
            done = subprocess.run(["bash", "-c", script], cwd=folder, env=env, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout), (0, "successful\n" * 3), done.stderr)
            for name in ("result.json", "path.csv", "lining.csv", "night.json"):
                self.assertGreater((pathlib.Path(folder) / name).stat().st_size, 100, name)


class WithKeys(unittest.TestCase):
    def test_a_key_is_read_from_its_file(self):
        key = "0123456789abcdef" * 4
        settings = f'[[keys]]\nowner = "ann"\nsha256 = "{hashlib.sha256(key.encode()).hexdigest()}"\n'
        with Service(BINARY, settings) as service:
            file = service.path / "key"
            file.write_text(key + "\n", encoding="utf-8")
            document = EXAMPLES / "arch_no_base.json"
            status, out, err = run("submit", document, "--service", service.url)
            self.assertEqual((status, out), (1, ""))
            self.assertIn("unauthorized", err)
            self.assertIn("--key-file", err)
            status, out, err = run("submit", document, "--service", service.url, "--key-file", file)
            self.assertEqual(status, 0, err)
            self.assertIn("others can read the key", err)
            file.chmod(0o600)
            env = plain_environment(SNAPTHROUGH_SERVICE=service.url, SNAPTHROUGH_KEY_FILE=str(file))
            self.assertEqual(run("wait", out.strip(), env=env), (0, "successful\n", ""))
            self.assertNotIn(key, out + err)
            file.write_text("\n", encoding="utf-8")
            self.assertIn("no key", run("wait", out.strip(), env=env)[2])


class Scripted(http.server.BaseHTTPRequestHandler):
    """Answers as its server's list says: (status, headers, body), or a function of the handler."""

    def answer(self):
        length = int(self.headers.get("Content-Length", 0))
        self.server.asked.append((self.command, self.path, dict(self.headers), self.rfile.read(length)))
        reply = self.server.replies.pop(0)
        if callable(reply):
            reply(self)
            return
        status, headers, body = reply
        data = body if isinstance(body, bytes) else json.dumps(body).encode()
        self.send_response(status)
        for name, value in {"Content-Length": str(len(data)), **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(data)

    do_GET = do_POST = answer  # noqa: N815

    def log_message(self, *unused):
        pass


class AgainstTrouble(unittest.TestCase):
    def serve(self, *replies):
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Scripted)
        server.replies, server.asked = list(replies), []
        thread = threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True)
        thread.start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        return server, f"http://127.0.0.1:{server.server_address[1]}"

    full = (429, {"Retry-After": "1"}, {"type": "urn:snapthrough:problem:queue-full", "detail": "the queue is full"})
    away = (503, {}, b"")
    taken = (201, {}, {"id": "0a", "status": "accepted"})

    @staticmethod
    def broken(handler):
        """An acknowledgement that is lost."""
        handler.close_connection = True
        handler.connection.close()

    @staticmethod
    def short(handler):
        """A response that ends before it is whole."""
        handler.send_response(200)
        handler.send_header("Content-Length", "1000")
        handler.send_header("X-Complete", "true")
        handler.end_headers()
        handler.wfile.write(b'{"columns": [')
        handler.close_connection = True

    @staticmethod
    def without_last_chunk(handler):
        handler.protocol_version = "HTTP/1.1"
        handler.send_response(200)
        handler.send_header("Transfer-Encoding", "chunked")
        handler.send_header("X-Complete", "true")
        handler.end_headers()
        handler.wfile.write(b"5\r\na,b\r\n\r\n")
        handler.close_connection = True

    def test_a_full_queue_is_tried_again_when_it_says(self):
        server, url = self.serve(self.full, self.away, self.broken, self.taken)
        begun = time.monotonic()
        status, out, err = run("submit", EXAMPLES / "arch_no_base.json", "--service", url)
        self.assertEqual((status, out), (0, "0a\n"), err)
        self.assertGreaterEqual(time.monotonic() - begun, 1 + 1 + 2 - 0.5)
        self.assertEqual(err.count("trying again"), 3)
        keys = {headers["Idempotency-Key"] for _, _, headers, _ in server.asked}
        self.assertEqual((len(server.asked), len(keys)), (4, 1), "a repeated request is the same job")

    def test_patience_ends(self):
        _, url = self.serve(self.full, self.full, self.full)
        status, out, err = run("submit", EXAMPLES / "arch_no_base.json", "--service", url, "--patience", "0")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("the queue is full", err)
        server, url = self.serve((429, {"Retry-After": "1800"}, self.full[2]))
        status, _, err = run("submit", EXAMPLES / "arch_no_base.json", "--service", url)
        self.assertEqual((status, len(server.asked)), (1, 1))
        self.assertNotIn("trying again", err)

    def test_nothing_there_fails_at_once(self):
        status, out, err = run("submit", EXAMPLES / "arch_no_base.json", "--service", "http://127.0.0.1:1")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("no answer from http://127.0.0.1:1", err)
        self.assertNotIn("trying again", err)

    def test_what_is_no_service_is_not_believed(self):
        for reply in ((200, {}, b"<html>"), (200, {}, {"status": "accepted"}), (301, {"Location": "/"}, b""), (404, {}, b"no"),
                      (200, {}, []), (500, {}, {"detail": "broken"})):
            _, url = self.serve(reply)
            status, out, err = run("submit", EXAMPLES / "arch_no_base.json", "--service", url, "--patience", "0")
            self.assertEqual((status, out), (1, ""), reply)
            self.assertNotEqual(err, "")
            for command in ("wait", "fetch"):
                _, url = self.serve(*[reply] * 6)
                status, out, err = run(command, "0a", "--service", url, "--patience", "0", "--timeout" if command == "wait" else "-o",
                                       "1" if command == "wait" else "/dev/null")
                self.assertEqual((status, out), (1, ""), (command, reply))
                self.assertNotEqual(err, "")

    def test_a_table_that_is_not_whole_is_not_written(self):
        found = (404, {}, {"type": "urn:snapthrough:problem:no-such-job", "detail": "none"})
        sweep = (200, {}, {"id": "0a", "status": "successful", "points": 2, "counts": {}})
        limits = (200, {}, {"table_rows": 10})
        for trouble in (self.short, self.without_last_chunk, self.broken):
            with tempfile.TemporaryDirectory() as folder:
                _, url = self.serve(found, sweep, limits, trouble, sweep)
                status, out, err = run("fetch", "0a", "--csv", "--service", url, "--patience", "0", "-o",
                                       pathlib.Path(folder) / "table.csv")
                self.assertEqual((status, out), (1, ""), err)
                self.assertEqual(list(pathlib.Path(folder).iterdir()), [])

    @staticmethod
    def endless(handler):
        """A response whose body has no end."""
        handler.send_response(200)
        handler.end_headers()
        with contextlib.suppress(OSError):
            while True:
                handler.wfile.write(b" " * 65536)
        handler.close_connection = True

    @staticmethod
    def endless_head(handler):
        """A response whose head has a line without end."""
        handler.wfile.write(b"HTTP/1.1 200 OK\r\nX-Long: ")
        AgainstTrouble.endless_rest(handler)

    @staticmethod
    def endless_rest(handler):
        with contextlib.suppress(OSError):
            while True:
                handler.wfile.write(b"x" * 65536)
        handler.close_connection = True

    def silent(self, handler):
        """No response until the test ends."""
        self.over.wait(600)
        handler.close_connection = True

    def setUp(self):
        self.over = threading.Event()
        self.addCleanup(self.over.set)

    def run_small(self, *arguments):
        """The program with 512 MiB of address space. It ends as run() tells, and is not killed for want of memory."""
        script = 'ulimit -v 524288; exec "$0" "$@"'
        done = subprocess.run(["bash", "-c", script, BINARY, *map(str, arguments)], capture_output=True, text=True, timeout=240,
                              check=False, env=plain_environment())
        return done.returncode, done.stdout, done.stderr

    def test_an_answer_without_end_is_not_held(self):
        for answer, told in ((self.endless, "more than 16 MiB"), (self.endless_head, "no answer from")):
            for command in (("submit", EXAMPLES / "arch_no_base.json"), ("wait", "0a"), ("fetch", "0a")):
                server, url = self.serve(*[answer] * 20)
                status, out, err = self.run_small(*command, "--service", url, "--patience", "0")
                self.assertEqual((status, out), (1, ""), err)
                self.assertIn(told, err)
                self.assertEqual(len(server.asked), 1, "an answer that is too long is not asked for again")

    def test_a_result_goes_to_its_file_and_is_not_held(self):
        job = (200, {}, {"id": "0a", "status": "successful"})
        rows = b'{"warnings": [{"detail": "soft \\u001b[31m", "code": "w"}], "rows": [' + b"1.5, " * 20_000_000 + b"1]}"
        with tempfile.TemporaryDirectory() as folder:
            _, url = self.serve(job, self.short, (200, {}, rows))
            status, out, err = self.run_small("fetch", "0a", "--service", url, "-o", pathlib.Path(folder) / "result.json")
            self.assertEqual((status, out), (0, ""), err)
            self.assertIn("Warning: soft \\u001b[31m [w]\n", err)
            self.assertIn("trying again", err)
            self.assertEqual([file.name for file in pathlib.Path(folder).iterdir()], ["result.json"])
            self.assertEqual((pathlib.Path(folder) / "result.json").read_bytes(), rows)

    def test_a_device_is_written_and_not_replaced(self):
        job = (200, {}, {"id": "0a", "status": "successful"})
        with tempfile.TemporaryDirectory() as folder:
            pipe = pathlib.Path(folder) / "pipe"
            os.mkfifo(pipe)
            _, url = self.serve(job, (200, {}, {"rows": [1]}))
            with subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE, text=True) as reading:
                self.assertEqual(run("fetch", "0a", "--service", url, "-o", pipe)[0], 0)
                self.assertEqual(json.loads(reading.communicate(timeout=60)[0]), {"rows": [1]})
            self.assertEqual(os.listdir(folder), ["pipe"])

    def test_patience_bounds_the_wait_for_a_silent_service(self):
        _, url = self.serve(self.silent)
        status, out, err = run("wait", "0a", "--service", url, "--patience", "1")
        self.assertEqual((status, out), (1, ""), err)
        self.assertIn("no complete answer within 10 s (--patience)", err)

    def test_texts_of_a_service_do_not_command_the_terminal(self):
        text = "\x1b]0;title\x07\x1b[2J\r\x7f\u009b31m é"
        told = "\\u001b]0;title\\u0007\\u001b[2J\\u000d\\u007f\\u009b31m é"
        problem = {"type": "urn:snapthrough:problem:" + text, "detail": text, "request_id": text}
        finding = {**problem, "errors": [{"pointer": "/" + text, "code": text, "detail": text}]}
        failed = {"id": "0a", "status": "failed", "error": {"detail": text, "code": text}, "message": text}
        reached = {"type": ":analysis-failed", "detail": text, "reached": {"warnings": [{"detail": text, "code": text}]}}
        submit = ("submit", EXAMPLES / "arch_no_base.json")
        for command, *replies in ((submit, (400, {}, problem)), (submit, (422, {}, finding)), (submit, (201, {}, {"id": text})),
                                  (("wait", "0a"), (200, {}, failed)), (("wait", "0a"), (200, {}, {"id": "0a", "status": text})),
                                  (("fetch", "0a"), (200, {}, {**failed, "status": "running"})),
                                  (("fetch", "0a", "--csv"), (200, {}, failed), (422, {}, reached))):
            _, url = self.serve(*replies)
            status, out, err = run(*command, "--service", url, "--patience", "0")
            self.assertNotEqual(status, 0)
            self.assertIsNone(re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", out + err), (out, err))
            if replies[0][2].get("id") != text:
                self.assertIn(told, out + err)

    @unittest.skipUnless(shutil.which("openssl"), "no openssl to make a certificate")
    def test_https_is_verified(self):
        with tempfile.TemporaryDirectory() as folder:
            certificate, key = pathlib.Path(folder) / "certificate.pem", pathlib.Path(folder) / "key.pem"
            subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "1",
                            "-subj", "/CN=127.0.0.1", "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", key, "-out", certificate],
                           check=True, capture_output=True)
            server, url = self.serve(self.taken)
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(certificate, key)
            server.socket = context.wrap_socket(server.socket, server_side=True)
            url = url.replace("http:", "https:")
            status, out, err = run("submit", EXAMPLES / "arch_no_base.json", "--service", url)
            self.assertEqual((status, out), (1, ""), err)
            self.assertEqual(server.asked, [], "nothing is sent to who is not known")
            status, out, err = run("submit", EXAMPLES / "arch_no_base.json", "--service", url, "--ca-file", certificate)
            self.assertEqual((status, out), (0, "0a\n"), err)

    def test_an_address_may_have_a_path(self):
        server, url = self.serve(self.taken)
        self.assertEqual(run("submit", EXAMPLES / "arch_no_base.json", "--service", url + "/snapthrough/")[1], "0a\n")
        self.assertEqual(server.asked[0][1], "/snapthrough/v1/jobs")

    def test_the_interruption_of_submit_tells_how_to_go_on(self):
        server, url = self.serve(self.silent)
        asking = subprocess.Popen([BINARY, "submit", EXAMPLES / "arch_no_base.json", "--service", url, "--idempotency-key", "n7"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=plain_environment())
        self.assertTrue(eventually(lambda: server.asked))
        asking.send_signal(signal.SIGINT)
        out, err = asking.communicate(timeout=PATIENCE)
        self.assertEqual((asking.returncode, out), (130, ""))
        self.assertIn("--idempotency-key n7", err)


if __name__ == "__main__":
    BINARY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=1)
