"""Runs the documents of examples/thesis through the command line and finds our value beside a reference's."""
import copy
import csv
import json
import pathlib
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EXAMPLES = ROOT / "examples" / "thesis"
DOCS = ROOT / "docs" / "thesis"
SPRINGS = {"PP": "figure_4_6_column_spring_pinned_pinned", "CF": "figure_4_7_column_spring_clamped_free",
           "CP": "figure_4_8_column_spring_clamped_pinned", "CC": "figure_4_9_column_spring_clamped_clamped"}


def run_program(arguments, name, document=None):
    """The JSON that the command line prints, and the seconds it took."""
    start = time.monotonic()
    done = subprocess.run(arguments, input=document, capture_output=True, text=True, check=False)
    seconds = time.monotonic() - start
    if done.returncode != 0:
        raise SystemExit(f"{name}: exit status {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout), seconds


def run_sweep(program, path):
    """Rows as dictionaries, and the seconds it took."""
    table, seconds = run_program([program, "sweep", str(path)], path.name)
    return [dict(zip(table["columns"], row)) for row in table["rows"]], seconds


def run_sweep_at(program, name, values):
    """Rows of examples/thesis/NAME.json with other values, {parameter: [...]}."""
    sweep = json.loads((EXAMPLES / f"{name}.json").read_text(encoding="utf-8"))
    for parameter in sweep["parameters"]:
        parameter["values"] = values[parameter["name"]]
    table, _ = run_program([program, "sweep", "-"], name, json.dumps(sweep))
    return [dict(zip(table["columns"], row)) for row in table["rows"]]


def run_request(program, name, changes=()):
    """Result of examples/thesis/paths/NAME.json with changes ((JSON Pointer, value), ...), and the seconds it took."""
    request = copy.deepcopy(json.loads((EXAMPLES / "paths" / f"{name}.json").read_text(encoding="utf-8")))
    for pointer, value in changes:
        *parents, last = pointer.strip("/").split("/")
        target = request
        for key in parents:
            target = target[int(key) if isinstance(target, list) else key]
        target[int(last) if isinstance(target, list) else last] = value
    return run_program([program, "solve", "-"], f"{name} {changes}", json.dumps(request))


def read_csv(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def references():
    return read_csv(EXAMPLES / "reference.csv")


def on_thesis_mesh(row):
    """Whether a row's mesh is the thesis'; the other meshes follow from the accuracy asked for."""
    mesh = row.get("mesh")
    return not mesh or "accuracy" not in mesh  # a sweep over `elements` alone has no other


def elements_of(row):
    mesh = row.get("mesh")
    return mesh.get("elements") if mesh else row["elements"]


def value_of(row, what):
    """(load factor, error estimate) of `buckling n` or of the nth critical point of a kind; None where there is none."""
    kind, _, number = what.partition(" ")
    if kind == "buckling":
        return row["/buckling/load_factors/" + number], row["/discretization/accuracy/estimated"]
    wanted = int(number or 1)
    for i in range(12):
        if row.get(f"/critical_points/{i}/type") == kind:
            wanted -= 1
            if wanted == 0:
                return row[f"/critical_points/{i}/load_factor"], row.get(f"/critical_points/{i}/error_estimate")
    return None


def pick(rows, reference, on_thesis):
    """The row and its value beside a reference: on the thesis' own mesh, or converged. (None, None) without one."""
    for row in rows:
        if on_thesis_mesh(row) != on_thesis:
            continue
        if reference["key"] == "elements":
            if on_thesis and elements_of(row) != float(reference["value"]):
                continue
        elif abs(row[reference["key"]] - float(reference["value"])) > 1e-9 * abs(row[reference["key"]]):
            continue
        return row, value_of(row, reference["what"])
    return None, None


def percent(value, reference, places=2):
    return "" if value is None or not reference else f"{100 * (value / float(reference) - 1):+.{places}f}"


def as_printed(number, places=6):
    """The digits that a source has, at most `places` of them."""
    return number if len(number.partition(".")[2]) <= places else f"{float(number):.{places}f}"


def digits(value, places=6):
    return "" if value is None else f"{value:.{places}f}"
