#!/usr/bin/env python3
"""Kills a service under load, backs its store up meanwhile, and looks whether anything that was acknowledged is missing.

  kills.py PROGRAM [--kills 500] [--backup-kills N | --backup-seconds 20] [--clients 5] [--seed 1] [--keep]

Five clients submit jobs with an Idempotency-Key each and ask again until they have an answer. `snapthrough backup` copies the
store to names in rotation, beside which lie what others left: older copies, write-ahead logs and journals of another
database, cut and empty files, noise, an unfinished copy. Every fourth backup is killed itself and made again.

Asked: each backup ends with 0, is whole by itself and readable by its owner only, and has every job that was acknowledged
before it began; a service serves a copy of it. At the end every acknowledged job has ended successfully, a key is one job,
and the results of one request are the same. Exit status 1 when one of these is missed. SQLite only: databases have backups of
their own.
"""
import argparse
import collections
import http.client
import json
import pathlib
import random
import shutil
import sqlite3
import stat
import subprocess
import sys
import tempfile
import threading
import time
import uuid

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import honest  # noqa: E402
from service_process import HOST, ServiceProcess, Verdict, leave_by_exception, plain_environment, resident_mb  # noqa: E402

BESIDE = ("-wal", "-shm", "-journal")
NUMBERS = 200      # different requests
SERVED_EVERY = 5   # each so many backups, a service is started on a copy
ASKED = 20         # jobs that are asked for there
RUNNERS_END = 5.0  # s within which runners of a killed service must have ended
ALL_END = 300.0    # s within which all jobs must have ended after the last kill


class Client(threading.Thread):
    """Submits jobs, each until it is acknowledged."""

    def __init__(self, port, stop, draw, findings):
        super().__init__()
        self.port = port
        self.stop = stop
        self.draw = draw
        self.findings = findings
        self.acknowledged = []  # (id, number), in the order of their acknowledgement
        self.statuses = collections.Counter()

    def run(self):
        while not self.stop.is_set():
            number, key = self.draw.randrange(NUMBERS), str(uuid.uuid4())
            job = self.submit(number, key)
            if job:
                self.acknowledged.append((job, number))
            if job and self.draw.random() < 0.1:
                again = self.submit(number, key)
                if again and again != job:
                    self.findings.append(f"key {key} is the jobs {job} and {again}")
            self.stop.wait(self.draw.uniform(0.02, 0.15))

    def submit(self, number, key):
        """Id of the job; None when the load ends before it is acknowledged."""
        headers = {"Content-Type": "application/json", "Idempotency-Key": key, "Prefer": "respond-async",
                   "Cache-Control": "no-cache"}
        while not self.stop.is_set():
            connection = http.client.HTTPConnection(HOST, self.port, timeout=20)
            try:
                connection.request("POST", "/v1/jobs", honest.request(number), headers)
                response = connection.getresponse()
                body = response.read()
                self.statuses[str(response.status)] += 1
                if response.status in (200, 201):
                    return json.loads(body)["id"]
                if response.status not in (409, 503):
                    self.findings.append(f"a submission is answered with {response.status} {body[:200]!r}")
            except (OSError, http.client.HTTPException) as problem:
                self.statuses[type(problem).__name__] += 1
            finally:
                connection.close()
            time.sleep(0.02)
        return None


class Leftovers:
    """What lies under and beside the name of a backup before it is made, by kind."""

    def __init__(self, folder):
        self.draw = random.Random(7)
        other = folder / "other.db"
        self.wal, self.shm, self.journal = (self.other_database(other, part) for part in ("wal", "shm", "journal"))

    @staticmethod
    def other_database(path, part):
        """Bytes of what SQLite keeps beside another database while a transaction of it is not yet in the file."""
        for file in path.parent.glob(path.name + "*"):
            file.unlink()
        mode = "DELETE" if part == "journal" else "WAL"
        database = sqlite3.connect(path, isolation_level=None)
        database.executescript(f"PRAGMA journal_mode={mode}; PRAGMA wal_autocheckpoint=0; PRAGMA cache_size=1;"
                               "CREATE TABLE jobs(id TEXT, x BLOB); BEGIN")
        for number in range(200):
            database.execute("INSERT INTO jobs VALUES(?, randomblob(2000))", (str(number),))
        if part != "journal":
            database.execute("COMMIT")
        data = pathlib.Path(f"{path}-{part}").read_bytes()
        database.close()
        return data

    def lay(self, name, kind):
        beside = {ending: pathlib.Path(str(name) + ending) for ending in (*BESIDE, ".part", ".part-wal", ".part-journal")}
        if kind in ("cut", "cut beside a log") and name.exists():
            with open(name, "r+b") as file:
                file.truncate(name.stat().st_size // 2 + 100)
        if kind in ("a log of another", "cut beside a log"):
            beside["-wal"].write_bytes(self.wal)
            beside["-shm"].write_bytes(self.shm)
        elif kind == "a journal of another":
            beside["-journal"].write_bytes(self.journal)
        elif kind == "noise":
            for path in (name, *beside.values()):
                path.write_bytes(self.draw.randbytes(self.draw.randint(1, 200_000)))
        elif kind == "empty files":
            for path in (name, *beside.values()):
                path.write_bytes(b"")
        elif kind == "an unfinished copy":
            beside[".part"].write_bytes(name.read_bytes()[:100_000] if name.exists() else b"SQLite format 3\0" * 300)
            beside[".part-wal"].write_bytes(self.wal)
            beside[".part-journal"].write_bytes(self.journal)


class Backups:
    """Makes backups to three names in rotation, and opens each."""

    KINDS = ("nothing or an older copy", "a log of another", "a journal of another", "cut", "cut beside a log", "noise",
             "empty files", "an unfinished copy")

    def __init__(self, service, folder, clients, findings):
        self.service = service
        self.folder = folder / "backups"
        self.folder.mkdir()
        self.clients = clients
        self.findings = findings
        self.leftovers = Leftovers(folder)
        self.draw = random.Random(11)
        self.count = 0
        self.jobs = 0       # that were looked for in a backup
        self.longest = 0.0  # s
        self.killed = 0

    def make(self):
        kind = self.KINDS[self.count % len(self.KINDS)]
        name = self.folder / f"copy{self.count % 3}.db"
        self.leftovers.lay(name, kind)
        self.count += 1
        command = [self.service.program, "backup", "--store", self.service.store, name]
        if self.count % 4 == 0:
            self.kill_one(command)
        asked = [job for client in self.clients for job in list(client.acknowledged)]
        begin = time.monotonic()
        run = subprocess.run(command, capture_output=True, text=True, env=plain_environment())
        self.longest = max(self.longest, time.monotonic() - begin)
        what = f"backup {self.count} to a name with {kind}"
        if run.returncode != 0:
            self.findings.append(f"{what}: exit status {run.returncode}: {run.stderr.strip()}")
            return
        self.check(name, asked, what)

    def kill_one(self, command):
        """A backup that is killed before its end; one that had ended leaves a copy, which is as well."""
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=plain_environment())
        time.sleep(self.draw.uniform(0.0, 0.2))
        self.killed += process.poll() is None
        process.kill()
        process.wait()

    def check(self, name, asked, what):
        if name.stat().st_mode & (stat.S_IRWXG | stat.S_IRWXO):
            self.findings.append(f"{what}: others can read it")
        left = [ending for ending in (*BESIDE, ".part") if pathlib.Path(str(name) + ending).exists()]
        if left:
            self.findings.append(f"{what}: {left} lie beside it")
        served = self.folder / "served.db"
        if self.count % SERVED_EVERY == 0:
            shutil.copy(name, served)
        try:
            database = sqlite3.connect(name)
            whole = database.execute("PRAGMA integrity_check").fetchall()
            there = {row[0] for row in database.execute("SELECT id FROM jobs")}
            database.close()
        except sqlite3.Error as problem:
            self.findings.append(f"{what}: {problem}")
            return
        if whole != [("ok",)]:
            self.findings.append(f"{what}: {whole[:3]}")
        missing = [job for job, _ in asked if job not in there]
        if missing:
            self.findings.append(f"{what}: {len(missing)} of {len(asked)} acknowledged jobs are not in it, such as {missing[0]}")
        self.jobs += len(asked)
        if self.count % SERVED_EVERY == 0:
            self.serve(served, asked, what)

    def serve(self, copy, asked, what):
        folder = self.folder / "served"
        folder.mkdir(exist_ok=True)
        service = ServiceProcess(self.service.program, folder, copy)
        try:
            service.start()
            for job, _ in self.draw.sample(asked, min(ASKED, len(asked))):
                if service.status(f"/v1/jobs/{job}") != 200:
                    self.findings.append(f"{what}: a service on a copy does not know {job}")
            if service.terminate()[1] != 0:
                self.findings.append(f"{what}: the service on a copy does not end with 0")
        except SystemExit as problem:
            self.findings.append(f"{what}: {problem}")
        finally:
            service.kill()
            for file in self.folder.glob("served.db*"):
                file.unlink()


def harm(service, kills, clients, findings, draw, backup):
    """Kills the running service `kills` times; `backup` is called with the number of each kill, before the next start."""
    for number in range(kills):
        time.sleep(draw.uniform(0.02, 0.8))
        runners = service.runners()
        service.kill()
        late = time.monotonic() + RUNNERS_END
        while any(resident_mb(runner) for runner in runners) and time.monotonic() < late:
            time.sleep(0.02)
        if any(resident_mb(runner) for runner in runners):
            findings.append(f"kill {number}: runners live {RUNNERS_END:g} s later")
        backup(number)
        service.start()
        if (number + 1) % 50 == 0:
            count = sum(len(client.acknowledged) for client in clients)
            print(f"{number + 1} kills, {count} jobs acknowledged, {len(findings)} findings", flush=True)


def load(arguments, service, clients, backups, stop, draw):
    """The clients' load, the kills and the backups beside or between them."""
    def back_up_every_so_often():
        while not stop.wait(arguments.backup_seconds):
            backups.make()
    beside = threading.Thread(target=back_up_every_so_often)
    every = arguments.backup_kills
    try:
        for client in clients:
            client.start()
        if not every:
            beside.start()
        harm(service, arguments.kills, clients, backups.findings, draw,
             lambda number: backups.make() if every and (number + 1) % every == 0 else None)
    finally:
        stop.set()
        for thread in [*clients, beside]:
            if thread.ident:
                thread.join()


def judge_jobs(service, acknowledged, findings):
    """Waits for the end of all jobs; (jobs without a good end, requests with two results)."""
    late = time.monotonic() + ALL_END
    while any(service.json(f"/v1/jobs?status={status}&limit=1")["jobs"] for status in ("accepted", "running")):
        if time.monotonic() > late:
            findings.append(f"{ALL_END:g} s later there are jobs that have not ended")
            break
        time.sleep(0.5)
    lost, values = [], collections.defaultdict(set)
    for n, (job, number) in enumerate(acknowledged):
        if n % 10 == 0:  # results are large
            result = service.json(f"/v1/jobs/{job}/result")
            values[number].add(tuple(honest.value_of(json.dumps(result))) if "summary" in result else str(result)[:200])
        found = service.json(f"/v1/jobs/{job}")
        if found.get("status") != "successful":
            lost.append(f"{job}: {found.get('status')} {str(found.get('error', found.get('detail', '')))[:200]}")
    return lost, [number for number, found in values.items() if len(found) > 1]


def run(arguments, folder):
    findings, stop = [], threading.Event()
    draw = random.Random(arguments.seed)
    service = ServiceProcess(arguments.program, folder, max_crashes=1_000_000)
    clients = [Client(service.port, stop, random.Random(draw.random()), findings) for _ in range(arguments.clients)]
    backups = Backups(service, folder, clients, findings)
    begin = time.monotonic()
    service.start()
    try:
        load(arguments, service, clients, backups, stop, draw)
        seconds = time.monotonic() - begin
        backups.make()
        acknowledged = [job for client in clients for job in client.acknowledged]
        lost, twofold = judge_jobs(service, acknowledged, findings)
        ended = service.terminate()
    finally:
        service.kill()
    verdict = Verdict()
    verdict.ask("acknowledged jobs that are lost or did not end well", "0", f"{len(lost)} of {len(acknowledged)}", not lost)
    verdict.ask("requests whose results differ", "0", str(len(twofold)), not twofold)
    verdict.ask(f"findings of {backups.count} backups ({backups.killed} more killed), {backups.jobs} jobs looked for in them,"
                " and of answers", "0", str(len(findings)), not findings)
    verdict.ask("exit status of the service at the end", "0", str(ended[1]), ended[1] == 0)
    statuses = sum((client.statuses for client in clients), collections.Counter())
    print(f"{verdict.table()}\n\n{arguments.kills} kills in {seconds:.0f} s; answers {dict(statuses)};"
          f" the longest backup took {backups.longest:.2f} s")
    print("\n".join(["", *findings[:50], *lost[:20], *(f"request {number} has two results" for number in twofold[:20])]))
    return 1 if verdict.missed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=500)
    parser.add_argument("--backup-seconds", type=float, default=20.0, help="pause between backups, which go on beside the kills")
    parser.add_argument("--backup-kills", type=int, default=0, help="instead, a backup after each so many kills, before the start")
    parser.add_argument("--clients", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", action="store_true", help="keep the folder with the store and the backups")
    arguments = parser.parse_args()
    leave_by_exception()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="snapthrough-kills-"))
    try:
        return run(arguments, folder)
    finally:
        if arguments.keep:
            print(f"store, backups and log are in {folder}")
        else:
            shutil.rmtree(folder)


if __name__ == "__main__":
    sys.exit(main())
