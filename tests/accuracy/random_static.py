#!/usr/bin/env python3
"""Compares the states of static analyses and of paths with those on a much finer mesh.

  random_static.py BINARY [--count 100] [--seed 1] [--accuracy 1e-2 1e-3 1e-6] [--jobs 2] [--path]

Draws straight members with a tension up to sqrt(T / EI) L = 1e5, beds of any stiffness, laws that bend at 1e-5 to 1e-2 of the
span, tapers, point loads, contact on one side, and a second member at an angle. The reference is the same program on a given mesh
of 512 equal elements of order 6 a member: it shows what a mesh leaves, and no error of the equations. Compared are the largest
displacement, N, Q and M of each member at 2001 places, over the largest of the kind in the structure.

Counts errors beyond the accuracy and beyond the estimate, and prints the median of estimate / error. A seed whose reference on
half as many elements differs by more than a tenth of the accuracy is not counted; what it differs by is allowed beside an
estimate, and 1e-8: that is what rounding leaves on hundreds of elements. Ends with status 1 where an error of an answer exceeds the accuracy.
"""
import collections
import os
import pathlib
import random
import statistics
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]
import command_line  # noqa: E402

KINDS = {"displacement": ("u", "v"), "N": ("axial_force",), "Q": ("shear_force",), "M": ("bending_moment",)}


#: what rounding leaves in the reference
ROUNDING = 1e-8


def law_of(rng, stiffness, span):
    """A bed's law that bends at 1e-5 to 1e-2 of the span."""
    w = span * 10 ** rng.uniform(-5, -2)
    kind = rng.choice(("linear", "linear", "table", "tanh"))
    if kind == "linear":
        return {"stiffness": stiffness}
    if kind == "tanh":
        return {"law": {"type": "tanh", "stiffness": stiffness, "capacity": 3 * stiffness * w}}
    return {"law": {"type": "table", "points": [[w, stiffness * w], [2 * w, 1.2 * stiffness * w], [1e3 * w, 100 * stiffness * w]]}}


def draw(rng):
    length, stiff = 10 ** rng.uniform(-0.5, 1.5), 10 ** rng.uniform(2, 5)
    q = stiff / length ** 3 * 10 ** rng.uniform(-4, -1)
    section = {"id": "s", "EA": stiff / length ** 2 * 10 ** rng.uniform(3, 7), "EI": stiff}
    if rng.random() < 0.3:
        section["EI"] = {"along": [[0, stiff], [1, stiff * rng.uniform(0.2, 3)]]}
    model = {"nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": length, "y": 0}], "sections": [section],
             "members": [{"id": "m", "start": "a", "end": "b", "section": "s"}],
             "supports": [{"node": "a", "fixed": rng.choice((["x", "y"], ["x", "y", "rotation"]))},
                          {"node": "b", "fixed": rng.choice((["y"], ["y", "rotation"]))}],
             "loads": [{"type": "distributed", "member": "m", "force": [0, -q]}], "foundations": []}
    if rng.random() < 0.5:
        tension = stiff / length ** 2 * 10 ** rng.uniform(0, 10)
        section["EA"] = max(section["EA"], 1e4 * tension)
        model["loads"].append({"type": "point", "at": {"node": "b"}, "force": [tension, 0], "pattern": "constant"})
        model["loads"][0]["force"][1] -= 1e-4 * tension / length
    if rng.random() < 0.4:
        model["loads"].append({"type": "point", "at": {"member": "m", "fraction": rng.uniform(0.2, 0.8)}, "force": [0, -q * length]})
    if rng.random() < 0.6:
        bed = {"id": "f", "member": "m", "side": "right", **law_of(rng, stiff / length ** 4 * 10 ** rng.uniform(0, 9), length)}
        if rng.random() < 0.5:
            bed["reaction"] = "compression_only"
        if rng.random() < 0.3:
            bed["range"] = [rng.uniform(0, 0.4), rng.uniform(0.6, 1)]
        model["foundations"].append(bed)
    if rng.random() < 0.3:
        model["nodes"].append({"id": "c", "x": length + length * rng.uniform(0.2, 0.6), "y": length * rng.uniform(0.2, 0.6)})
        model["members"].append({"id": "n", "start": "b", "end": "c", "section": "s"})
    return model


def numbers(state):
    """Largest magnitude of each kind in each member."""
    return {kind: {name: max(abs(v) for key in keys for v in member[key]) for name, member in state["members"].items()}
            for kind, keys in KINDS.items()}


def difference(one, other):
    worst = 0.0
    for kind in KINDS:
        size = max(other[kind].values())
        for name in other[kind]:
            if size > 0:
                worst = max(worst, abs(one[kind][name] - other[kind][name]) / size)
    return worst


def reference(options, model, analysis, elements):
    given = {**analysis, "discretization": {"elements": elements, "order": 6}}
    answer = command_line.solve(options.binary, {"model": model, "analysis": given}, options.seconds)
    return numbers(answer.document["states"][-1]) if answer.document and answer.document["states"] else None


def check(options, seed):
    model = draw(random.Random(seed))
    output = {"points_per_member": 2001}
    analysis = {"type": "static", "load_factors": [1], "output": {"states": "all", **output}}
    if options.path:
        analysis = {"type": "path", "stop": {"load_factor": [-0.1, 1.05]}, "output": {"states": {"at_load_factors": [1]}, **output}}
    right, half = (reference(options, model, analysis, n) for n in (512, 256))
    found = []
    uncertain = difference(half, right) if half and right else None
    for accuracy in options.accuracy:
        given = {**analysis, "discretization": {"accuracy": accuracy}}
        answer = command_line.solve(options.binary, {"model": model, "analysis": given}, options.seconds)
        if uncertain is None or uncertain > 0.1 * accuracy:
            found.append((accuracy, "no reference", None, None, uncertain))
        elif answer.document is None or not answer.document["states"]:
            found.append((accuracy, answer.failure() or "no state", None, None, uncertain))
        else:
            state = answer.document["states"][-1]
            estimate = state.get("error_estimate") if options.path else answer.document["summary"]["error_estimate"]
            found.append((accuracy, answer.failure() or "answered", difference(numbers(state), right), estimate, uncertain))
    return found


def main():
    parser = command_line.seeded_parser(__doc__, count=100, seconds=60.0)
    parser.add_argument("--accuracy", type=float, nargs="+", default=[1e-2, 1e-3, 1e-6])
    parser.add_argument("--path", action="store_true")
    options = parser.parse_args()
    counts, ratios, beyond = collections.Counter(), collections.defaultdict(list), 0
    for seed, found in command_line.for_each(range(options.seed, options.seed + options.count), lambda n: check(options, n), options.jobs):
        for accuracy, code, error, estimate, uncertain in found:
            outcome = code
            if error is not None:
                outcome += " within" if error <= accuracy else " BEYOND THE ACCURACY"
                if estimate is None:
                    outcome += ", no estimate"
                elif error > estimate + uncertain + ROUNDING:
                    outcome += ", beyond the estimate"
                    print(f"seed {seed} at {accuracy:g}: error {error:.3g}, estimate {estimate:.3g}, reference {uncertain:.2g}", flush=True)
                elif error > ROUNDING:
                    ratios[accuracy].append(estimate / error)
                if error > accuracy and code == "answered":
                    beyond += 1
                    print(f"seed {seed} at {accuracy:g}: error {error:.3g}, estimate {estimate}", flush=True)
            counts[accuracy, outcome] += 1
    for key in sorted(counts):
        print(f"  {key[0]:<8g} {key[1]:45} {counts[key]}")
    for accuracy, values in sorted(ratios.items()):
        print(f"  {accuracy:<8g} median of estimate / error {statistics.median(values):.3g} of {len(values)}")
    return 1 if beyond else 0


if __name__ == "__main__":
    sys.exit(main())
