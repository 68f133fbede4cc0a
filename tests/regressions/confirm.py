#!/usr/bin/env python3
"""Confirms what the regressions expect, by runs that the tests do not make.

  confirm.py BINARY [TEXT...]     models of regressions.jsonl whose name contains a TEXT; all without one

A request that asks for an accuracy is solved at a tenth of it. One with a mesh of its own is drawn mirrored, from the other end
and in another order, and its loads are compared with those without that mesh at an accuracy of 1e-4. Prints a line a
model, and ends with status 1 when one of these runs does not confirm what is expected, but those that the model names in
`not_by`.
"""
import copy
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "variations"))
import program  # noqa: E402
import variations  # noqa: E402

CONVERGED = 1e-4
STEPS = 200
SECONDS = 600.0
DRAWINGS = ("mirror", "reverse", "reverse lists")


def with_states(request):
    """All states, as the tests ask for them: then all points of a path are corrected to rounding."""
    out = copy.deepcopy(request)
    out["analysis"]["output"] = {"states": "all", "points_per_member": 2}
    return out


def at_accuracy(request, accuracy):
    out = copy.deepcopy(request)
    out["analysis"]["discretization"] = {"accuracy": accuracy}
    if "steps" in out["analysis"].get("stop", {}) and "accuracy" not in request["analysis"]["discretization"]:
        out["analysis"]["stop"]["steps"] = STEPS
    return out


def drawings(request):
    for name in DRAWINGS:
        try:
            drawn = variations.edited(request, name)
        except ValueError:  # a load per projected length is not mirrored
            drawn = None
        if drawn is not None:
            yield name, drawn


def ends_alike(answer, expected):
    ends = expected["termination"]
    found = answer.document["summary"]["termination"] if answer.document else answer.failure
    return found in (ends if isinstance(ends, list) else [ends])


def same_points(answer, expected):
    points = expected.get("critical_points")
    if points is None:
        return True
    found = [(p["type"], p["load_factor"]) for p in answer.document["critical_points"]]
    if len(found) < len(points) or (len(found) > len(points) and not expected.get("more")):
        return False
    return all(kind == point["type"] and ("load_factor" not in point or abs(load / point["load_factor"] - 1) <= expected["relative_tolerance"])
               for (kind, load), point in zip(found, points))


def checks(binary, document):
    """(what, whether it confirms) of each other run."""
    request, expected = with_states(document["request"]), document["expected"]
    asked = request["analysis"]["discretization"].get("accuracy")
    if asked:
        answer = binary.solve(at_accuracy(request, asked / 10))
        yield f"accuracy {asked / 10:g}", ends_alike(answer, expected) and same_points(answer, expected)
        return
    for name, drawn in drawings(request):
        answer = binary.solve(drawn)
        yield name, ends_alike(answer, expected) and same_points(answer, expected)
    if expected.get("critical_points"):
        yield "without its mesh", same_points(binary.solve(at_accuracy(request, CONVERGED)), expected)


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    binary = program.Program(sys.argv[1], SECONDS)
    wrong = 0
    for document in map(json.loads, (HERE / "regressions.jsonl").read_text(encoding="utf-8").splitlines()):
        if len(sys.argv) > 2 and not any(text in document["name"] for text in sys.argv[2:]):
            continue
        done = list(checks(binary, document))
        excused = document["expected"].get("not_by", [])
        missed = [what for what, confirmed in done if not confirmed and what not in excused]
        wrong += 1 if missed or not any(confirmed for _, confirmed in done) else 0
        print(f"{document['name']}: {', '.join(what for what, ok in done if ok) or 'nothing'} confirm"
              + (f"; WRONG: {', '.join(missed)}" if missed else ""), flush=True)
    raise SystemExit(1 if wrong else 0)


if __name__ == "__main__":
    main()
