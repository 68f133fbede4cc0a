"""Harms hosts that share one PostgreSQL while they work, and looks whether anything is lost.

  faults.py PROGRAM [--repeat N] [--only FAULT...] [--lease S]

Each trial: two fronts and four workers under jobs of two owners and a sweep. Then: everything that was acknowledged is there and
has ended once and well, the sweep has every row once, and nobody sees what belongs to another owner. A table of recovery
times (median, worst): from the fault until every job and unit that ran then has ended, or, where the database is harmed,
until the next job is acknowledged and ended."""

import argparse
import collections
import json
import os
import random
import signal
import statistics
import subprocess
import sys
import time

from cluster import Client, Cluster, Database, Load, Host, OWNERS, sweep, wait_for

POINTS = 600


class Trial:
    """One cluster under load, to be harmed once."""

    def __init__(self, program, lease, settings=()):
        self.program = program
        self.cluster = Cluster(program, options=["--lease-s", str(lease)], settings=settings)
        self.clients = {owner: Client(self.cluster.fronts, owner) for owner in OWNERS}
        self.load = Load(self.cluster.fronts)
        status, _, headers = self.clients["ann"].ask("POST", "/v1/sweeps", json.dumps(sweep(POINTS, 16)), tries=4)
        assert status == 201, status
        self.sweep = headers["Location"]
        time.sleep(1.0 + random.random())

    def running(self):
        """Jobs that run now."""
        return {row[0] for row in self.cluster.database.query("SELECT id FROM jobs WHERE status = 'running'")}

    def all_ended(self, ids):
        if not ids:
            return True
        listed = ",".join(f"'{one}'" for one in ids)
        return self.cluster.database.query(
            f"SELECT count(*) FROM jobs WHERE finished_us IS NULL AND id IN ({listed})") == [["0"]]

    def progress_after(self, count=1):
        """Seconds until that many jobs that are handed in from now on have ended."""
        since = time.time()

        def done():
            new = [path.rsplit("/", 1)[1] for when, _, path in list(self.load.acknowledged) if when > since]
            if len(new) < count:
                return False
            try:
                return self.all_ended(new[:count])
            except subprocess.CalledProcessError:
                return False
        return wait_for(done, 90)

    def verdict(self):
        """What is wrong; empty: nothing."""
        wrong = []
        acknowledged = self.load.stop()
        ids = [path.rsplit("/", 1)[1] for _, _, path in acknowledged]
        if len(set(ids)) != len(ids):
            wrong.append("two submissions got one id")
        if wait_for(lambda: self.all_ended(ids), 120) is None:
            wrong.append("jobs that do not end")
        rows = dict(self.cluster.database.query("SELECT id, status FROM jobs"))
        lost = [one for one in ids if one not in rows]
        if lost:
            wrong.append(f"{len(lost)} of {len(ids)} acknowledged jobs are gone")
        states = collections.Counter(rows[one] for one in ids if one in rows)
        if set(states) - {"successful"}:
            wrong.append(f"states {dict(states)}")
        wrong += self.ended_twice() + self.wrong_sweep() + self.strangers(acknowledged)
        return wrong

    def ended_twice(self):
        ends = collections.Counter(event["job"] for host in self.cluster.hosts for event in host.events("job")
                                   if event.get("status") == "successful" and "code" in event)
        twice = [job for job, count in ends.items() if count > 1]
        return [f"{len(twice)} jobs ended twice"] if twice else []

    def wrong_sweep(self):
        client = self.clients["ann"]

        def ended():
            status, body, _ = client.ask("GET", self.sweep, tries=4)
            return status == 200 and json.loads(body)["status"] not in ("accepted", "running")
        if wait_for(ended, 120, 0.2) is None:
            return ["the sweep does not end"]
        _, body, _ = client.ask("GET", self.sweep, tries=4)
        counts = json.loads(body)["counts"]
        _, table, _ = client.ask("GET", self.sweep + "/table", tries=4)
        rows = json.loads(table)["rows"]
        wrong = []
        if counts["successful"] != POINTS:
            wrong.append(f"sweep: {counts}")
        if len(rows) != POINTS or len({row[0] for row in rows}) != POINTS:
            wrong.append(f"sweep: {len(rows)} rows, {len({row[0] for row in rows})} of them different")
        if any(abs(row[1] / row[0] - rows[0][1] / rows[0][0]) > 1e-6 * rows[0][1] for row in rows):
            wrong.append("sweep: rows belong to other points")
        return wrong

    def strangers(self, acknowledged):
        for _, owner, path in acknowledged[-3:]:
            other = "bob" if owner == "ann" else "ann"
            for resource in (path, path + "/events", path + "/result"):
                status, _, _ = self.clients[other].ask("GET", resource, tries=4)
                if status != 404:
                    return [f"{other} sees what belongs to {owner}: {status}"]
        return []

    def stop(self):
        self.cluster.stop()


def recovered(trial, ids):
    return wait_for(lambda: trial.all_ended(ids), 90)


def kill_worker(trial):
    ids = trial.running()
    trial.cluster.workers[0].kill()
    return recovered(trial, ids)


def kill_two_workers(trial):
    ids = trial.running()
    trial.cluster.workers[0].kill()
    trial.cluster.workers[1].kill()
    return recovered(trial, ids)


def kill_front(trial):
    trial.cluster.fronts[0].kill()
    return trial.progress_after()


def kill_database(trial):
    trial.cluster.database.kill()
    trial.cluster.database.start()
    return trial.progress_after()


def stop_database_for_5_s(trial):
    trial.cluster.database.stop()
    time.sleep(5)
    trial.cluster.database.start()
    return trial.progress_after()


def pause_worker(trial):
    """A host that stands still past its lease and comes back."""
    ids = trial.running()
    worker = trial.cluster.workers[0]
    worker.signal(signal.SIGSTOP)
    seconds = recovered(trial, ids)
    worker.signal(signal.SIGCONT)
    time.sleep(1)
    return seconds


def hold_snapshot(trial):
    """A transaction that is open for long: nothing that dies can be taken away."""
    database = trial.cluster.database
    holder = subprocess.Popen(["psql", "-q", "-h", str(database.folder), "-p", str(database.port), "-U", "snapthrough", "snapthrough"],
                              stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    holder.stdin.write("BEGIN ISOLATION LEVEL REPEATABLE READ; SELECT count(*) FROM jobs;\n")
    holder.stdin.flush()
    seconds = trial.progress_after(20)
    holder.kill()
    return seconds


def add_worker_and_end_one(trial):
    """What a rolling restart does."""
    cluster = trial.cluster
    ids = trial.running()
    cluster.workers[0].process.terminate()
    cluster.workers.append(cluster._add(trial.program, "late", cluster.database.location(), 1, False, ["--lease-s", "3"]))
    return recovered(trial, ids)


FAULTS = {fault.__name__: fault for fault in (kill_worker, kill_two_workers, kill_front, kill_database, stop_database_for_5_s,
                                              pause_worker, hold_snapshot, add_worker_and_end_one)}


def run(program, lease, fault):
    """Recovery time and what is wrong."""
    trial = Trial(program, lease)
    try:
        seconds = fault(trial)
        wrong = trial.verdict()
        if seconds is None:
            wrong.append("no recovery within 90 s")
        return seconds, wrong, len(trial.load.acknowledged)
    finally:
        trial.stop()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--only", nargs="*", default=list(FAULTS))
    parser.add_argument("--lease", type=int, default=3)
    arguments = parser.parse_args()
    failed = 0
    print("| fault | trials | jobs acknowledged | recovery, median (s) | worst (s) | wrong |\n| --- | --- | --- | --- | --- | --- |")
    for name in arguments.only:
        times, wrong, jobs = [], [], 0
        for _ in range(arguments.repeat):
            seconds, found, count = run(arguments.program, arguments.lease, FAULTS[name])
            times.append(seconds if seconds is not None else 90.0)
            wrong += found
            jobs += count
        failed += len(wrong)
        print(f"| {name} | {arguments.repeat} | {jobs} | {statistics.median(times):.2f} | {max(times):.2f} | "
              f"{'; '.join(wrong) or 'nothing'} |", flush=True)
    print("0 failed" if failed == 0 else f"{failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
