#!/usr/bin/env python3
"""Halves and doubles each limit of the solver, one at a time, solves models with it, and writes what changed as a table.

  try_limits.py FOLDER FILE...   builds libsnapthrough with limits that can be set when it starts, in FOLDER (kept: a second run
                                 only solves), solves the requests and sweeps of the FILEs (JSON, or JSON lines with "request")
  --only PATTERN   tries limits whose name matches the regular expression
  --jobs N         processes at the same time (2)
  --points N       points of each sweep (8)
  --out FILE       file of the table (Markdown) instead of standard output
  --self-test      checks the comparison and the copy

The table has a row for each limit: the change of all factorisations in percent, the number of documents whose answers differ
(another status, end, list of critical points or shape of the table, or a number of these that differs by more than 0.2 %), and
the number of documents that differ in any bit of the result. "no effect" has none of these. "ended" means that solving crashed
or took ten times as long.
"""
import argparse
import concurrent.futures
import ctypes
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.tried_limits import copy_with_tried_limits, tried  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
SAME = 2e-3
LONGER = 10.0
# what differs from run to run, or counts work
OWN = ("diagnostics", "program", "discretization")


class Document(ctypes.Structure):
    _fields_ = [("text", ctypes.POINTER(ctypes.c_char)), ("length", ctypes.c_size_t), ("status", ctypes.c_int)]


def library(path):
    loaded = ctypes.CDLL(str(path))
    for name, arguments in (("solve", [ctypes.c_void_p] * 3),
                            ("sweep", [ctypes.c_uint64, ctypes.c_uint64] + [ctypes.c_void_p] * 3)):
        function = getattr(loaded, "snapthrough_" + name)
        function.restype = ctypes.POINTER(Document)
        function.argtypes = [ctypes.c_char_p, ctypes.c_size_t] + arguments
    return loaded


def answer(pointer):
    document = pointer.contents
    return document.status, json.loads(ctypes.string_at(document.text, document.length))


def solved(loaded, document, points):
    """(status, result) of a request, or of the first points of a sweep."""
    text = json.dumps(document).encode()
    if "parameters" not in document:
        return answer(loaded.snapthrough_solve(text, len(text), None, None, None))
    _, table = answer(loaded.snapthrough_sweep(text, len(text), 0, 0, None, None, None))
    count = -(-points // table["unit"]) * table["unit"]
    return answer(loaded.snapthrough_sweep(text, len(text), 0, count, None, None, None))


def numbers(value):
    """A value of a result with its numbers in a list of their own."""
    out = []

    def shape(part):
        if isinstance(part, dict):
            return {key: shape(inner) for key, inner in sorted(part.items())}
        if isinstance(part, list):
            return [shape(inner) for inner in part]
        if isinstance(part, float):
            out.append(part)
            return 0.0
        return part

    return shape(value), out


def told(status, result):
    """What a user reads first: status, end, critical loads, frequencies, rows of a table."""
    points = [{key: point.get(key) for key in ("type", "load_factor", "multiplicity")}
              for point in result.get("critical_points", [])]
    rows = [[float(cell) if isinstance(cell, (int, float)) else str(cell)[:40] for cell in row] for row in result.get("rows", [])]
    ends = [branch.get("termination") for branch in result.get("branches", [])]
    shape, values = numbers({"status": status, "ends": ends, "points": points, "rows": rows,
                             "code": (result.get("failure") or {}).get("code")})
    bits = json.dumps({key: value for key, value in result.items() if key not in OWN}, sort_keys=True)
    return {"shape": json.dumps(shape, sort_keys=True), "values": values, "bits": hashlib.sha256(bits.encode()).hexdigest(),
            "work": result.get("diagnostics", {}).get("factorizations", 0)}


def differs(one, other):
    if one["shape"] != other["shape"] or len(one["values"]) != len(other["values"]):
        return True
    size = max((abs(value) for value in one["values"]), default=0.0)
    return any(abs(a - b) > SAME * max(abs(a), 1e-6 * size) for a, b in zip(one["values"], other["values"]))


def documents(files):
    for name in files:
        text = pathlib.Path(name).read_text()
        if name.endswith(".jsonl"):
            yield from (json.loads(line)["request"] for line in text.splitlines() if line.strip())
        else:
            yield json.loads(text)


def trial(folder, limit, factor, longest):
    """Answers of a process with one limit multiplied; None when it crashed or took too long."""
    environment = {**os.environ, "TRIED_LIMIT": limit, "TRIED_FACTOR": str(factor)}
    command = [sys.executable, __file__, "--solve", str(folder)]
    try:
        done = subprocess.run(command, env=environment, capture_output=True, timeout=longest, check=False)
    except subprocess.TimeoutExpired:
        return None
    return json.loads(done.stdout) if done.returncode == 0 else None


def effect(before, after):
    """(change of factorisations in percent, answers that differ, documents with other bits), or None."""
    if after is None:
        return None
    work = [sum(told["work"] for told in answers) for answers in (before, after)]
    return (100.0 * (work[1] / max(work[0], 1) - 1.0), sum(map(differs, before, after)),
            sum(a["bits"] != b["bits"] for a, b in zip(before, after)))


def cell(found):
    if found is None:
        return "ended"
    work, answers, bits = found
    if not bits and not answers and work == 0.0:
        return "no effect"
    return f"{work:+.1f} %, {answers} answers, {bits} bits"


def build(folder):
    source = folder / "source"
    if not (folder / "limits.json").exists():
        source.mkdir(parents=True)
        limits = copy_with_tried_limits(ROOT, source)
        (folder / "limits.json").write_text(json.dumps(limits))
    subprocess.run(["cmake", "-S", source, "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DSNAPTHROUGH_PARTS=library", "-DSNAPTHROUGH_WERROR=OFF",
                    f"-DCMAKE_CXX_FLAGS=-include {source / 'tried_limit.h'}"], check=True, stdout=sys.stderr)
    subprocess.run(["ninja", "-C", folder / "build", "snapthrough_shared"], check=True, stdout=sys.stderr)
    return json.loads((folder / "limits.json").read_text())


def main(choices):
    folder = pathlib.Path(choices.folder).resolve()
    limits = [limit for limit in build(folder) if re.search(choices.only, limit[0])]
    (folder / "documents.json").write_text(json.dumps([choices.points, list(documents(choices.files))]))
    began = time.monotonic()
    before = trial(folder, "", 1.0, None)
    longest = LONGER * (time.monotonic() - began) + 10.0
    if before is None:
        return "the documents are not solved with the limits as they are"
    out = open(choices.out, "w", encoding="utf-8") if choices.out else sys.stdout
    with concurrent.futures.ThreadPoolExecutor(choices.jobs) as pool:
        tries = [(limit, [pool.submit(trial, folder, limit[0], factor, longest) for factor in (0.5, 2.0)]) for limit in limits]
        print(f"{len(limits)} limits, {len(before)} documents, {sum(told['work'] for told in before)} factorisations\n\n"
              "| limit | value | halved | doubled |\n| --- | --- | --- | --- |", file=out)
        for (name, value), futures in tries:
            cells = " | ".join(cell(effect(before, future.result())) for future in futures)
            print(f"| {name} | {value} | {cells} |", file=out, flush=True)
    return None


def self_test():
    text = "struct A {\n  static constexpr double x = 1.0;  ///< a\n  static constexpr int n = 2;\n};\nstd::array<int, n> a;\n"
    copied, limits = tried(text, "a.h", {"n"})
    assert limits == [("a.h A::x", "1.0")], limits
    assert 'const double x = tried_limit<double>("a.h A::x", 1.0);' in copied and "constexpr int n = 2" in copied
    point = {"branches": [{"termination": "limit"}], "critical_points": [{"type": "limit_point", "load_factor": 1.0}],
             "diagnostics": {"factorizations": 10}}
    moved = json.loads(json.dumps(point))
    moved["critical_points"][0]["load_factor"] = 1.001
    one, other = told(0, point), told(0, moved)
    assert effect([one], [one]) == (0.0, 0, 0) and effect([one], [other]) == (0.0, 0, 1)
    moved["critical_points"][0]["load_factor"] = 1.003
    assert effect([one], [told(0, moved)])[1] == 1 and effect([one], [told(3, point)])[1] == 1
    assert cell(None) == "ended" and cell((0.0, 0, 0)) == "no effect"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?")
    parser.add_argument("files", nargs="*")
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--points", type=int, default=8)
    parser.add_argument("--out")
    parser.add_argument("--solve", help=argparse.SUPPRESS)
    parser.add_argument("--self-test", action="store_true")
    given = parser.parse_intermixed_args()
    if given.self_test:
        sys.exit(self_test())
    if given.solve:
        points, requests = json.loads(pathlib.Path(given.solve, "documents.json").read_text())
        loaded = library(pathlib.Path(given.solve, "build", "libsnapthrough.so"))
        print(json.dumps([told(*solved(loaded, request, points)) for request in requests]))
        sys.exit()
    if not given.files:
        parser.error("FOLDER and at least one FILE are required")
    sys.exit(main(given))
