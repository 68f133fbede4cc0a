"""Upgrades hosts that share one PostgreSQL one by one while clients use them, and looks whether anything fails.

  upgrade.py OLD NEW [--lease S]

OLD and NEW are programs of two versions; SNAPTHROUGH_OLD in the environment replaces OLD. Two fronts and four workers of the
old version work on jobs of two owners and on a sweep. NEW migrates the store, then each worker, then each front ends by
SIGTERM and starts again as NEW. Nothing may fail: no request stays unanswered by both fronts, each acknowledged job and each
point of the sweep ends once and well."""

import argparse
import os
import subprocess
import sys
import threading
import time

from cluster import Client
from faults import Trial


class Probe:
    """A client that reads all the time, and counts requests that no front answers."""

    def __init__(self, fronts):
        self.client = Client(fronts)
        self.answered = 0
        self.unanswered = 0
        self.stopping = False
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _run(self):
        while not self.stopping:
            status, _, _ = self.client.ask("GET", "/v1/jobs?limit=1", tries=2)
            if status == 200:
                self.answered += 1
            else:
                self.unanswered += 1
            time.sleep(0.02)

    def stop(self):
        self.stopping = True
        self.thread.join()


def upgrade(trial, new):
    """Each host in turn; returns what went wrong, or nothing."""
    subprocess.run([new, "migrate", "--store", trial.cluster.database.location()], check=True, capture_output=True)
    for host in trial.cluster.workers + trial.cluster.fronts:
        host.stop()
        host.command[host.command.index(trial.program)] = new
        host.start()
        if trial.progress_after() is None:
            return f"no job ends after the upgrade of {host.name}"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--lease", type=int, default=5)
    arguments = parser.parse_args()
    old = os.path.realpath(os.environ.get("SNAPTHROUGH_OLD") or arguments.old)
    trial = Trial(old, arguments.lease, {})
    try:
        probe = Probe(trial.cluster.fronts)
        stuck = upgrade(trial, os.path.realpath(arguments.new))
        probe.stop()
        wrong = ([stuck] if stuck else []) + trial.verdict()
        if probe.unanswered:
            wrong.append(f"{probe.unanswered} requests unanswered")
        print(f"{len(trial.load.acknowledged)} jobs and a sweep, {probe.answered} requests answered, {len(wrong)} failures")
        for one in wrong:
            print("wrong:", one)
    finally:
        trial.stop()
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
