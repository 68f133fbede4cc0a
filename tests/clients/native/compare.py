#!/usr/bin/env python3
"""Compares documents that another build of the library made with those of the executable.

  compare.py EXECUTABLE FOLDER < what solve.py printed

FOLDER has their documents of tests/clients/requests and of sweep_500.json. Asked: the same outcomes, the same words of failures
and warnings, loads within 1e-10; exit status 1 names what differs. The last line has the ratio of the times of the sweep.
"""
import json
import os
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
REQUESTS = HERE.parent / "requests"
SHARE = 1e-10  # of loads: compilers and mathematical libraries differ in last digits
NUMBER = re.compile(r"-?\d+\.\d+(?:e[-+]?\d+)?")
STATUS = {"done": 0, "wrong": 2, "failed": 3, "cancelled": 4}  # of the C interface


def run(*command):
    """(exit status, document or {}, errors, processor time in s) of a command."""
    begin = os.times().children_user
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    document = json.loads(done.stdout) if done.stdout.startswith("{") else {}
    return done.returncode, document, done.stderr, os.times().children_user - begin


def loads(value, place=""):
    """(place, load factor) of all of a result but for its paths, which may have a row more."""
    if isinstance(value, (dict, list)):
        inner = value.items() if isinstance(value, dict) else enumerate(value)
        return [one for key, part in inner if key not in ("branches", "extremes") for one in loads(part, f"{place}/{key}")]
    return [(place, value)] if re.search(r"load_factors?(/\d+)?$", place) else []


def is_near(found, wanted):
    return found == wanted or None not in (found, wanted) and abs(found - wanted) <= SHARE * abs(wanted)


def same_words(found, wanted):
    """Whether two texts differ in the last digits of their numbers alone."""
    numbers = zip(NUMBER.findall(found), NUMBER.findall(wanted))
    return NUMBER.sub("#", found) == NUMBER.sub("#", wanted) and all(is_near(float(a), float(b)) for a, b in numbers)


def differences(found, wanted):
    """What differs between two results, and the largest relative difference of loads."""
    ours, theirs = loads(found), loads(wanted)
    if [place for place, _ in ours] != [place for place, _ in theirs]:
        return ["places of loads"], 0.0
    wrong = [f"{place}: {a}, not {b}" for (place, a), (_, b) in zip(ours, theirs) if not is_near(a, b)]
    largest = max([abs(a - b) / abs(b) for (_, a), (_, b) in zip(ours, theirs) if a is not None and b], default=0.0)
    words = [json.dumps([result.get(key) for key in ("failure", "warnings")] + [result["summary"]["message"]]) for result in (found, wanted)]
    return wrong + ([] if same_words(*words) else [f"words: {words}"]), largest


def different_rows(rows, wanted):
    """What differs between the rows of two tables of a sweep; no rows are wrong, too."""
    wrong = [f"row {i}: {a}, not {b}" for i, (a, b) in enumerate(zip(rows, wanted)) if not same_words(json.dumps(a), json.dumps(b))]
    return wrong if rows and len(rows) == len(wanted) else [*wrong, f"{len(rows)} rows, not {len(wanted)}"]


def main():
    executable, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    told = {name: (int(status), float(seconds)) for name, status, seconds in map(str.split, sys.stdin.read().splitlines())}
    expected = json.loads((HERE.parent / "expected.json").read_text(encoding="utf-8"))
    wrong, largest = [], 0.0
    for name, wanted in expected.items():
        status = told.get(f"{name}.json", (None, 0.0))[0]
        if status != STATUS[wanted["outcome"]]:
            wrong.append(f"{name}: status {status}, expected {wanted['outcome']}")
            continue
        found = json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))
        if wanted["outcome"] == "wrong":
            text = "".join(f"{one['pointer']}: {one['detail']} [{one['code']}]\n" for one in found["errors"])
            if text != run(executable, "check", REQUESTS / f"{name}.json")[2]:
                wrong.append(f"{name}: {text}")
        elif wanted["outcome"] != "cancelled":
            differing, difference = differences(found, run(executable, "solve", REQUESTS / f"{name}.json")[1])
            wrong += [f"{name}: {one}" for one in differing]
            largest = max(largest, difference)
    _, table, _, seconds = run(executable, "sweep", "--threads", "1", HERE.parent / "sweep_500.json")
    rows = json.loads((folder / "sweep_500.json").read_text(encoding="utf-8"))["rows"]
    wrong += different_rows(rows, table["rows"])
    print("\n".join(wrong) or f"{len(expected)} requests and {len(rows)} rows: as those of {executable}; largest difference of a load {largest:.1e}")
    print(f"sweep: {told['sweep_500.json'][1]:.2f} s, the executable {seconds:.2f} s, ratio {told['sweep_500.json'][1] / seconds:.2f}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
