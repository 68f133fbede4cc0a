#!/usr/bin/env python3
"""A day of a service among attackers, in little: what do honest owners notice?

  day.py PROGRAM [--store sqlite|postgresql://...] [--minutes 40] [--report FILE.md] [--only ATTACK...] [--set NAME=VALUE...]

Five honest owners hand in small jobs for a quarter of the time. For half of the time they go on while all attacks of attacks.py
run at once, from other owners and without keys. In the rest SIGTERM ends the service --stops times at random moments under
attack. Asked: the p99 of honest answers is at most three times that of the quiet time, every answer is that of the quiet time
with all digits, no 5xx to honest clients, memory within its documented bound, exit within the documented time of the stages.
Prints tables; exit status 1 when an asked line is missed.

Attackers and clients run on the machine of the service. Attackers are processes of low priority, so that what they compute for
themselves keeps nobody waiting; the table says how late the honest clients' own clocks were and who used the processors, other
programs among them, which must do nearly nothing: else the ratio is about them.
"""
import argparse
import base64
import collections
import json
import multiprocessing
import os
import pathlib
import queue
import random
import shutil
import sys
import tempfile
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import attacks  # noqa: E402
import honest  # noqa: E402
from service_process import (ServiceProcess, Verdict, free_port, leave_by_exception, open_files_as_many_as_allowed,  # noqa: E402
                             processor_seconds, processor_seconds_of_all, quantile, resident_mb)

OWNERS = ("ann", "bob", "cid", "dora", "eve")
NUMBERS = 400          # different requests
RATIO = 3.0            # p99 among attackers over p99 in the quiet time
SERVICE_MB = 512       # memory of the service beside its runners: docs/howto/run-the-service.md (mem_limit)
STAGES = 2.0 + 2.0     # s: the stages of stopping, docs/service.md
READING = 1.0          # s: reading of documents ends so long after the service was told to stop, docs/service.md
OTHERS = 0.2           # processors that programs beside the measurement may use: with more it says nothing about the service
spawning = multiprocessing.get_context("spawn")


class Sampler(threading.Thread):
    """Looks once a second at the memory of the service and of its runners."""

    def __init__(self, service):
        super().__init__(daemon=True)
        self.service = service
        self.samples = []  # (monotonic s, MB of the service, MB of its runners)

    def run(self):
        while True:
            pid = self.service.process.pid
            runners = sum(resident_mb(runner) for runner in self.service.runners())
            self.samples.append((time.monotonic(), resident_mb(pid), runners))
            time.sleep(1.0)

    def largest(self, begin=0.0, end=float("inf")):
        """(service, runners) in MB within an interval."""
        within = [sample for sample in self.samples if begin <= sample[0] < end] or [(0, 0.0, 0.0)]
        return max(sample[1] for sample in within), max(sample[2] for sample in within)


class Phase:
    """Honest clients for some time: their samples, and the processor time of everybody."""

    def __init__(self, name, service, seconds, right, numbers, attackers=()):
        self.name = name
        self.samples = []
        self.begin = time.monotonic()
        used = self.processors_used(service, attackers)
        results = spawning.Queue()
        share = len(numbers) // len(OWNERS)
        clients = [spawning.Process(target=honest.run, daemon=True, args=(
            service.port, owner, service.keys[owner], numbers[n * share:] + numbers[:n * share], right, results, seconds,
            n * honest.PACE / len(OWNERS)))
            for n, owner in enumerate(OWNERS)]
        for client in clients:
            client.start()
        self.collect(results, len(clients), seconds + 4 * honest.PATIENCE)
        self.end = time.monotonic()
        for client in clients:
            client.join(1.0)
        now = self.processors_used(service, attackers)
        self.processors = {who: (value - used[who]) / (self.end - self.begin) for who, value in now.items()}

    @staticmethod
    def processors_used(service, attackers):
        """Processor time by user, in s; "others" are no part of the measurement, and disturb it."""
        used = {"service": service.processor_seconds(), "attackers": sum(map(processor_seconds, attackers)),
                "clients": processor_seconds(os.getpid())}
        return {**used, "others": processor_seconds_of_all() - sum(used.values())}

    def collect(self, results, clients, longest):
        late = time.monotonic() + longest
        while clients and time.monotonic() < late:
            try:
                sample = results.get(timeout=1.0)
            except queue.Empty:
                continue
            if sample is None:
                clients -= 1
            else:
                self.samples.append(sample)
        if clients:
            self.samples.append(honest.Sample(late, 0.0, 0.0, "a client does not end", 0, None))

    def outcomes(self):
        return collections.Counter(sample.outcome for sample in self.samples)

    def seconds(self, share, field="seconds", begin=0.0, end=float("inf")):
        return quantile([getattr(sample, field) for sample in self.samples if begin <= sample.begin < end], share)

    def learnt(self):
        """Value by number, of what was answered right; numbers with two values are named by None."""
        values = {}
        for sample in self.samples:
            if sample.outcome == "right":
                values[sample.number] = sample.value if values.get(sample.number, sample.value) == sample.value else None
        return values


class Attackers:
    """The processes that attack."""

    def __init__(self, service, names, folder, receiver):
        self.files = {name: folder / f"{name}.json" for name in names}
        self.processes = {name: spawning.Process(target=attacks.run, daemon=True, args=(
            name, service.port, service.keys.get(f"attacker {name}"), str(self.files[name]), number, receiver))
            for number, name in enumerate(names)}
        for process in self.processes.values():
            process.start()

    def pids(self):
        return [process.pid for process in self.processes.values()]

    def counts(self):
        return {name: json.loads(file.read_text()) if file.exists() else {} for name, file in self.files.items()}

    def end(self):
        for process in self.processes.values():
            process.kill()
        for process in self.processes.values():
            process.join()


def stops(service, count, draw):
    """[(s until the exit, exit status, runners left)] of SIGTERM at random moments."""
    found = []
    for _ in range(count):
        time.sleep(draw.uniform(0.2, 6.0))
        runners = service.runners()
        seconds, status = service.terminate()
        time.sleep(0.2)
        found.append((seconds, status, sum(resident_mb(runner) > 0 for runner in runners)))
        service.start()
    return found


def listed(counts):
    return ", ".join(f"{count} {what}" for what, count in sorted(counts.items())) or "0"


def judge(verdict, phases, sampler, ended, counts, settings):
    quiet, hostile = phases
    others = max(phase.processors["others"] for phase in phases)
    verdict.ask("processors used by other programs, which disturb the measurement", f"{OTHERS:g}", f"{others:.2f}", others <= OTHERS)
    spoilt = {outcome: count for outcome, count in quiet.outcomes().items() if outcome != "right"}
    verdict.ask("honest jobs without a right answer in the quiet time", "0", listed(spoilt), not spoilt)
    ratio = hostile.seconds(0.99) / quiet.seconds(0.99)
    verdict.ask("p99 of honest answers among attackers / quiet", f"at most {RATIO:g}", f"{ratio:.2f}", ratio <= RATIO)
    outcomes = hostile.outcomes()
    right = outcomes.pop("right", 0)
    wrong = outcomes.pop("wrong", 0)
    twice = sum(value is None for value in quiet.learnt().values())
    verdict.ask("honest answers that differ from those of the quiet time", "0", f"{wrong + twice} of {right + wrong}",
                wrong + twice == 0)
    failed = {outcome: count for outcome, count in outcomes.items() if outcome.startswith("5")}
    other = {outcome: count for outcome, count in outcomes.items() if outcome not in failed}
    verdict.ask("5xx to honest clients among attackers", "0", listed(failed), not failed)
    verdict.ask("honest jobs among attackers without a result for another reason", "0", listed(other), not other)
    most, runners = sampler.largest()
    bound = settings["workers"] * settings["max_job_memory_bytes"] / (1 << 20)
    verdict.ask("largest memory of the service, MB", f"{SERVICE_MB}", f"{most:.0f}", most <= SERVICE_MB)
    verdict.ask("largest memory of its runners, MB", f"{bound:.0f}", f"{runners:.0f}", runners <= bound)
    longest = max((seconds for seconds, _, _ in ended), default=0.0)
    verdict.ask(f"longest of {len(ended)} ends by SIGTERM, s", f"{STAGES + READING:g}", f"{longest:.2f}", longest <= STAGES + READING)
    strange = [f"status {status}, {left} runners" for _, status, left in ended if status != 0 or left]
    verdict.ask("ends by SIGTERM with another status than 0, or with runners left", "0", "; ".join(strange) or "0", not strange)
    continued = counts.get("slow_bodies", {}).get("100", 0)
    verdict.ask("100-continue to clients without a key", "0", str(continued), continued == 0)
    taken = sum(count for status, count in counts.get("titles", {}).items() if status == "201")
    verdict.ask("jobs taken with titles of 8 MB", "0", str(taken), taken == 0)


def phase_lines(phases, sampler):
    lines = ["| phase | jobs | p50 ms | p99 ms | worst ms | clients' own lateness p99 ms | processors used by |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for phase in phases:
        values = [1e3 * phase.seconds(share) for share in (0.5, 0.99, 1.0)] + [1e3 * phase.seconds(0.99, "lateness")]
        lines.append(f"| {phase.name} | {len(phase.samples)} | " + " | ".join(f"{value:.1f}" for value in values)
                     + " | " + ", ".join(f"{who} {value:.2f}" for who, value in phase.processors.items()) + " |")
    lines += ["", "| phase, s | p50 ms | p99 ms | service MB | runners MB |", "| --- | --- | --- | --- | --- |"]
    for phase in phases:
        step = max(5.0, min(60.0, (phase.end - phase.begin) / 10))
        begin = phase.begin
        while begin < phase.end:
            most, runners = sampler.largest(begin, begin + step)
            p50, p99 = (1e3 * phase.seconds(share, begin=begin, end=begin + step) for share in (0.5, 0.99))
            lines.append(f"| {phase.name} {begin - phase.begin:.0f} | {p50:.1f} | {p99:.1f} | {most:.0f} | {runners:.0f} |")
            begin += step
    return lines


def report(arguments, verdict, phases, sampler, ended, counts, log):
    lines = [f"# A service among attackers: {arguments.minutes:g} minutes, store {arguments.store.split(':')[0]},"
             f" {os.cpu_count()} processors", "", verdict.table(), "", *phase_lines(phases, sampler), "",
             "Ends by SIGTERM, s: " + ", ".join(f"{seconds:.2f}" for seconds, _, _ in ended), "",
             "| attack | what it does | met |", "| --- | --- | --- |"]
    for name, met in counts.items():
        told = ", ".join(f"{what}: {count:.0f}" for what, count in sorted(met.items()))
        lines.append(f"| {name} | {attacks.ATTACKS[name].__doc__} | {told} |")
    kinds = collections.Counter(f"{entry['event']}: {entry.get('detail', '')[:100]}" for entry in log)
    lines += ["", f"Errors in the log: {len(log)}"] + [f"- {count} x {kind}" for kind, count in kinds.most_common(10)]
    return "\n".join(lines) + "\n"


def service_of(arguments, folder, receiver):
    secret = folder / "secret"
    secret.write_text("whsec_" + base64.b64encode(os.urandom(32)).decode())
    secret.chmod(0o600)
    given = dict(one.split("=", 1) for one in arguments.set)
    settings = {name: int(value) if value.isdigit() else value for name, value in given.items()}
    owners = [*OWNERS, *(f"attacker {name}" for name in arguments.only if name not in attacks.WITHOUT_KEY)]
    return ServiceProcess(arguments.program, folder, None if arguments.store == "sqlite" else arguments.store, owners,
                          callback_hosts=f"localhost:{receiver}", callback_secret_file=str(secret), **settings)


def day(arguments, folder):
    receiver = free_port()
    service = service_of(arguments, folder, receiver)
    service.start()
    sampler = Sampler(service)
    sampler.start()
    verdict, attackers = Verdict(), None
    limits = service.json("/v1/limits", "ann")
    try:
        quiet_seconds = arguments.minutes * 15
        # Numbers of which each is computed in the quiet time, some of them by two owners
        numbers = list(range(max(10, min(NUMBERS, int(quiet_seconds / honest.PACE)))))
        quiet = Phase("quiet", service, quiet_seconds, {}, numbers)
        right = {number: value for number, value in quiet.learnt().items() if value}
        attackers = Attackers(service, arguments.only, folder, receiver)
        time.sleep(5.0)
        hostile = Phase("hostile", service, 2 * quiet_seconds, right, sorted(right), attackers.pids())
        counts = attackers.counts()
        status = service.process.poll()
        verdict.ask("the service lives after the attacks", "yes", "yes" if status is None else f"exit status {status}", status is None)
        if status is not None:
            service.start()
        ended = stops(service, arguments.stops, random.Random(arguments.seed))
    finally:
        if attackers:
            attackers.end()
        service.kill()
    judge(verdict, (quiet, hostile), sampler, ended, counts, limits)
    return verdict, report(arguments, verdict, (quiet, hostile), sampler, ended, counts, service.errors_logged())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--store", default="sqlite", help="sqlite, or the address of a database of PostgreSQL for this run alone")
    parser.add_argument("--minutes", type=float, default=40.0)
    parser.add_argument("--report", type=pathlib.Path, metavar="FILE.md")
    parser.add_argument("--stops", type=int, default=20, metavar="COUNT")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="+", choices=attacks.ATTACKS, default=list(attacks.ATTACKS), metavar="ATTACK")
    parser.add_argument("--set", nargs="+", default=[], metavar="NAME=VALUE", help="settings of the service")
    arguments = parser.parse_args()
    leave_by_exception()
    open_files_as_many_as_allowed()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="snapthrough-day-"))
    verdict, text = day(arguments, folder)
    print(text)
    if arguments.report:
        arguments.report.write_text(text, encoding="utf-8")
    if verdict.missed:
        print(f"the log of the service is in {folder}")
    else:
        shutil.rmtree(folder)
    return 1 if verdict.missed else 0


if __name__ == "__main__":
    sys.exit(main())
