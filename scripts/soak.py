#!/usr/bin/env python3
"""Keeps the service under a mixed load, with retention, callbacks and backups, and checks every answer.

  scripts/soak.py [MINUTES] [--load FRACTION] [--disk MB] [--program PATH]     needs a built tree (build/release)

At first the clients act as fast as answers come, for ten seconds; then at FRACTION (0.7) of that rate for MINUTES (30).
One line a minute says what was done and what the service holds. Exit status 1 when an answer was wrong, a response
5xx (other than 503 overloaded), news did not come, the log has an error, something leaks, or the last backup does not
answer. With --disk, which needs root, the store is on a disk of MB megabytes (a tmpfs), which is filled to its last byte
for FULL seconds after every tenth minute; requests that are refused meanwhile are sent again. A leak: the median of the last tenth of the minutes is more than that of the second tenth by a tenth and a slack
(LEAKS); of runs from 20 minutes on.
"""
import argparse
import dataclasses
import json
import multiprocessing
import os
import pathlib
import queue
import re
import shutil
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.soak_actions import Actions, Catalogue  # noqa: E402
from lib.soak_client import Connection, Findings, Load, probe  # noqa: E402
from lib.soak_hostile import HostileActions  # noqa: E402
from lib.soak_webhooks import LONGEST_WAIT, Receiver  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
CLIENTS = 8
CALIBRATION = 10     # s at full speed
KEEP_JOBS = 60       # s
BETWEEN_BACKUPS = 3  # minutes
BETWEEN_FULL = 10    # minutes
FULL = 20            # s of a full disk
SHORTEST_JUDGED = 20  # minutes
MB = 1 << 20
# What may not grow, and by how much it may differ beside a tenth.
LEAKS = {"memory": 4, "runners": 24, "descriptors": 10, "threads": 4, "store": 32}
GOOD_CODES = {"successful", "reused", "dismissed"}


@dataclasses.dataclass
class Minute:
    """A line of the table; the comments of the fields are the headings."""

    minute: int
    jobs: float         # jobs/s
    rows: float         # rows/s
    memory: float       # MB
    runners: float      # runners MB
    descriptors: int    # fds
    threads: int        # thr
    wal: float          # WAL MB
    store: float        # store MB
    log: int            # log B
    livez: tuple        # livez p50/p99 ms
    job: tuple          # job p50/p99 ms
    delivered: int      # told
    outstanding: int    # wait
    refused: int        # 503
    errors: int

    HEAD = ("  min  jobs/s  rows/s  MB  runners MB  fds  thr  WAL MB  store MB    log B"
            "  livez p50/p99 ms    job p50/p99 ms     told  wait  503  errors")

    def line(self):
        return (f"{self.minute:5d} {self.jobs:7.1f} {self.rows:7.0f} {self.memory:3.0f} {self.runners:11.0f}"
                f" {self.descriptors:4d} {self.threads:4d} {self.wal:7.1f} {self.store:9.1f} {self.log:8d}"
                f" {self.livez[0]:8.1f} /{self.livez[1]:7.1f} {self.job[0]:8.1f} /{self.job[1]:7.1f}"
                f" {self.delivered:8d} {self.outstanding:5d} {self.refused:4d} {self.errors:7d}")


class SmallDisk:
    """A folder on a tmpfs of its own, which can be filled."""

    def __init__(self, folder, megabytes):
        self.folder = folder
        folder.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", folder], check=True)

    def fill(self, seconds):
        """Keeps every byte that becomes free for `seconds`, then gives them back."""
        filler = self.folder / "filler"
        until = time.monotonic() + seconds
        with open(filler, "wb", buffering=0) as file:
            while time.monotonic() < until:
                try:
                    file.write(bytes(MB))
                except OSError:  # no space is left
                    time.sleep(0.05)
        filler.unlink()

    def close(self):
        subprocess.run(["umount", self.folder], check=True)
        self.folder.rmdir()


class Service:
    """The service as a process on a store."""

    def __init__(self, program, folder, store, receiver):
        self.store = folder / "disk" / store
        self.log = folder / (store + ".log")
        self.port = free_port()
        secret = folder / "secret"
        secret.write_text(receiver.secret())
        secret.chmod(0o600)
        settings = {"listen": f"127.0.0.1:{self.port}", "store": self.store, "keep-jobs-s": KEEP_JOBS,
                    "log-level": "warning", "callback-hosts": receiver.host, "callback-secret-file": secret}
        command = [program, "serve"] + [f"--{name}={value}" for name, value in settings.items()]
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=log)
        self.wait_until_ready()

    def wait_until_ready(self):
        for _ in range(100):
            try:
                self.call("GET", "/readyz")
                return
            except OSError:
                time.sleep(0.1)
        self.process.kill()
        raise SystemExit(f"the service does not listen: {self.log.read_text()[-2000:]}")

    def call(self, method, path):
        connection = Connection(self.port)
        try:
            return connection.call(method, path)
        finally:
            connection.close()

    def stop(self):
        self.process.terminate()
        return self.process.wait(20)

    def metrics(self):
        """Values by name with labels."""
        lines = self.call("GET", "/metrics").body.decode().splitlines()
        return {name: float(value) for name, value in (line.rsplit(" ", 1) for line in lines if line[0] != "#")}

    def runners(self):
        folder = pathlib.Path(f"/proc/{self.process.pid}/task")
        return [pid for file in folder.glob("*/children") for pid in file.read_text().split()]

    def errors_logged(self):
        """Lines of the level error, but those of requests, whose answers the clients judge, and of a full disk."""
        lines = [json.loads(line) for line in self.log.read_text().splitlines()]
        return [line for line in lines if line["level"] == "error" and line["event"] not in ("request", "disk")
                and line.get("detail") != "the disk is full"]


def free_port():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


def process_status(pid, field):
    """A number of /proc/PID/status; 0 when the process is gone."""
    try:
        text = pathlib.Path(f"/proc/{pid}/status").read_text()
    except FileNotFoundError:
        return 0
    found = re.search(rf"^{field}:\s+(\d+)", text, re.MULTILINE)
    return int(found[1]) if found else 0


def size(path):
    return path.stat().st_size if path.exists() else 0


def ended(metrics, name):
    return sum(value for key, value in metrics.items() if key.startswith(f"snapthrough_{name}_ended_total"))


def percentiles(seconds):
    """p50 and p99 in ms."""
    ordered = sorted(seconds) or [float("nan")]
    return tuple(1e3 * ordered[round(share * (len(ordered) - 1))] for share in (0.5, 0.99))


class Soak:
    """One run: the service, its clients and what was observed each minute."""

    def __init__(self, program, folder, disk, findings):
        self.program = program
        self.folder = folder
        self.disk = disk
        self.findings = findings
        self.receiver = Receiver(findings)
        self.actions = Actions(Catalogue(program), self.receiver)
        weights = self.actions.weights() | HostileActions(self.actions.catalogue).weights()
        self.service = Service(program, folder, "soak.db", self.receiver)
        self.times = multiprocessing.Queue()
        self.prober = multiprocessing.Process(target=probe, args=(self.service.port, self.times), daemon=True)
        self.prober.start()
        threading.Thread(target=self.receiver.serve_forever, daemon=True).start()
        self.load = Load(self.service.port, weights, CLIENTS, findings)
        self.minutes = []
        self.seen = set()  # metrics that were reported as findings

    def run(self, minutes, fraction):
        self.load.start()
        time.sleep(CALIBRATION)
        full = self.load.done.total() / CALIBRATION
        self.load.pace.rate = full * fraction
        print(f"{CLIENTS} clients take {full:.1f} actions a second; soaking at {full * fraction:.1f}"
              f" for {minutes} minutes (service {self.service.process.pid})\n{Minute.HEAD}", flush=True)
        self.drain()
        self.before, self.since = self.service.metrics(), time.monotonic()
        begin = self.since
        for minute in range(1, minutes + 1):
            time.sleep(max(0.0, begin + 60 * minute - time.monotonic()))
            self.observe(minute)
            if minute % BETWEEN_BACKUPS == 0:
                self.backup()
            if self.disk and minute % BETWEEN_FULL == 0:
                self.disk.fill(FULL)

    def observe(self, minute):
        """Prints the line of a minute."""
        metrics, now = self.service.metrics(), time.monotonic()
        jobs, rows = ((ended(metrics, name) - ended(self.before, name)) / (now - self.since)
                      for name in ("jobs", "sweep_points"))
        self.before, self.since = metrics, now
        self.judge_metrics(metrics)
        times = self.drain()
        pid, store = self.service.process.pid, str(self.service.store)
        outstanding = self.receiver.account.settle()
        self.minutes.append(Minute(
            minute=minute, jobs=jobs, rows=rows,
            memory=process_status(pid, "VmRSS") / 1024,
            runners=sum(process_status(runner, "VmRSS") for runner in self.service.runners()) / 1024,
            descriptors=len(os.listdir(f"/proc/{pid}/fd")), threads=process_status(pid, "Threads"),
            wal=size(pathlib.Path(store + "-wal")) / MB, store=size(self.service.store) / MB,
            log=size(self.service.log),
            livez=percentiles(times["livez"]), job=percentiles(times["job"]),
            delivered=self.receiver.account.delivered, outstanding=outstanding,
            refused=self.findings.refusals.total(), errors=self.findings.count))
        print(self.minutes[-1].line(), flush=True)

    def drain(self):
        """What was timed since the last call, by kind."""
        times = {"livez": [], "job": []}
        while True:
            try:
                kind, value = self.times.get_nowait()
            except queue.Empty:
                return times
            if kind == "wrong":
                self.findings.add(value)
            else:
                times[kind].append(value)

    def judge_metrics(self, metrics):
        """Failures that the service itself counts; each counter is a finding once."""
        for key, value in metrics.items():
            label = re.search(r'(?:code|status)="(\w+)"', key)
            bad = ("_ended_total{" in key and label[1] not in GOOD_CODES
                   or "requests_total{" in key and label[1][0] == "5" and label[1] != "503"
                   or re.search("runners_(out_of_memory|crashed)_total|callbacks_given_up_total", key))
            broken = key in ("snapthrough_store_writable", "snapthrough_disk_has_space") and value != 1
            if (bad and value > 0 or broken) and key not in self.seen:
                self.seen.add(key)
                self.findings.add(f"metrics: {key} {value:g}")

    def backup(self):
        command = [self.program, "backup", "--store", self.service.store, self.folder / "disk" / "backup.db"]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            self.findings.add(f"backup: exit status {run.returncode}: {run.stderr}")

    def end(self):
        """Ends the load; then all news must come, nothing may be left, and the backup must answer."""
        self.load.end()
        self.prober.kill()
        late = time.monotonic() + LONGEST_WAIT + 5
        while self.receiver.account.settle() and time.monotonic() < late:
            time.sleep(1)
        self.check_idle()
        path = self.finished_job()
        right = self.service.call("GET", path).body
        self.backup()
        status = self.service.stop()
        if status != 0:
            self.findings.add(f"the service ended with {status}")
        for line in self.service.errors_logged():
            self.findings.add(f"log: {line}")
        self.judge_growth()
        self.service = Service(self.program, self.folder, "backup.db", self.receiver)
        if self.service.call("GET", path).body != right:
            self.findings.add(f"the restored backup has another {path}")
        self.service.stop()
        print(f"the restored backup answers; {self.load.done.total()} actions: {dict(self.load.done.most_common())};"
              f" {self.receiver.account.delivered} ends told; {dict(self.findings.refusals)} times refused for the moment;"
              f" {self.findings.count} errors")

    def close(self):
        self.load.end()
        self.prober.kill()  # it would take SIGTERM as this process does
        self.service.process.kill()

    def finished_job(self):
        """The address of the result of a new job with the status successful."""
        request = json.dumps(self.actions.catalogue.jobs[0][0]).encode()
        connection = Connection(self.service.port)
        answer = connection.post("/v1/jobs", request, Cache_Control="no-cache")
        connection.close()
        return answer.headers["Location"] + "/result"

    def check_idle(self):
        metrics = self.service.metrics()
        for name in ("jobs_waiting", "jobs_running", "sweeps_active", "streams", "buffered_bytes", "callbacks_waiting"):
            if metrics["snapthrough_" + name] != 0:
                self.findings.add(f"after the load: {name} {metrics['snapthrough_' + name]:g}")

    def judge_growth(self):
        if len(self.minutes) < SHORTEST_JUDGED:
            print(f"leaks are not judged: less than {SHORTEST_JUDGED} minutes")
            return
        tenth = len(self.minutes) // 10
        for name, slack in LEAKS.items():
            values = [getattr(minute, name) for minute in self.minutes]
            early, last = statistics.median(values[tenth:2 * tenth]), statistics.median(values[-tenth:])
            print(f"{name}: median of the second tenth {early:.1f}, of the last {last:.1f}")
            if last > 1.1 * early + slack:
                self.findings.add(f"leak: {name} has grown from {early:.1f} to {last:.1f}")


def leave(*_):
    raise SystemExit("stopped by a signal")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("minutes", nargs="?", type=int, default=30)
    parser.add_argument("--load", type=float, default=0.7, metavar="FRACTION")
    parser.add_argument("--disk", type=int, metavar="MB")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/snapthrough")
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    os.chdir(ROOT)
    signal.signal(signal.SIGTERM, leave)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="soak."))
    findings = Findings()
    soak = None
    disk = SmallDisk(folder / "disk", arguments.disk) if arguments.disk else (folder / "disk").mkdir()
    if disk:
        Connection.repeated += ("store-unavailable",)
    try:
        soak = Soak(program, folder, disk, findings)
        soak.run(arguments.minutes, arguments.load)
        soak.end()
    finally:
        if soak:
            soak.close()
        if disk:
            disk.close()
        if findings.count == 0:
            shutil.rmtree(folder)
        else:
            print(f"{findings.count} errors; store and log are in {folder}", flush=True)
    return 1 if findings.count else 0


if __name__ == "__main__":
    sys.exit(main())
