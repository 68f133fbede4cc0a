"""Runs the command line program on one request and reads the critical points of its primary path."""
import json
import math
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import command_line  # noqa: E402


class Point:
    """A critical point: its kind, load factor and estimated relative error."""

    def __init__(self, kind, load, estimate):
        self.kind = kind
        self.load = load
        self.estimate = estimate

    def __str__(self):
        return f"{self.kind} {self.load:.10g}"


class Answer:
    """What the program answered: a code of failure or "", critical points of branch 0, the way of the path.

    A point of multiplicity n counts as n points, since a mesh without symmetry may part them.
    """

    def __init__(self, failure, points=(), document=None):
        self.failure = failure
        self.points = list(points)
        self.document = document

    def __str__(self):
        text = ", ".join(str(point) for point in self.points) or "no critical point"
        return f"{self.failure}: {text}" if self.failure else text

    def signature(self):
        """Failure and kinds in the order of the path."""
        return (self.failure, tuple(point.kind for point in self.points))

    def way(self):
        """Arc lengths of the steps of the primary path."""
        arcs = self.document["branches"][0]["arc_length"]
        return [end - start for start, end in zip(arcs, arcs[1:])]


def read_points(document):
    points = []
    for point in document["critical_points"]:
        if point["branch"] == 0:
            estimate = point["error_estimate"]
            one = Point(point["type"], point["load_factor"], math.inf if estimate is None else estimate)
            points += [one] * point["multiplicity"]
    return points


class Program:
    """The executable; a run that takes more than `seconds` of processor time is ended and answers `timeout`."""

    def __init__(self, binary, seconds=60.0):
        self.binary = binary
        self.seconds = seconds
        self.runs = 0

    def solve(self, request):
        self.runs += 1
        run = command_line.run_bounded([self.binary, "solve", "-"], json.dumps(request), self.seconds)
        if run is None:
            return Answer("timeout")
        if run.returncode not in (0, 3):
            first_line = run.stderr.strip().split("\n")[0]
            return Answer(f"exit {run.returncode} {first_line}")
        document = json.loads(run.stdout)
        failure = document.get("failure")
        return Answer(failure["code"] if failure else "", read_points(document), document)


def keep(folder, name, request):
    """Writes the request into the folder, if there is one, under a name of plain letters."""
    if folder:
        path = pathlib.Path(folder)
        path.mkdir(parents=True, exist_ok=True)
        file = path / (re.sub(r"[^A-Za-z0-9.+-]+", "_", name) + ".json")
        file.write_text(json.dumps(request, indent=1) + "\n", encoding="utf-8")


def allowance(first, second, accuracy_first, accuracy_second):
    """Largest relative difference of two loads that were asked for with these accuracies."""
    def error(point, accuracy):
        return max(accuracy, point.estimate) if math.isfinite(point.estimate) else accuracy
    return error(first, accuracy_first) + error(second, accuracy_second)


def same(first, second, accuracy_first, accuracy_second):
    """Whether two answers have the same critical points.

    Points are paired in the order of kind and load: a coarse mesh may exchange two that are closer than the accuracy.
    """
    if first.failure != second.failure or len(first.points) != len(second.points):
        return False

    def ordered(answer):
        return sorted(answer.points, key=lambda point: (point.kind, point.load))

    for one, other in zip(ordered(first), ordered(second)):
        allowed = allowance(one, other, accuracy_first, accuracy_second)
        if one.kind != other.kind or abs(one.load - other.load) > allowed * max(abs(one.load), abs(other.load)):
            return False
    return True
