"""Runs the command line program on requests, several at a time; shared by checkers that know the program by its answers only."""
import argparse
import concurrent.futures
import json
import os
import math
import pathlib
import signal
import subprocess


class Answer:
    """What the program answered: its exit status and the JSON document on standard output (empty if there is none)."""

    def __init__(self, status, document, text=""):
        self.status = status
        self.document = document
        self.text = text

    def failure(self):
        """Code of the failure; "" for an analysis that did what was asked; "timeout" and "document" (exit status 2)."""
        if self.status == "timeout":
            return "timeout"
        if self.status == 2:
            return "document"
        return self.document.get("failure", {}).get("code", "") if self.document else f"exit {self.status}"

    def detail(self):
        """The sentence of the failure; for a wrong document its findings."""
        if self.document:
            return self.document.get("failure", {}).get("detail", "")
        return self.text.strip()

    def warnings(self):
        """Codes of the warnings."""
        return [warning["code"] for warning in self.document.get("warnings", [])] if self.document else []


def run_bounded(command, text, seconds):
    """The completed process of a command that reads `text`; None if it takes more than `seconds` of processor time.

    Other work on the machine does not count; a process that waits for good is ended after a multiple of that time.
    """
    script = 'ulimit -S -t "$0"; exec "$@"'
    try:
        run = subprocess.run(["sh", "-c", script, str(math.ceil(seconds)), *command], input=text, capture_output=True, text=True,
                             timeout=60.0 + 10.0 * seconds, check=False)
    except subprocess.TimeoutExpired:
        return None
    return None if run.returncode == -signal.SIGXCPU else run


def solve(binary, request, seconds=60.0):
    """Solves one request; a run that takes more than `seconds` of processor time is ended."""
    run = run_bounded([binary, "solve", "-"], json.dumps(request), seconds)
    if run is None:
        return Answer("timeout", None)
    try:
        document = json.loads(run.stdout)
    except json.JSONDecodeError:
        document = None
    if run.returncode not in (0, 3) or not isinstance(document, dict):
        return Answer(run.returncode, None, run.stdout + run.stderr)
    return Answer(run.returncode, document)


def seeded_parser(doc, count, seconds):
    """A parser of the options that checkers of random structures share.

    doc: docstring of the checker; count, seconds: structures and seconds a run, if the options do not say.
    """
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=count)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=seconds)
    return parser


def for_each(items, work, jobs):
    """Yields (item, work(item)) in the order of the items; `jobs` are at work at a time."""
    with concurrent.futures.ThreadPoolExecutor(max_workers=jobs) as pool:
        yield from zip(items, pool.map(work, items))


def keep(folder, name, request):
    """Writes a request to FOLDER/NAME.json, if there is a folder."""
    if folder:
        path = pathlib.Path(folder)
        path.mkdir(parents=True, exist_ok=True)
        (path / f"{name}.json").write_text(json.dumps(request, indent=1), encoding="utf-8")
