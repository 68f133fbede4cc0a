#!/usr/bin/env python3
"""Checks that critical points do not depend on how a structure is drawn, nor on what is written out.

  compare.py BINARY [--accuracy 1e-3 1e-6 1e-9] [--structures TEXT...] [--variations TEXT...] [--keep FOLDER]
  compare.py BINARY --sine     answers with sine offsets of 1e-15 to 1e-3 of the extent, without judgement
  compare.py BINARY --record   after a structure was added
  compare.py --list

TEXT chooses all whose name contains it. What is right stands in references.json: number, kinds and loads of the
critical points of the primary path. Loads must agree within the accuracy that was asked for. Prints each answer
that differs and a table of the variations, and ends with status 1 if an answer was wrong.

--record writes references.json anew: the answer that most drawings give, and at least a third, at the tightest
accuracy where steps a tenth as long, without any edit, find the same.

An offset e of the span moves the load of a bifurcation by up to 10 (12 e)^(2/3) of it (Koiter's two-thirds power;
12: the largest initial slope by offset that was seen). Where that is more than the accuracy, and e more than the
rounding 1e-15, the offset is a real imperfection: the path may end at limit points of its own, and a
`broken_bifurcation` may stand for the first bifurcation, but its load must be told. Such answers are marked
"real" where they differ from the reference, and are wrong only if they are silent about that bifurcation.
"""
import argparse
import collections
import copy
import json
import pathlib
import sys
import time

import pairs
import program
import structures
import variations

REFERENCES = pathlib.Path(__file__).resolve().parent / "references.json"
ROUNDING = 1e-15  # offset over span; coordinates of the span's size carry a tenth of it


class Run:
    """One drawing of a structure at one accuracy, and what it was answered."""

    def __init__(self, structure, variation, accuracy, request, answer):
        self.structure = structure
        self.variation = variation
        self.accuracy = accuracy
        self.request = request
        self.answer = answer

    def agrees(self, other):
        return program.same(self.answer, other.answer, self.accuracy, other.accuracy)

    def is_real_imperfection(self):
        return load_change(self.variation) > self.accuracy

    def tells_of(self, other):
        """Whether the first bifurcation of the other answer is told, unbroken or broken."""
        first = next((point for point in other.answer.points if point.kind == "bifurcation"), None)
        if first is None:
            return self.agrees(other)
        allowed = (load_change(self.variation) + self.accuracy + other.accuracy) * abs(first.load)
        return any(point.kind in ("bifurcation", "broken_bifurcation") and abs(point.load - first.load) <= allowed
                   for point in self.answer.points)

    def name(self):
        return f"{self.structure}_{self.variation}_{self.accuracy:g}"


def load_change(variation):
    """Relative change of a bifurcation's load that an offset above rounding can make."""
    share = variations.OFFSETS.get(variation, 0.0)
    return 10 * (12 * share) ** (2 / 3) if share > ROUNDING else 0.0


def runs_of(binary, structure, names, accuracies):
    runs = []
    for accuracy in accuracies:
        for name in names:
            request = variations.edited(structure.request(accuracy), name)
            if request is not None:
                runs.append(Run(structure.name, name, accuracy, request, binary.solve(request)))
    return runs


def most_agreed(runs, accuracy):
    """The run at this accuracy that agrees with most of all runs; None where that is less than a third."""
    candidates = [run for run in runs if run.accuracy == accuracy and not run.answer.failure]
    best = max(candidates, key=lambda run: sum(run.agrees(other) for other in runs), default=None)
    enough = best and 3 * sum(best.agrees(run) for run in runs) >= len(runs)
    return best if enough else None


def found_by_short_steps(binary, structure, run):
    request = structure.request(run.accuracy)
    request["analysis"]["stop"]["steps"] = 20000
    short = pairs.with_short_steps(binary, request, binary.solve(request).way())
    return program.same(binary.solve(short), run.answer, run.accuracy, run.accuracy)


def record(binary, structure, names, accuracies):
    """The reference of one structure as it is written; None where nothing is agreed upon."""
    runs = runs_of(binary, structure, names, accuracies)
    for accuracy in sorted(accuracies):
        best = most_agreed(runs, accuracy)
        if best and found_by_short_steps(binary, structure, best):
            return {"accuracy": accuracy, "points": [[point.kind, point.load] for point in best.answer.points]}
    return None


def record_all(binary, selected, names, accuracies):
    references = json.loads(REFERENCES.read_text(encoding="utf-8")) if REFERENCES.exists() else {}
    for structure in selected:
        found = record(binary, structure, names, accuracies)
        print(f"{structure.name}: {found or 'no agreement, not written'}", flush=True)
        if found:
            references[structure.name] = found
    REFERENCES.write_text(json.dumps(references, indent=1) + "\n", encoding="utf-8")


def reference_of(structure):
    """What is right, as a run."""
    known = json.loads(REFERENCES.read_text(encoding="utf-8"))[structure.name]
    points = [program.Point(kind, load, known["accuracy"]) for kind, load in known["points"]]
    return Run(structure.name, "reference", known["accuracy"], None, program.Answer("", points))


def compare(binary, structure, names, arguments, tally):
    start = time.monotonic()
    runs = runs_of(binary, structure, names, arguments.accuracy)
    chosen = reference_of(structure)
    other = [run for run in runs if not run.agrees(chosen)]
    wrong = [run for run in other if not (run.is_real_imperfection() and run.tells_of(chosen))]
    print(f"{structure.name}: {len(wrong)} of {len(runs)} wrong, {time.monotonic() - start:.1f} s; "
          f"reference: {chosen.answer}", flush=True)
    for run in other:
        note = "real " if run.is_real_imperfection() else ""
        print(f"  {run.variation:16} {run.accuracy:6g}  {note}{shortened(run.answer)}", flush=True)
    for run in wrong:
        program.keep(arguments.keep, run.name(), run.request)
        tally["wrong", run.accuracy] += 1
        tally["wrong at real offsets"] += run.is_real_imperfection()
    for run in runs:
        tally["code", run.answer.failure or "none"] += 1
        tally["runs of", run.variation] += 1
        tally["wrong with", run.variation] += run in wrong


def shortened(answer, length=200):
    text = str(answer)
    return text if len(text) <= length else f"{text[:length]} ... ({len(answer.points)} points)"


def tell_totals(tally, names):
    print("\nwrong answers by variation")
    for name in names:
        print(f"  {name:16} {tally['wrong with', name]:4d} of {tally['runs of', name]}")
    codes = ", ".join(f"{key[1]} {count}" for key, count in sorted(tally.items(), key=str) if key[0] == "code")
    by_accuracy = ", ".join(f"{count} at {key[1]:g}" for key, count in tally.items() if key[0] == "wrong")
    wrong = sum(tally["wrong with", name] for name in names)
    runs = sum(tally["runs of", name] for name in names)
    print(f"variations: {wrong} wrong answers in {runs} runs ({by_accuracy or 'none'}; "
          f"{tally['wrong at real offsets']} of them at real offsets); codes of failure: {codes}")
    return wrong == 0 and runs > 0


def with_sine(structure, accuracy, share):
    request = copy.deepcopy(structure.request(accuracy))
    member, half_waves = structure.sine
    request["model"]["imperfections"] = [{"type": "sine", "member": member, "half_waves": half_waves,
                                          "amplitude": share * variations.span(request["model"])}]
    return request


def tell_sines(binary, structure, accuracies):
    print(structure.name, flush=True)
    for accuracy in accuracies:
        print(f"  accuracy {accuracy:g}, as drawn: {binary.solve(structure.request(accuracy))}", flush=True)
        for exponent in range(-15, -2):
            answer = binary.solve(with_sine(structure, accuracy, 10.0**exponent))
            print(f"    1e{exponent:<4d} {answer}", flush=True)


def chosen_by(texts, names):
    return [name for name in names if not texts or any(text in name for text in texts)]


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?")
    parser.add_argument("--accuracy", type=float, nargs="+", default=[1e-3, 1e-6, 1e-9])
    parser.add_argument("--structures", nargs="+", metavar="TEXT")
    parser.add_argument("--variations", nargs="+", metavar="TEXT")
    parser.add_argument("--keep", metavar="FOLDER", help="where requests of differences are written")
    parser.add_argument("--seconds", type=float, default=3, help="processor time for one analysis")
    parser.add_argument("--sine", action="store_true")
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args()
    if not arguments.binary and not arguments.list:
        parser.error("BINARY is needed")
    return arguments


def main():
    arguments = read_arguments()
    found = {structure.name: structure for structure in structures.structures()}
    names = chosen_by(arguments.variations, variations.EDITS)
    selected = [found[name] for name in chosen_by(arguments.structures, found)]
    if arguments.list:
        print("\n".join([*found, "", *variations.EDITS]))
        return
    binary = program.Program(arguments.binary, arguments.seconds)
    if arguments.sine:
        for structure in selected:
            tell_sines(binary, structure, arguments.accuracy)
        return
    if arguments.record:
        same_places = [name for name in names if name not in variations.OFFSETS]
        record_all(binary, selected, same_places, arguments.accuracy)
        return
    tally = collections.Counter()
    for structure in selected:
        compare(binary, structure, names, arguments, tally)
    sys.exit(0 if tell_totals(tally, names) else 1)


if __name__ == "__main__":
    main()
