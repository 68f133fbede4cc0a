#!/usr/bin/env python3
"""Fills the volume of a service and empties it, again and again: is the service ready again afterwards?

  volume.py PROGRAM [--rounds 10] [--megabytes 80] [--document-megabytes 2]     needs root, which may mount a tmpfs

Each round submits documents until one is refused for want of space, removes all jobs, and waits for /readyz and for the next
document to be taken. Asked: 10 s at most, the first round's number of documents in each round within a fifth, no answer with
another status than 201, 204 and 503. Exit status 1 when one of these is missed.
"""
import argparse
import collections
import http.client
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import honest  # noqa: E402
from service_process import HOST, MB, ServiceProcess, Verdict, leave_by_exception  # noqa: E402

LONGEST = 10.0   # s until the service must take documents again
PATIENCE = 60.0  # s for which it is watched all the same
MOST = 1000      # documents of a round, when none is refused


class Volume:
    """A folder on a tmpfs of its own; use it in a with statement."""

    def __init__(self, megabytes):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="snapthrough-volume-"))
        self.megabytes = megabytes

    def __enter__(self):
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={self.megabytes}m", "tmpfs", self.folder], check=True)
        return self

    def __exit__(self, *_):
        subprocess.run(["umount", self.folder], check=True)
        self.folder.rmdir()

    def free_mb(self):
        found = os.statvfs(self.folder)
        return found.f_bavail * found.f_frsize / MB


class Filler:
    """Submits and removes documents; `statuses` counts the answers, `wrong` keeps those that are none of the expected."""

    def __init__(self, port, size):
        self.port = port
        self.padding = b"".join(random.Random(3).choices([b" ", b"\n", b"\t"], k=size))  # kept as it was received
        self.statuses = collections.Counter()
        self.refusals = collections.Counter()  # details of 503
        self.wrong = []
        self.number = 0
        self.connection = None

    def ask(self, method, path, body=None, **headers):
        """Status and body; the connection is made anew when the service has closed it."""
        for _ in range(2):
            self.connection = self.connection or http.client.HTTPConnection(HOST, self.port, timeout=60)
            try:
                self.connection.request(method, path, body, {"Content-Type": "application/json", **headers})
                response = self.connection.getresponse()
                answer = response.status, response.read()
                self.statuses[f"{method} {answer[0]}"] += 1
                return answer
            except (OSError, http.client.HTTPException) as problem:
                self.statuses[type(problem).__name__] += 1
                self.connection.close()
                self.connection = None
        return 0, b""

    def submit(self):
        """Id of a new job; None when it is refused."""
        document = honest.request(self.number) + self.padding
        self.number += 1
        status, body = self.ask("POST", "/v1/jobs", document, Prefer="respond-async")
        if status == 201:
            return json.loads(body)["id"]
        if status == 503:
            self.refusals[json.loads(body).get("detail", "")] += 1
        else:
            self.wrong.append(f"POST is answered with {status} {body[:200]!r}")
        return None

    def fill(self):
        jobs = []
        while len(jobs) < MOST and (job := self.submit()):
            jobs.append(job)
        return jobs

    def empty(self, jobs):
        for job in jobs:
            status, body = self.ask("DELETE", f"/v1/jobs/{job}")
            if status != 204:
                self.wrong.append(f"DELETE is answered with {status} {body[:200]!r}")

    def taken_again(self, begin):
        """(s from `begin` until a document is taken, its job); (None, None) when none is within PATIENCE."""
        while time.monotonic() - begin < PATIENCE:
            job = self.submit()
            if job:
                return time.monotonic() - begin, job
            time.sleep(0.1)
        return None, None


def shown(seconds):
    return "never" if seconds is None else f"{seconds:.2f} s"


def rounds(count, volume, service, filler):
    """(documents taken, s until ready, s until a document is taken; None: never) of each round."""
    for number in range(count):
        jobs = filler.fill()
        free = volume.free_mb()
        filler.empty(jobs)
        begin = time.monotonic()
        ready = service.wait_until_ready(PATIENCE)
        taken, job = filler.taken_again(begin)
        print(f"round {number + 1}: {len(jobs)} documents taken until one was refused, {free:.1f} MB free; after their removal"
              f" ready after {shown(ready)}, a document taken after {shown(taken)}, {volume.free_mb():.1f} MB free", flush=True)
        filler.empty([job] if job else [])
        yield len(jobs), ready, taken


def run(arguments, volume):
    service = ServiceProcess(arguments.program, volume.folder, least_free_bytes=arguments.least_free_megabytes * MB)
    verdict, filler = Verdict(), Filler(service.port, int(arguments.document_megabytes * MB))
    service.start()
    try:
        found = list(rounds(arguments.rounds, volume, service, filler))
        ended = service.terminate()
    finally:
        service.kill()
    counts = [count for count, _, _ in found]
    waits = [PATIENCE if one is None else one for _, ready, taken in found for one in (ready, taken)]
    verdict.ask("longest time from the last removal until ready and a document taken, s", f"{LONGEST:g}",
                f"{max(waits):.2f}" if max(waits) < PATIENCE else f"more than {PATIENCE:g}", max(waits) <= LONGEST)
    verdict.ask("least number of documents of a round", f"{max(1, 0.8 * counts[0]):.0f}", str(min(counts)),
                min(counts) >= max(1, 0.8 * counts[0]))
    verdict.ask("answers of another kind", "0", str(len(filler.wrong)), not filler.wrong)
    verdict.ask("exit status at the end", "0", str(ended[1]), ended[1] == 0)
    print(f"\n{verdict.table()}\n\nanswers {dict(filler.statuses)}; refusals {dict(filler.refusals)}")
    print("\n".join(filler.wrong[:10]))
    return 1 if verdict.missed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--megabytes", type=int, default=80, help="size of the volume")
    parser.add_argument("--document-megabytes", type=float, default=2.0)
    parser.add_argument("--least-free-megabytes", type=int, default=8, help="setting least_free_bytes of the service")
    arguments = parser.parse_args()
    leave_by_exception()
    if os.geteuid() != 0:
        print("volume.py mounts a tmpfs, which needs root: run it as root (sudo)", file=sys.stderr)
        return 2
    with Volume(arguments.megabytes) as volume:
        return run(arguments, volume)


if __name__ == "__main__":
    sys.exit(main())
