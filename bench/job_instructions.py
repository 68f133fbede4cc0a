#!/usr/bin/env python3
"""Instructions of one small job through the service, by callgrind: those of the service and of its runner apart.

  job_instructions.py PROGRAM [--jobs N]

The column of README with another EI each time, one connection, embedded SQLite. The difference of two runs, of 50 and of 50 + N
jobs, leaves out what begins and ends the processes. Repeated runs of one program differ by 0.5 %."""
import argparse
import http.client
import json
import pathlib
import re
import signal
import subprocess
import tempfile
import time

FEW = 50
REQUEST = {"model": {"nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 1, "y": 0}],
                     "sections": [{"id": "s", "EA": 1e6, "EI": 1.0}],
                     "members": [{"id": "m", "start": "a", "end": "b", "section": "s"}],
                     "supports": [{"node": "a", "fixed": ["x", "y"]}, {"node": "b", "fixed": ["y"]}],
                     "loads": [{"type": "point", "at": {"node": "b"}, "force": [-1, 0]}]},
           "analysis": {"type": "critical"}}


def port_of(log):
    for _ in range(600):
        for line in log.read_text().splitlines():
            if '"event":"listening"' in line:
                return json.loads(line)["port"]
        time.sleep(0.1)
    raise SystemExit(f"the service does not start: {log.read_text()[-500:]}")


def hand_in(port, jobs):
    connection = http.client.HTTPConnection("127.0.0.1", port)
    for i in range(jobs):
        REQUEST["model"]["sections"][0]["EI"] = 1.1 + 1e-6 * i
        connection.request("POST", "/v1/jobs", json.dumps(REQUEST), {"Content-Type": "application/json", "Prefer": "wait=60"})
        answer = connection.getresponse()
        text = answer.read()
        if answer.status != 200:
            raise SystemExit(text.decode())


def count(program, jobs):
    """{"service": instructions, "runner": instructions} of a service that solves so many jobs."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        log = folder / "log"
        # Valgrind runs the loader of Linux, and the loader the service. A service that was started so begins its runners by its own
        # name (own_executable()), and valgrind follows them; else it begins them by /proc/self/exe, which valgrind does not follow.
        command = ["valgrind", "--tool=callgrind", "--trace-children=yes", f"--callgrind-out-file={folder}/out.%p",
                   "/lib64/ld-linux-x86-64.so.2", program, "serve", "--listen", "127.0.0.1:0", "--store", f"{folder}/store.db",
                   "--no-web", "--workers", "1"]
        with open(log, "w", encoding="utf-8") as out, subprocess.Popen(command, stdout=out, stderr=out) as service:
            hand_in(port_of(log), jobs)
            subprocess.run(["callgrind_control", "-d"], capture_output=True, check=False)  # runners are killed at the end
            time.sleep(1)
            service.send_signal(signal.SIGTERM)
        counted = {"service": 0, "runner": 0}
        for file in folder.glob("out.*"):
            text = file.read_text()
            named = re.search(r"^cmd: *(.*)$", text, re.M)
            total = re.search(r"^(?:summary|totals): (\d+)", text, re.M)
            if named and total:
                counted["service" if " serve " in named.group(1) else "runner"] += int(total.group(1))
        if 0 in counted.values():
            raise SystemExit(f"callgrind counted no instructions of a process: {counted}; is callgrind_control installed?")
        return counted


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--jobs", type=int, default=200)
    arguments = parser.parse_args()
    few, many = (count(arguments.program, jobs) for jobs in (FEW, FEW + arguments.jobs))
    each = {part: (many[part] - few[part]) / arguments.jobs for part in few}
    for part, instructions in each.items():
        print(f"{part}: {instructions / 1e6:.3f} million instructions a job")
    print(f"together: {sum(each.values()) / 1e6:.3f}")


main()
