"""Values of the gallery: expressions in the results of requests, compared with published ones.

examples/gallery/pages/NAME.toml lists the values of a page. Each [[value]] has a `name`, a `request` (examples/gallery/REQUEST.json; by
default NAME.json) with `changes` {JSON Pointer: value}, and `found`, an arithmetic expression in which

  of(POINTER)       is a number of the result, by its JSON Pointer,
  limit(TYPE, n)    is the load factor of the nth critical point (from 1) of a type,
  at(POINTER)       is a number of the request with its changes.

In place of a request it may have a `chart`; found is then an expression with quantile(SHARE) of critical load factors where its rows
are random samples, before(n, COLUMN) and after(n, COLUMN) where it is refined: the rows on both sides of the nth change (from 1).
A value of the page's table has `published` (an expression, too), `tolerance`, `what`, `source` and `why`: found / published - 1 is
within the tolerance of `expected` (0).
"""
import copy
import json
import math
import subprocess
import time
import tomllib

from lib.thesis_data import ROOT, run_program

EXAMPLES = ROOT / "examples" / "gallery"
PAGES = EXAMPLES / "pages"
POINTS_FAILED = 3  # exit status of a sweep whose table has rows with an error
NUMBERS = {name: getattr(math, name) for name in ("pi", "sqrt", "exp", "log", "sin", "cos", "tan", "atan2", "hypot", "sinh", "cosh",
                                                  "tanh")}
NUMBERS |= {"abs": abs, "min": min, "max": max, "sum": sum, "len": len, "__builtins__": {}}


def resolved(document, pointer):
    for key in pointer.split("/")[1:]:
        document = document[int(key) if isinstance(document, list) else key.replace("~1", "/").replace("~0", "~")]
    return document


def request_with(name, changes):
    """examples/gallery/NAME.json with other values at JSON Pointers; a field that is not there is added."""
    request = json.loads((EXAMPLES / f"{name}.json").read_text(encoding="utf-8"))
    for pointer, value in changes.items():
        parent, _, last = pointer.rpartition("/")
        target = resolved(request, parent)
        target[int(last) if isinstance(target, list) else last] = copy.deepcopy(value)
    return request


def chart_document(chart):
    return json.loads((EXAMPLES / "charts" / f"{chart}.json").read_text(encoding="utf-8"))


class Value:
    """A value with what was found: `found`, `published` or None, `estimate` or None, `accuracy` asked or None."""

    def __init__(self, entry, found, published, estimate, accuracy):
        self.entry, self.found, self.published, self.estimate, self.accuracy = entry, found, published, estimate, accuracy

    @property
    def difference(self):
        return self.found / self.published - 1

    def wrong(self):
        """What is wrong with the value; None when all is well."""
        if self.estimate is not None and not self.estimate <= self.accuracy:
            return f"error estimate {self.estimate} where {self.accuracy} was asked for"
        off = None if self.published is None else self.difference - self.entry.get("expected", 0.0)
        if off is not None and not abs(off) <= self.entry["tolerance"]:
            return f"{self.found}, published {self.published}, difference {self.difference:.3g}"
        return None


class Runs:
    """Results of requests with changes, and tables of sweeps, each computed once."""

    def __init__(self, program):
        self.program, self.results, self.seconds = program, {}, []

    def result(self, name, changes):
        key = json.dumps([name, changes])
        if key not in self.results:
            request = request_with(name, changes)
            answer, seconds = run_program([self.program, "solve", "-"], f"{name} {changes}", json.dumps(request))
            self.results[key] = request, answer
            self.seconds.append(f"{seconds:8.2f} s  gallery/{name}.json {changes or ''}".rstrip())
        return self.results[key]

    def table(self, chart):
        """Columns and rows of examples/gallery/charts/CHART.json."""
        return self.swept(f"charts/{chart}.json", chart_document(chart))

    def swept(self, name, document):
        """Columns and rows of a sweep, whose name says all that differs between sweeps. Points may have failed."""
        if name not in self.results:
            start = time.monotonic()
            done = subprocess.run([self.program, "sweep", "-"], input=json.dumps(document), capture_output=True, text=True, check=False)
            if done.returncode not in (0, POINTS_FAILED):
                raise SystemExit(f"{name}: exit status {done.returncode}: {done.stderr.strip()}")
            self.results[name] = json.loads(done.stdout)
            self.seconds.append(f"{time.monotonic() - start:8.2f} s  gallery/{name}, {len(self.results[name]['rows'])} points")
        return self.results[name]


def quantile(numbers, share):
    """Quantile of samples by linear interpolation between (i + 1/2) / n."""
    ordered = sorted(numbers)
    place = min(max(share * len(ordered) - 0.5, 0.0), len(ordered) - 1.0)
    low = int(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def estimate_at(result, pointer):
    """Error estimate of what a JSON Pointer of the result leads to; None where the result has none."""
    kind, *rest = pointer.split("/")[1:]
    if kind == "critical_points":
        return result[kind][int(rest[0])]["error_estimate"]
    if kind == "buckling":
        return result[kind]["error_estimates"][int(rest[1])]
    return result[kind]["error_estimate"] if rest == ["critical_load_factor"] else None


def chart_names(table):
    """What expressions can use of a sweep's table: its samples, and the rows before and after each change."""
    columns, rows = table["columns"], table["rows"]
    changes = [i for i, row in enumerate(rows) if "change" in columns and row[columns.index("change")] is not None]

    def cells(some, column):
        return [row[columns.index(column)] for row in some]

    def beside(number, column, step):
        if number > len(changes):
            raise SystemExit(f"a chart has {len(changes)} changes, and the value of {column} beside number {number} is asked for")
        return cells(rows, column)[changes[number - 1] + step]

    return {
        "quantile": lambda share: quantile(cells((row for row in rows if row[-1] is None), "/summary/critical_load_factor"), share),
        "before": lambda number, column: beside(number, column, -1),
        "after": lambda number, column: beside(number, column, 0),
    }


def evaluate(entry, runs):
    if "chart" in entry:
        names = NUMBERS | chart_names(runs.table(entry["chart"]))
        return Value(entry, eval(entry["found"], names), eval(entry["published"], NUMBERS) if "published" in entry else None, None, None)
    request, result = runs.result(entry["request"], entry.get("changes", {}))
    estimates = []

    def of(pointer):
        estimates.append(estimate_at(result, pointer))
        return resolved(result, pointer)

    def limit(kind, number=1):
        points = [i for i, point in enumerate(result["critical_points"]) if point["type"] == kind]
        return of(f"/critical_points/{points[number - 1]}/load_factor")

    names = {"of": of, "limit": limit, "at": lambda pointer: resolved(request, pointer)}
    found = eval(entry["found"], NUMBERS | names)
    published = eval(entry["published"], NUMBERS | names) if "published" in entry else None
    known = [estimate for estimate in estimates if estimate is not None]
    return Value(entry, found, published, max(known, default=None), result["discretization"]["accuracy"]["requested"])


def page_data(name):
    """The parts of examples/gallery/pages/NAME.toml; values and figures have a request."""
    data = tomllib.loads((PAGES / f"{name}.toml").read_text(encoding="utf-8"))
    for part in data["value"] + data.get("figure", []):
        part.setdefault("request", name)
    return data


def page_values(data, runs):
    """{name: Value} of a page."""
    return {entry["name"]: evaluate(entry, runs) for entry in data["value"]}
