"""Clients that harm a service, each as a process of its own. ATTACKS has them by name, with what each does.

An attack runs until its process is killed and writes what it met into a file: answers by status, closed connections, and
numbers of its own. Every process has the lowest priority but a few, so that on a small machine it is the service, not the
attackers' own work, that honest clients wait for.
"""
import collections
import http.client
import itertools
import json
import os
import pathlib
import select
import socket
import threading
import time

import attack_documents as documents
from service_process import HOST, open_files_as_many_as_allowed

NICE = 15
WITHOUT_KEY = ("slow_bodies", "slow_readers", "heads")
BODY = 8 << 20   # bytes that a body may have (max_body_bytes)
HEAD = 16 << 10  # bytes that a head may have (max_head_bytes)
# No connection, no HTTP, another document than one with the ids that an attack needs: it goes on with its next request.
FAILURES = (OSError, http.client.HTTPException, ValueError, LookupError, TypeError)


class Attacker:
    """What all attacks use: requests with the attack's own key from its own address, and the counts."""

    def __init__(self, name, port, key, counts, number, receiver):
        self.name = name
        self.port = port
        self.key = key
        self.file = pathlib.Path(counts)
        self.address = f"127.0.1.{number + 1}"  # another one than that of honest clients, as it would be in a network
        self.receiver = receiver                # port at which callbacks are received
        self.counts = collections.Counter()
        self.lock = threading.Lock()
        self.numbers = itertools.count()

    def count(self, what, amount=1):
        with self.lock:
            self.counts[what] += amount

    def largest(self, what, value):
        with self.lock:
            self.counts[what] = max(self.counts[what], value)

    def write_counts(self):
        with self.lock:
            text = json.dumps(self.counts)
        aside = self.file.with_suffix(".new")
        aside.write_text(text)
        aside.replace(self.file)

    def connect(self, host_number=None, receive=None):
        """A socket; `host_number`: another address, `receive`: bytes of its receive buffer."""
        client = socket.socket()
        if receive:
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive)
        client.settimeout(70)
        client.bind((self.address if host_number is None else f"127.0.2.{host_number + 1}", 0))
        client.connect((HOST, self.port))
        return client

    def head(self, method, path, length=None, **headers):
        fields = {"Host": "localhost", "Content-Type": "application/json", **headers}
        if self.key:
            fields["Authorization"] = f"Bearer {self.key}"
        if length is not None:
            fields["Content-Length"] = length
        lines = [f"{method} {path} HTTP/1.1"] + [f"{name.replace('_', '-')}: {value}" for name, value in fields.items()]
        return ("\r\n".join(lines) + "\r\n\r\n").encode()

    def ask(self, method, path, body=None, **headers):
        """(status, JSON or None); the status is counted."""
        connection = http.client.HTTPConnection(HOST, self.port, timeout=120, source_address=(self.address, 0))
        try:
            fields = {"Authorization": f"Bearer {self.key}", "Content-Type": "application/json"}
            fields |= {name.replace("_", "-"): value for name, value in headers.items()}
            connection.request(method, path, body, fields)
            response = connection.getresponse()
            text = response.read()
            self.count(str(response.status))
            is_json = response.headers.get_content_type().endswith("json")
            return response.status, json.loads(text) if is_json and text else None
        finally:
            connection.close()

    def repeat(self, threads, action, pause=0.0):
        """Takes an action again and again in `threads` threads, for ever."""
        def run():
            while True:
                try:
                    action()
                except FAILURES as problem:
                    self.count(type(problem).__name__)
                    time.sleep(0.2)
                time.sleep(pause)
        for _ in range(threads):
            threading.Thread(target=run, daemon=True).start()

    def hold(self, most, open_one, trickle=b"", longest=8.0):
        """Keeps `most` sockets of open_one() open for ever, sends `trickle` on each about once a second, reads nothing."""
        kept = {}  # socket: until when
        while True:
            for client in [one for one, until in kept.items() if until < time.monotonic()]:
                client.close()
                del kept[client]
            try:
                for _ in range(min(most - len(kept), 500)):
                    kept[open_one()] = time.monotonic() + longest
            except OSError as problem:
                self.count(type(problem).__name__)
            self.send_all(kept, trickle)
            self.largest("open at once", len(kept))
            time.sleep(1.0)

    def send_all(self, kept, trickle):
        poll = select.poll()
        by_number = {client.fileno(): client for client in kept}
        for number in by_number:
            poll.register(number, select.POLLRDHUP)
        for number, _ in poll.poll(0):  # the service has closed it
            self.count("closed by the service")
            client = by_number.pop(number)
            del kept[client]
            client.close()
        for client in by_number.values() if trickle else ():
            try:
                client.send(trickle)
            except OSError:
                pass  # the next poll() tells


def check_and_leave(attacker, document):
    """Sends a document to be checked; every second client leaves at once, the others wait for the answer."""
    if next(attacker.numbers) % 2:
        attacker.ask("POST", "/v1/check", document)
        return
    client = attacker.connect()
    client.sendall(attacker.head("POST", "/v1/check", len(document)) + document)
    client.close()
    attacker.count("left")


def curves(attacker):
    """2 000 curves with a thousand half waves each, to be checked and computed, four at a time"""
    document = documents.curves()
    attacker.repeat(4, lambda: attacker.ask("POST", ("/v1/check", "/v1/jobs")[next(attacker.numbers) % 2], document))


def sensitivities(attacker):
    """7 000 sensitivities of 3 500 members, 16 at a time, of which every second client leaves at once"""
    document = documents.sensitivities()
    attacker.repeat(16, lambda: check_and_leave(attacker, document), 0.2)


def slow_bodies(attacker):
    """80 senders without a key announce the largest body, every second one with Expect: 100-continue"""
    def send():
        number = next(attacker.numbers)
        client = attacker.connect(number % 8)
        expect = {"Expect": "100-continue"} if number % 2 else {}
        try:
            client.sendall(attacker.head("POST", "/v1/jobs", BODY, **expect))
            client.settimeout(5)
            if not expect:
                client.sendall(b"{" + b" " * 70_000)
            line = client.recv(64)
            attacker.count(line.split(b" ")[1].decode() if line.startswith(b"HTTP/") else "no answer within 5 s")
        finally:
            client.close()
    attacker.repeat(80, send, 0.5)


def slow_readers(attacker):
    """400 clients without a key ask for /v1/openapi.json and do not read"""
    def open_one():
        client = attacker.connect(next(attacker.numbers) % 8, receive=4096)
        client.sendall(attacker.head("GET", "/v1/openapi.json"))
        attacker.count("asked")
        return client
    attacker.hold(400, open_one, longest=40.0)


def heads(attacker):
    """3 000 connections without a key with heads of 15 KB that never end, from eight addresses"""
    start = b"GET /v1/limits HTTP/1.1\r\nHost: localhost\r\nX-Long: " + b"a" * (HEAD - 1500)

    def open_one():
        client = attacker.connect(next(attacker.numbers) % 8)
        client.sendall(start)
        attacker.count("begun")
        return client
    attacker.hold(3000, open_one, trickle=b"a")


def streams(attacker):
    """300 streams of events of one owner, of a job that does not end; nobody reads them"""
    def open_one():
        if not job:
            job.append(attacker.ask("POST", "/v1/jobs", documents.beck(0), Prefer="respond-async")[1]["id"])
        client = attacker.connect(receive=4096)
        client.sendall(attacker.head("GET", f"/v1/jobs/{job[0]}/events"))
        line = client.recv(13)
        attacker.count(line[9:12].decode() or "closed")
        return client
    job = []
    attacker.hold(300, open_one, longest=60.0)


def sweeps(attacker):
    """Eight active sweeps of 100 000 points of one owner"""
    def fill():
        _, found = attacker.ask("GET", "/v1/sweeps?limit=100")
        active = [one for one in found["sweeps"] if one["status"] in ("accepted", "running")]
        for _ in range(8 - len(active)):
            attacker.ask("POST", "/v1/sweeps", documents.sweep(int.from_bytes(os.urandom(3), "big")))
    attacker.repeat(1, fill, 2.0)


def titles(attacker):
    """Jobs with titles of 8 MB, and long lists of jobs"""
    document = documents.long_title()
    attacker.repeat(2, lambda: attacker.ask("POST", "/v1/jobs", document))
    attacker.repeat(2, lambda: attacker.ask("GET", "/v1/jobs?limit=1000"), 0.5)


def outputs(attacker):
    """Two sweeps whose rows have 600 KB each, and four readers of their tables"""
    def make():
        status, found = attacker.ask("POST", "/v1/sweeps", documents.sweep_of_large_rows(next(attacker.numbers)))
        if status in (200, 201):
            made.append(found["id"])
        time.sleep(20)

    def read():
        for sweep in made[-2:]:
            client = attacker.connect(receive=65536)
            client.sendall(attacker.head("GET", f"/v1/sweeps/{sweep}/table.csv", Connection="close"))
            while piece := client.recv(65536):
                attacker.count("MB read", len(piece) / 1e6)
            client.close()
    made = []
    attacker.repeat(1, make)
    attacker.repeat(4, read, 0.5)


def meshes(attacker):
    """32 checks at once of ten members with 100 000 elements each"""
    document = documents.meshes()
    attacker.repeat(32, lambda: attacker.ask("POST", "/v1/check", document), 0.5)


def callbacks(attacker):
    """Jobs whose callbacks are answered by a header line without an end"""
    def answer(client):
        sent = 0
        try:
            client.recv(65536)
            client.sendall(b"HTTP/1.1 200 OK\r\nX-Endless: ")
            while True:
                sent += client.send(b"a" * 65536)
        except OSError:
            attacker.largest("largest MB sent to one delivery", sent / 1e6)
            attacker.count("deliveries")

    def receive():
        with socket.create_server(("127.0.0.1", attacker.receiver), backlog=100) as server:
            while True:
                threading.Thread(target=answer, args=(server.accept()[0],), daemon=True).start()
    threading.Thread(target=receive, daemon=True).start()
    address = f"http://localhost:{attacker.receiver}/ended"
    attacker.repeat(2, lambda: attacker.ask("POST", "/v1/jobs", documents.small_job(next(attacker.numbers), address)), 0.2)


def beck(attacker):
    """Eight columns under following forces whose paths take minutes each"""
    def submit():
        job = attacker.ask("POST", "/v1/jobs", documents.beck(next(attacker.numbers)), Prefer="respond-async",
                           Cache_Control="no-cache")[1]["id"]
        while attacker.ask("GET", f"/v1/jobs/{job}", Prefer="wait=60")[1].get("finished") is None:
            time.sleep(1.0)
    attacker.repeat(8, submit)


def cancels(attacker):
    """Jobs that are dismissed, removed or left by eight clients as soon as they are there"""
    def cancel():
        number = next(attacker.numbers)
        document = documents.small_job(number) if number % 3 == 0 else documents.beck(number)
        if number % 3 == 0:
            client = attacker.connect()
            client.sendall(attacker.head("POST", "/v1/jobs", len(document), Prefer="wait=30") + document)
            client.close()
            attacker.count("left")
            return
        job = attacker.ask("POST", "/v1/jobs", document, Prefer="respond-async", Cache_Control="no-cache")[1]["id"]
        method, path = (("POST", f"/v1/jobs/{job}/dismiss"), ("DELETE", f"/v1/jobs/{job}"))[number % 2]
        attacker.ask(method, path, b"" if method == "POST" else None)
    attacker.repeat(8, cancel, 0.05)


ATTACKS = {attack.__name__: attack for attack in (
    curves, sensitivities, slow_bodies, slow_readers, heads, streams, sweeps, titles, outputs, meshes, callbacks, beck, cancels)}


def run(name, *arguments):
    """The whole of an attacker's process: arguments as those of Attacker."""
    os.nice(NICE)
    open_files_as_many_as_allowed()
    attacker = Attacker(name, *arguments)

    def write():
        while True:
            attacker.write_counts()
            time.sleep(1.0)
    threading.Thread(target=write, daemon=True).start()
    while True:
        try:
            ATTACKS[name](attacker)
            time.sleep(1e6)
        except FAILURES as problem:
            attacker.count(type(problem).__name__)
            time.sleep(1.0)
