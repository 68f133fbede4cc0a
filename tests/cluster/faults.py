"""Harms hosts that share one PostgreSQL while they work, and looks whether anything is lost.

  faults.py PROGRAM [--repeat N] [--only FAULT...] [--lease S]

Each trial: two fronts and four workers under jobs of two owners and a sweep. Then: everything that was acknowledged is there and
has ended once and well, the sweep has every row once, and nobody sees what belongs to another owner. A table of recovery
times (median, worst): from the fault until the jobs that the harmed worker had have ended and its items are free, or, where no
worker is harmed, until the next job is acknowledged and ended; for hosts that are asked to stop, until they have."""

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

from cluster import Client, Cluster, Load, Network, OWNERS, PATIENCE, UNENDED, sweep, wait_for

POINTS = 600
STOPS_WITHIN = 30  # s; docs/service.md: 5 s for a database that does not answer, and the stages of a stop


class Trial:
    """One cluster under load, to be harmed once."""

    def __init__(self, program, lease, surroundings):
        self.program = program
        # a busy machine may lose a lease without a fault: that is not the job's
        self.cluster = Cluster(program, options=["--lease-s", str(lease), "--max-crashes", "100"], **surroundings)
        self.clients = {owner: Client(self.cluster.fronts, owner) for owner in OWNERS}
        self.load = Load(self.cluster.fronts)
        status, _, headers = self.clients["ann"].ask("POST", "/v1/sweeps", json.dumps(sweep(POINTS, 16)), tries=4)
        assert status == 201, status
        self.sweep = headers["Location"]
        self.may_lose = False
        self.lost = 0
        time.sleep(1.0 + random.random())

    def busy_worker(self):
        """A worker that has a job at this moment, and its jobs."""
        found = []

        def look():
            leases = dict()
            for worker, job in self.cluster.database.query(
                    "SELECT worker, id FROM job_leases JOIN jobs ON seq = job WHERE status = 'running'"):
                leases.setdefault(worker, []).append(job)
            found[:] = [(host, leases[host.instance()]) for host in self.cluster.workers if host.instance() in leases]
            return bool(found)
        if wait_for(look, PATIENCE, 0.02) is None:
            raise RuntimeError(f"no worker was busy for {PATIENCE} s")
        return found[0]

    def released(self, host, jobs):
        """Seconds until what that worker had is done: its jobs have ended and its items are somebody else's."""
        name = host.instance()

        def gone():
            return self.cluster.database.query(
                f"SELECT (SELECT count(*) FROM job_leases WHERE worker = '{name}')"
                f" + (SELECT count(*) FROM sweep_leases WHERE worker = '{name}')") == [["0"]]
        return wait_for(lambda: gone() and self.all_ended(jobs), PATIENCE)

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
        return wait_for(done, PATIENCE)

    def verdict(self):
        """What is wrong; empty: nothing."""
        wrong = []
        acknowledged = self.load.stop()
        ids = [path.rsplit("/", 1)[1] for _, _, path in acknowledged]
        if len(set(ids)) != len(ids):
            wrong.append("two submissions got one id")
        if wait_for(lambda: self.all_ended(ids), PATIENCE) is None:
            wrong.append("jobs that do not end")
        rows = dict(self.cluster.database.query("SELECT id, status FROM jobs"))
        lost = [one for one in ids if one not in rows]
        self.lost = len(lost)
        if lost and not self.may_lose:
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
        if self.may_lose:  # the end was lost with the database, which is not seen from here: it ends again
            return []
        return [f"{len(twice)} jobs ended twice"] if twice else []

    def wrong_sweep(self):
        client = self.clients["ann"]
        if wait_for(lambda: client.state(self.sweep) not in (*UNENDED, "gone"), PATIENCE, 0.2) is None:
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
        failed = collections.Counter(row[-1] for row in rows if row[1] is None)
        if failed:
            wrong.append(f"sweep: points failed: {failed.most_common(3)}")
        elif any(abs(row[1] / row[0] - rows[0][1] / rows[0][0]) > 1e-4 * rows[0][1] for row in rows):
            wrong.append("sweep: rows belong to other points")
        return wrong

    def strangers(self, acknowledged):
        for _, owner, path in acknowledged[-3:]:
            other = "bob" if owner == "ann" else "ann"
            for resource in (path, path + "/events", path + "/result"):
                status, _, _ = self.clients[other].ask("GET", resource, tries=4)
                if status not in (404, 410):  # its owner is told that it was deleted
                    return [f"{other} sees what belongs to {owner}: {status}"]
        return []

    def stop(self):
        self.cluster.stop()


def kill_worker(trial):
    worker, jobs = trial.busy_worker()
    worker.kill()
    return trial.released(worker, jobs)


def kill_two_workers(trial):
    worker, jobs = trial.busy_worker()
    worker.kill()
    next(other for other in trial.cluster.workers if other is not worker).kill()
    return trial.released(worker, jobs)


def kill_front(trial):
    trial.cluster.fronts[0].kill()
    return trial.progress_after()


def kill_database(trial):
    trial.cluster.database.kill()
    trial.cluster.database.start_again()
    return trial.progress_after()


def stop_database_for_5_s(trial):
    trial.cluster.database.stop()
    time.sleep(5)
    trial.cluster.database.start()
    return trial.progress_after()


def stop_hosts_while_database_is_silent(trial):
    """The database stands still with all its connections: who is asked to stop does so all the same."""
    cluster = trial.cluster
    worker, jobs = trial.busy_worker()
    frozen = cluster.database.freeze()
    time.sleep(1)
    start = time.time()
    hosts = [worker, cluster.fronts[0]]
    for host in hosts:
        host.process.terminate()
    try:
        for host in hosts:
            host.process.wait(max(0, start + STOPS_WITHIN - time.time()))
        seconds = time.time() - start
    except subprocess.TimeoutExpired:
        seconds = None
    for one in reversed(frozen):  # its processes before the server that collects them
        os.kill(one, signal.SIGCONT)
    trial.released(worker, jobs)
    return seconds


def pause_worker(trial):
    """A host that stands still past its lease and comes back."""
    worker, jobs = trial.busy_worker()
    worker.signal(signal.SIGSTOP)
    seconds = trial.released(worker, jobs)
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
    worker, jobs = trial.busy_worker()
    worker.process.terminate()
    cluster.workers.append(cluster._add(trial.program, "late", cluster.database.location(), 1, False, ["--lease-s", "3"]))
    return trial.released(worker, jobs)


def fail_over(trial):
    """The database dies, and its synchronous replica takes over."""
    cluster = trial.cluster
    cluster.database.kill()
    cluster.replica.promote()
    cluster.database = cluster.replica
    cluster.replica = None
    return trial.progress_after()


def fail_over_without_sync(trial):
    """The same with a replica that nobody waits for: what was acknowledged last may be missing."""
    trial.may_lose = True
    return fail_over(trial)


def lose_synchronous_replica(trial):
    """The only synchronous replica dies: commits wait for it, until the operator no longer asks for it."""
    cluster = trial.cluster
    cluster.replica.kill()
    cluster.replica = None
    time.sleep(2)
    before = len(trial.load.acknowledged)
    time.sleep(3)
    if len(trial.load.acknowledged) > before:
        raise RuntimeError("jobs were acknowledged that the replica does not have")
    cluster.database.query("ALTER SYSTEM RESET synchronous_standby_names")
    cluster.database.query("SELECT pg_reload_conf()")
    return trial.progress_after()


def cut_network(trial):
    """A worker that does not reach the database past its lease, and then does again."""
    worker = trial.cluster.workers[0]
    name = worker.instance()
    held = []

    def look():
        held[:] = [row[0] for row in trial.cluster.database.query(
            f"SELECT id FROM job_leases JOIN jobs ON seq = job WHERE worker = '{name}'")]
        return bool(held)
    if wait_for(look, PATIENCE, 0.01) is None:
        raise RuntimeError("it got no work")
    trial.cluster.network.cut()
    seconds = trial.released(worker, held)
    time.sleep(2)
    trial.cluster.network.mend()
    return seconds


FAULTS = {fault.__name__: fault for fault in (kill_worker, kill_two_workers, kill_front, kill_database, stop_database_for_5_s,
                                              stop_hosts_while_database_is_silent, pause_worker, hold_snapshot,
                                              add_worker_and_end_one, fail_over, fail_over_without_sync,
                                              lose_synchronous_replica, cut_network)}
SYNCED = {"replica": True, "synced": True}
SURROUNDINGS = {"fail_over": SYNCED, "lose_synchronous_replica": SYNCED, "fail_over_without_sync": {"replica": True},
                "cut_network": {"apart": True}}


def run(program, lease, fault):
    """Recovery time and what is wrong."""
    trial = Trial(program, lease, SURROUNDINGS.get(fault.__name__, {}))
    try:
        seconds = fault(trial)
        wrong = trial.verdict()
        if seconds is None:
            wrong.append(f"no recovery within {PATIENCE} s")
        return seconds, wrong, len(trial.load.acknowledged), trial.lost
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
        if name == "cut_network" and not Network.possible():
            print(f"| {name} | 0 | 0 | | | not possible without root |")
            continue
        times, wrong, jobs, lost = [], [], 0, 0
        for _ in range(arguments.repeat):
            seconds, found, count, gone = run(arguments.program, arguments.lease, FAULTS[name])
            times.append(seconds if seconds is not None else float(PATIENCE))
            wrong += found
            jobs += count
            lost += gone
        failed += len(wrong)
        print(f"| {name} | {arguments.repeat} | {jobs} | {statistics.median(times):.2f} | {max(times):.2f} | "
              f"{'; '.join(wrong) or 'nothing'}{f' ({lost} lost, as they may)' if lost and not wrong else ''} |", flush=True)
    print("0 failed" if failed == 0 else f"{failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
