#!/usr/bin/env python3
"""Fits the law by which POST /v1/check expects processor time, and tells how far off it is.

  bench/expected_time.py measure LIBRARY CSV [--count N]    # solve variations of the examples, write a row of each
  bench/expected_time.py fit CSV [--keep NAME,...]          # print the coefficients and the errors of held-back requests
  bench/expected_time.py sweeps LIBRARY                     # time of a point in a sweep, and along a followed curve
  bench/expected_time.py compare LIBRARY CSV                # what the program expects of the rows, against what they took

LIBRARY is libsnapthrough.so of a release build. Variations are drawn by a generator with a fixed seed: another analysis,
mesh, accuracy, output, stiffness of sections and bases, and frames of random size. Each is solved in a process of its own
that has solved a small one before, as a runner of the service has; a row has the processor time of one of its repetitions,
reading the request and writing the result included. A request that was stopped at --limit has that time, after ">". `fit`
computes log(seconds) as a sum of features by least squares, for one half of the bases at a time, and judges it on the other
half: no variation of a structure is in both. The coefficients that it prints are those of all rows; api/expected_time.cpp
has them.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import random
import resource
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "clients" / "python"))

TYPES = ["buckling", "critical", "path", "static", "vibration"]
#: Terms beside those of the type and log(unknowns), in the order of api/expected_time.cpp.
TERMS = ["digits", "given_mesh", "log_order", "members", "bases", "one_sided", "laws", "rows", "modes", "limit_points", "steps",
         "path_points", "branches", "frequencies", "worst", "linear", "sensitivities", "koiter", "states", "curved",
         "contact_buckling"]


# --- what the law sees of a request

def features(request):
    """The terms of a request by name; api/expected_time.cpp computes the same from what it read."""
    model, analysis = request["model"], request["analysis"]
    kind, mesh, output = analysis["type"], analysis.get("discretization", {}), analysis.get("output", {})
    given = any(key in mesh for key in ("elements", "order", "foundation"))
    bases = model.get("foundations", [])
    one_sided = [base for base in bases if base.get("reaction", "bilateral") != "bilateral"]
    laws = [part for part in bases + model.get("springs", []) if "law" in part]
    path, rows = kind == "path", kind in ("static", "vibration")
    count = lambda number: math.log1p(number)
    return {
        "digits": 0.0 if given else -math.log10(mesh.get("accuracy", 1e-3)) - 3.0,
        "given_mesh": float(given),
        "log_order": math.log(mesh.get("order", 1)) if given else 0.0,
        "members": math.log(len(model["members"])),
        "bases": count(len(bases) - len(one_sided)),
        "one_sided": count(len(one_sided)),
        "laws": count(len(laws)),
        "rows": math.log(max(1, len(analysis.get("load_factors", [1])))) if rows else 0.0,
        "modes": math.log(analysis.get("modes", 1)) if kind in ("buckling", "vibration") else 0.0,
        "limit_points": count(analysis.get("stop", {}).get("limit_points", 0)) if path else 0.0,
        "steps": math.log(analysis["stop"]["steps"] / 100) if path and "steps" in analysis.get("stop", {}) else 0.0,
        "path_points": count(output.get("path_points", 0) / 100) if path else 0.0,
        "branches": float(path and analysis.get("branches", {}).get("follow", "primary") != "primary"),
        "frequencies": count(output.get("frequencies", 0)),
        "worst": float(any(one["type"] == "worst" for one in model.get("imperfections", []))),
        "linear": float(analysis.get("geometry") == "linear"),
        "sensitivities": count(len(analysis.get("sensitivities", []))),
        "koiter": float(analysis.get("koiter", False)),
        "states": float(output.get("states", "critical") not in ("none", "critical")),
        "curved": float(any(member.get("curve", {"type": "line"})["type"] != "line" for member in model["members"])),
        "contact_buckling": float(kind == "buckling" and len(one_sided) > 0),
    }


# --- requests

def at_random_point(document, draw):
    """The request of a random point of a sweep, or a request as it is."""
    request = {"model": json.loads(json.dumps(document["model"])), "analysis": dict(document["analysis"])}
    for parameter in document.get("parameters", []):
        if "values" in parameter:
            value = draw.choice(parameter["values"])
        elif "range" in parameter:
            low, high = parameter["range"]["from"], parameter["range"]["to"]
            share = draw.random()
            value = low * (high / low) ** share if parameter["range"].get("spacing") == "log" else low + (high - low) * share
        else:
            continue
        for target in parameter.get("targets", []):
            *way, last = [part.replace("~1", "/").replace("~0", "~") for part in target["pointer"].split("/")[1:]]
            at = request
            for part in way:
                at = at[int(part) if isinstance(at, list) else part]
            changed = target.get("scale", 1) * value ** target.get("power", 1) if isinstance(value, (int, float)) else value
            at[int(last) if isinstance(at, list) else last] = changed
    return request


def frame(draw):
    """A clamped frame of some bays and storeys, loaded at its columns' heads and by a small horizontal force."""
    bays, storeys = draw.randint(1, 6), draw.randint(1, 6)
    nodes = [{"id": f"n{i}_{j}", "x": 4 * i, "y": 3 * j} for i in range(bays + 1) for j in range(storeys + 1)]
    line = lambda name, a, b, section: {"id": name, "start": a, "end": b, "section": section}
    members = [line(f"c{i}_{j}", f"n{i}_{j}", f"n{i}_{j + 1}", "column") for i in range(bays + 1) for j in range(storeys)]
    members += [line(f"b{i}_{j}", f"n{i}_{j}", f"n{i + 1}_{j}", "beam") for i in range(bays) for j in range(1, storeys + 1)]
    loads = [{"type": "point", "at": {"node": f"n{i}_{j}"}, "force": [0.002 * (i == 0), -1]}
             for i in range(bays + 1) for j in range(1, storeys + 1)]
    return {"model": {"nodes": nodes, "members": members, "loads": loads,
                      "sections": [{"id": "column", "EA": 1e6, "EI": 2e3}, {"id": "beam", "EA": 1e6, "EI": 3e3}],
                      "supports": [{"node": f"n{i}_0", "fixed": ["x", "y", "rotation"]} for i in range(bays + 1)]},
            "analysis": {"type": "critical"}}


def bases():
    """(name, document) of each request or sweep among the examples, and a name for frames."""
    found = []
    for folder in (".", "gallery", "gallery/charts", "thesis", "thesis/paths", "sweeps", "sizing"):
        for file in sorted((ROOT / "examples" / folder).glob("*.json")):
            document = json.loads(file.read_text())
            if "model" in document and "analysis" in document:
                found.append((str(file.relative_to(ROOT / "examples")), document))
    return found + [(f"frame {number}", None) for number in range(1, 13)]


def vary_model(model, draw):
    """Other stiffnesses of sections and bases, and at times a base in pieces."""
    for section in model["sections"]:
        if isinstance(section.get("EI"), (int, float)):
            section["EI"] *= math.exp(draw.gauss(0, 0.3))
    for base in list(model.get("foundations", [])):
        if isinstance(base.get("stiffness"), (int, float)):
            base["stiffness"] *= 10 ** draw.uniform(-1, 1)
        if "range" not in base and draw.random() < 0.15:
            pieces = draw.randint(2, 5)
            model["foundations"].remove(base)
            for k in range(pieces):
                model["foundations"].append({**base, "id": f"{base['id']}_{k}", "range": [k / pieces, (k + 1) / pieces]})


def vary_path(analysis, draw):
    """What a path is asked for, and where it stops."""
    stop = dict(analysis.get("stop", {}))
    if not stop or draw.random() < 0.5:
        stop = {"limit_points": draw.randint(1, 3), **({"load_factor": stop["load_factor"]} if "load_factor" in stop else {})}
    if draw.random() < 0.3 or "limit_points" in stop:
        stop["steps"] = draw.choice([20, 50, 100, 300])
    analysis["stop"] = stop
    if draw.random() < 0.2:
        analysis["output"]["path_points"] = draw.choice([50, 100, 200, 400])
    if draw.random() < 0.15:
        analysis["branches"] = {"follow": draw.choice(["first", "all"]), "limit": draw.randint(1, 3)}
    if draw.random() < 0.15:
        analysis["output"]["states"] = "all"
    if draw.random() < 0.1:
        analysis["koiter"] = True


def vary_analysis(request, draw, critical):
    """Another type, mesh, accuracy and output. `critical` is the first critical load factor or None."""
    model, old = request["model"], request["analysis"]
    kind = old["type"] if draw.random() < 0.45 else draw.choice(TYPES + ["static", "vibration"])  # few examples have these
    kept = dict(old) if kind == old["type"] else {}
    analysis = {**kept, "type": kind, "output": dict(kept.get("output", {}))}
    request["analysis"] = analysis
    if draw.random() < 0.6:
        analysis["discretization"] = ({"accuracy": 10.0 ** -draw.randint(2, 8)} if draw.random() < 0.6 else
                                      {"elements": round(4 * 2 ** draw.uniform(0, 6)), "order": draw.randint(1, 6)})
    if kind == "path":
        vary_path(analysis, draw)
    if kind in ("static", "vibration") and kept == {}:
        rows = draw.choice([1, 1, 3, 10])
        top = 0.8 * abs(critical) if critical else 0.5
        analysis["load_factors"] = [top * (k + 1) / rows for k in range(rows)]
    if kind in ("static",) and draw.random() < 0.15:
        analysis["geometry"] = "linear"
    if kind in ("buckling", "vibration"):
        analysis["modes"] = draw.choice([1, 1, 2, 4, 8])
    if kind in ("path", "static") and draw.random() < 0.12:
        analysis["output"]["frequencies"] = draw.randint(1, 4)
    if kind == "critical" and draw.random() < 0.2:
        span = max(node["x"] for node in model["nodes"]) - min(node["x"] for node in model["nodes"])
        model["imperfections"] = [{"type": "worst", "norm": draw.choice(["rms", "max"]), "amplitude": 1e-3 * (span or 1.0)}]
    if kind == "critical" and draw.random() < 0.15:
        analysis["sensitivities"] = ["/model/sections/0/EI", "/model/sections/0/EA"][:draw.randint(1, 2)]
    if kind == "vibration" or analysis["output"].get("frequencies"):
        for section in model["sections"]:
            section.setdefault("mass", 1.0)


# --- measuring

def in_child(work, limit=60):
    """What work() returns as JSON, from a process that ends after `limit` seconds of the processor; None when it did."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        used = resource.getrusage(resource.RUSAGE_SELF)
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(used.ru_utime + used.ru_stime) + limit,) * 2)
        os.write(writer, json.dumps(work()).encode())
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as answer:
        text = answer.read()
    os.waitpid(child, 0)
    return json.loads(text) if text else None


def seconds_of(work):
    """Processor seconds of work(): the mean over some repetitions, since systems count them in ticks, or the least by the
    clock, where no other program has disturbed that."""
    clock, spent, repetitions = math.inf, 0.0, 0
    while repetitions < 12 and (spent < 0.5 or repetitions == 1 and spent < 1.0):
        before, began = time.process_time(), time.perf_counter()
        work()
        spent, clock = spent + time.process_time() - before, min(clock, time.perf_counter() - began)
        repetitions += 1
    return min(clock, spent / repetitions)


def measured(library, text):
    """(status of the analysis, its processor seconds)."""
    library.solve((ROOT / "examples" / "column_winkler.json").read_bytes())
    statuses = []
    seconds = seconds_of(lambda: statuses.append(library.solve(text).status))
    return [statuses[-1], seconds]


def first_critical(library, request):
    """The request's first critical load factor, or None."""
    document = {"model": request["model"], "analysis": {"type": "critical", "output": {"states": "none"}}}
    answer = json.loads(library.solve(json.dumps(document).encode()).text)
    return answer.get("summary", {}).get("critical_load_factor")


def variations(library, count):
    """(name of the base, request) so often; those that the program refuses are drawn again."""
    found = bases()
    draw = random.Random(20)
    made = 0
    while made < count:
        name, document = found[made % len(found)]
        for _ in range(20):
            request = at_random_point(document, draw) if document else frame(draw)
            vary_model(request["model"], draw)
            critical = in_child(lambda: first_critical(library, request), 5)
            vary_analysis(request, draw, critical)
            size = json.loads(library.check(json.dumps(request).encode()).text)["size"]
            if size is not None:
                yield name, request, size["unknowns"]
                break
        made += 1


def measure(options):
    """Writes a row for each request; one that does not end within the limit has this, after ">". Earlier rows stay."""
    from snapthrough._library import Library
    library = Library(options.library)
    file = pathlib.Path(options.csv)
    header = ["base", "type", "unknowns", "cpu_seconds", "request"]
    known = set()
    if file.exists():
        with file.open(newline="") as text:
            known = {row["request"] for row in csv.DictReader(text)}
    with file.open("a", newline="") as text:
        table = csv.writer(text)
        if not known:
            table.writerow(header)
        for name, request, unknowns in variations(library, options.count):
            document = json.dumps(request)
            if document in known:
                continue
            outcome = in_child(lambda: measured(library, document.encode()), options.limit)
            if outcome and outcome[0] != 0:
                print(f"left out: {name} has no {request['analysis']['type']}")
                continue
            took = f"{outcome[1]:.6g}" if outcome else f">{options.limit}"
            table.writerow([name, request["analysis"]["type"], unknowns, took, document])
            text.flush()


# --- fitting

def solved(matrix, right):
    """x of matrix x = right, by elimination with pivots."""
    n = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            ratio = rows[i][k] / rows[k][k]
            if ratio:
                rows[i] = [a - ratio * b for a, b in zip(rows[i], rows[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def columns(row, terms):
    """Factors of the coefficients: common constant, of types, common power, of types, terms."""
    of_type = [float(row["type"] == kind) for kind in TYPES]
    size = math.log(max(1, row["unknowns"]) / 100)
    return [1.0, *of_type, size, *(size * one for one in of_type), *(row[term] for term in terms)]


def fitted(rows, terms):
    """Least squares on log(seconds). Every coefficient but the two common ones is drawn to zero by the weight of one
    row, so that a type with few rows keeps to the law of all."""
    made = [columns(row, terms) for row in rows]
    n = len(made[0])
    common = (0, 1 + len(TYPES))
    matrix = [[sum(one[i] * one[j] for one in made) for j in range(n)] for i in range(n)]
    for i in range(n):
        matrix[i][i] += 1e-9 if i in common else 1.0
    return solved(matrix, [sum(one[i] * row["log"] for one, row in zip(made, rows)) for i in range(n)])


def expected_log(row, law, terms):
    return sum(a * b for a, b in zip(columns(row, terms), law))


def held_back(rows, terms, splits=1):
    """(row, error of log(seconds)) of each row by the law of the half of the bases that it is not in."""
    errors = []
    for split in range(splits):
        names = sorted({row["base"] for row in rows})
        random.Random(split).shuffle(names)
        first = set(names[::2])
        for inside in (True, False):
            law = fitted([row for row in rows if (row["base"] in first) == inside], terms)
            errors += [(row, row["log"] - expected_log(row, law, terms)) for row in rows if (row["base"] in first) != inside]
    return errors


def chosen(rows, terms, splits=3):
    """Terms without those whose absence does not make the held-back errors larger."""
    score = lambda some: sum(error ** 2 for _, error in held_back(rows, some, splits))
    terms, best = list(terms), score(terms)
    while terms:
        without = [(score([term for term in terms if term != left]), left) for left in terms]
        least, left = min(without)
        if least > best:
            break
        best = least
        terms.remove(left)
    return terms


def share(values, part):
    """The value that this part of the values does not exceed, between neighbours by a straight line."""
    values = sorted(values)
    at = part * (len(values) - 1)
    low = math.floor(at)
    return values[low] + (at - low) * (values[min(low + 1, len(values) - 1)] - values[low])


def read_rows(file):
    """Rows of `measure` with numbers as numbers. One that has not ended counts with the limit, which it took at least."""
    with open(file, newline="") as text:
        rows = list(csv.DictReader(text))
    for row in rows:
        row.update(features(json.loads(row["request"])), unknowns=int(row["unknowns"]),
                   log=math.log(float(row["cpu_seconds"].lstrip(">"))), base=pathlib.Path(row["base"]).stem)
    return rows


def fit(options):
    """Prints the coefficients by all rows, and how far off the laws of halves are."""
    rows = read_rows(options.csv)
    terms = options.keep.split(",") if options.keep else chosen(rows, TERMS)
    law = fitted(rows, terms)
    kinds = len(TYPES)
    unknowns = [row["unknowns"] for row in rows]
    print(f"{len(rows)} requests of {len({row['base'] for row in rows})} bases, {min(unknowns)} to {max(unknowns)} unknowns")
    errors = held_back(rows, terms, 8)
    for k, kind in enumerate([*TYPES, "all"]):
        some = [error for row, error in errors if kind in (row["type"], "all")]
        sizes = [abs(error) for error in some]
        times = [math.exp(row["log"]) for row in rows if kind in (row["type"], "all")]
        print(f"{kind}: {len(times)} requests of {min(times):.2g} to {max(times):.2g} s; off by the factor "
              + ", ".join(f"{math.exp(share(sizes, part)):.2f} ({part:.0%})" for part in (0.5, 0.8, 0.9)))
        if kind != "all":
            name = "static_" if kind == "static" else kind
            power = law[1 + kinds] + law[2 + kinds + k]
            print(f"    {{AnalysisType::{name}, {law[0] + law[1 + k]:.3f}, {power:.3f}, "
                  f"{math.exp(share(sizes, 0.5)):.2f}, {math.exp(share(some, 0.1)):.2f}, "
                  f"{math.exp(share(some, 0.9)):.2f}}},")
    for k, term in enumerate(terms):
        print(f"{term}: {law[2 + 2 * kinds + k]:.3f}  (not zero in {sum(row[term] != 0 for row in rows)} rows)")


# --- sweeps

def median_alone(library, document):
    """Median processor seconds of requests of random points, each computed alone."""
    draw = random.Random(1)
    requests = [json.dumps(at_random_point(document, draw)).encode() for _ in range(9)]
    return share([seconds_of(lambda: library.solve(request)) for request in requests if library.solve(request).status == 0], 0.5)


def curves(library):
    """Prints what a curve of n values costs, in analyses of one of its points."""
    for name in ("ring_followed", "arch_locus"):
        document = json.loads((ROOT / "examples" / "sweeps" / f"{name}.json").read_text())
        alone = median_alone(library, document)
        parameter = document["parameters"][-1]
        low, high = (parameter["values"][0], parameter["values"][-1]) if "values" in parameter else (
            parameter["range"]["from"], parameter["range"]["to"])
        for locus in (False, True):
            for count in (2, 10, 50, 200):
                parameter.pop("values", None)
                parameter["range"] = {"from": low, "to": high, "count": count, "spacing": "log"}
                document["follow"] = {"parameter": parameter["name"], "locus": True} if locus else parameter["name"]
                document["outputs"] = ["/curve/critical_points"] if locus else ["/summary/critical_load_factor"]
                text = json.dumps(document).encode()
                took = in_child(lambda: seconds_of(lambda: library.sweep(text, 0, count)))
                print(f"{name}, {'locus' if locus else 'first point'}, {count} values: "
                      + (f"{took / alone:.2f} analyses" if took else "too long"))


def sweeps(options):
    """Prints the time of a point within a sweep, as a part of that of the point's request alone."""
    from snapthrough._library import Library
    library = Library(options.library)
    curves(library)
    ratios = []
    for name, document in bases():
        if document is None or "parameters" not in document or "follow" in document:
            continue
        text = json.dumps(document).encode()

        def both():
            rows = len(json.loads(library.sweep(text, 0, 20).text)["rows"])
            return [seconds_of(lambda: library.sweep(text, 0, 20)) / rows, median_alone(library, document)]
        found = in_child(both)
        if found:
            ratios.append(found[0] / found[1])
            print(f"{name}: {found[0]:.4g} s a point, {found[1]:.4g} s alone, ratio {ratios[-1]:.2f}")
    print(f"median ratio {share(ratios, 0.5):.2f}, 80 % from {share(ratios, 0.1):.2f} to {share(ratios, 0.9):.2f}")


def compare(options):
    """Prints how far the answers of the program are from the times of the rows, and where it sees other terms."""
    from snapthrough._library import Library
    library = Library(options.library)
    rows = read_rows(options.csv)
    terms = options.keep.split(",")
    law = fitted(rows, terms)
    sizes, most = [], 0.0
    for row in rows:
        answer = json.loads(library.check(row["request"].encode()).text)["size"]["expected"]["cpu_seconds"]
        sizes.append(abs(math.log(answer) - row["log"]))
        most = max(most, abs(math.log(answer) - expected_log(row, law, terms)))
    print(f"off by the factor {math.exp(share(sizes, 0.5)):.2f} (50%), {math.exp(share(sizes, 0.8)):.2f} (80%); "
          f"the program differs from the fit by at most {math.expm1(most):.1%}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    one = commands.add_parser("measure")
    one.add_argument("library")
    one.add_argument("csv")
    one.add_argument("--count", type=int, default=250)
    one.add_argument("--limit", type=int, default=20, help="seconds of the processor for one request")
    one.set_defaults(run=measure)
    one = commands.add_parser("fit")
    one.add_argument("csv")
    one.add_argument("--keep", help="terms, with commas between; without it they are chosen")
    one.set_defaults(run=fit)
    one = commands.add_parser("sweeps")
    one.add_argument("library")
    one.set_defaults(run=sweeps)
    one = commands.add_parser("compare")
    one.add_argument("library")
    one.add_argument("csv")
    one.add_argument("--keep", required=True, help="terms of the program, with commas between")
    one.set_defaults(run=compare)
    options = parser.parse_args()
    options.run(options)


if __name__ == "__main__":
    main()
