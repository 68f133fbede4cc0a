#!/usr/bin/env python3
"""Checks that an answer does not depend on how a structure is drawn, over the whole vocabulary of requests.

  metamorphic.py BINARY [--count 100] [--seed 1] [--jobs 1] [--seconds 20] [--keep FOLDER] [--twins NAME...] [--per 3] [--without WORD...]
                        [--types TYPE...] [--known SEED...] [--verbose]
  metamorphic.py BINARY --show SEED [--twins NAME]     the request of a seed, or its twin; nothing is solved
  metamorphic.py BINARY --files REQUEST.json...        given requests instead of drawn ones

Draws random requests (vocabulary.py) and their twins (twins.py): in N and mm and in MN and km, turned by 37 degrees, mirrored, with
members drawn from their ends, cut in two, and with other ids and orders. Request n of a run has the seed `--seed` + n. `--per`: so many
twins, chosen by chance, of each request (default: all). Three classes of disagreement are counted apart:

  completes    one of the two fails and the other completes
  codes        both fail, with different codes
  differs      both complete, and a result differs by more than the sum of the estimated errors

Where a result has no estimate the accuracy that was asked for stands for it: relative to the largest value of its kind in the state.
On equal given meshes drawings differ by rounding; section forces there are found from one end of each element, so that they are not
compared where members are drawn backwards. States at a critical point are not compared: near a limit point a displacement has
the square root of the load's error. Ends with status 1 if something disagreed. Disagreements of `--known` seeds, which have a cause
that is known and not cured, are printed and do not count; such a seed that agrees is named.
"""
import argparse
import collections
import json
import os
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import command_line  # noqa: E402
import reading  # noqa: E402
import twins  # noqa: E402
import vocabulary  # noqa: E402

ROUNDING = 1e-6  # of values on equal meshes, relative to the largest of their kind: 1000 times the corrector's criterion (1e-9)
TINY = 1e-9      # largest value of a kind, relative to the structure's scale of it, below which the kind is rounding


def accuracy_of(request):
    return request["analysis"]["discretization"].get("accuracy")


def estimate(given, asked):
    """An estimated relative error, or what stands for it."""
    return given if given is not None else asked if asked else 0.0


def numbers_differ(name, one, other, allowed):
    if one is None or other is None:
        return "" if one is other else f"{name}: {one} and {other}"
    return "" if abs(one - other) <= allowed * max(abs(one), abs(other)) else f"{name}: {one:.9g} and {other:.9g}, allowed {allowed:.2g}"


def lists_differ(name, lists, allowed):
    """Two lists of numbers, entry by entry; `allowed` are relative differences."""
    if len(lists[0]) != len(lists[1]):
        return f"{name}: {lists[0]} and {lists[1]}"
    return next(filter(None, (numbers_differ(f"{name} {n + 1}", a, b, bound) for n, (a, b, bound) in enumerate(zip(*lists, allowed)))), "")


class Comparison:
    """Two completed answers to one request; `differences()` yields sentences."""

    def __init__(self, request, first, twin, second):
        self.request = request
        self.first = first.document
        self.twin = twin
        self.second = second.document
        self.asked = accuracy_of(request)

    def differences(self):
        for part in (self.critical, self.points, self.buckling, self.vibrations, self.tables, self.row_frequencies):
            difference = part()
            if difference:
                yield difference

    def allowed(self, *estimates):
        return sum(estimate(one, self.asked) for one in estimates) + ROUNDING

    def critical(self):
        one, other = self.first["summary"], self.second["summary"]
        if one["critical_type"] != other["critical_type"]:
            return f"critical: {one['critical_type']} {one['critical_load_factor']} and {other['critical_type']} {other['critical_load_factor']}"
        allowed = self.allowed(one["error_estimate"], other["error_estimate"])
        return numbers_differ("critical load factor", one["critical_load_factor"], other["critical_load_factor"], allowed)

    def points(self):
        """Critical points of the primary path and what ended it; two that are closer than the accuracy may be exchanged."""
        ends = [document["summary"]["termination"] for document in (self.first, self.second)]
        if ends[0] != ends[1]:
            return f"ended by {ends[0]} and {ends[1]}"
        found = [sorted(points_of(document), key=lambda point: point[:2]) for document in (self.first, self.second)]
        kinds = [[kind for kind, _, _ in points] for points in found]
        if kinds[0] != kinds[1]:
            return f"critical points {[p[:2] for p in found[0]]} and {[p[:2] for p in found[1]]}"
        allowed = [self.allowed(one[2], other[2]) for one, other in zip(*found)]
        return lists_differ("critical point", [[load for _, load, _ in points] for points in found], allowed)

    def buckling(self):
        if "buckling" not in self.first:
            return ""
        found = [document["buckling"] for document in (self.first, self.second)]
        allowed = [self.allowed(*pair) for pair in zip(*(one["error_estimates"] for one in found))]
        return lists_differ("buckling load", [one["load_factors"] for one in found], allowed)

    def vibrations(self):
        for one, other in zip(self.first.get("vibrations", []), self.second.get("vibrations", [])):
            squares = [row["frequencies"]["omega_squared"] for row in (one, other)]
            largest = max(map(abs, squares[0]), default=0.0)
            errors = [[None if e is None else e / max(abs(value), 1e-9 * largest) for e, value in zip(row["error_estimates"], values)]
                      for row, values in zip((one, other), squares)]
            allowed = [self.allowed(*pair) for pair in zip(*errors)]
            difference = lists_differ(f"omega squared at load factor {one['load_factor']:g}", squares, allowed)
            if difference:
                return difference
        return ""

    def row_frequencies(self):
        rows = [document.get("static", {}).get("frequencies", []) for document in (self.first, self.second)]
        for one, other in zip(*rows):
            if (one is None) != (other is None):
                return f"frequencies: {one} and {other}"
            if one:
                squares = [row["omega_squared"] for row in (one, other)]
                difference = lists_differ("row's omega squared", squares, [self.allowed(None, None)] * len(squares[0]))
                if difference:
                    return difference
        return ""

    def tables(self):
        base = twins.View(self.request["model"])
        rows = [reading.rows(view, self.request, document) for view, document in ((base, self.first), (self.twin.view, self.second))]
        if len(rows[0]) != len(rows[1]):
            return f"{len(rows[0])} and {len(rows[1])} rows and states"
        return next(filter(None, (self.row_differs(*pair) for pair in zip(*rows))), "")

    def row_differs(self, one, other):
        name, values = one
        largest = collections.defaultdict(float)
        for kind, value in [*values.values(), *other[1].values()]:
            largest[kind] = max(largest[kind], abs(value))
        allowed = self.allowed(*(self.state_error(document) for document in (self.first, self.second)))
        for key, (kind, value) in values.items():
            twin_value = other[1].get(key) if self.comparable(kind) else None
            if twin_value is not None and abs(value - twin_value[1]) > allowed * largest[kind] + self.rounding(kind):
                return f"{name}: {key} {value:.9g} and {twin_value[1]:.9g}, largest {largest[kind]:.4g}, allowed {allowed:.2g} of it"
        return ""

    def state_error(self, document):
        """Estimated error of the states; the estimate of other analyses is that of a load."""
        return document["summary"]["error_estimate"] if self.request["analysis"]["type"] == "static" else None

    def comparable(self, kind):
        return self.asked is not None or not self.twin.view.backwards or kind not in reading.SECTION_FORCES

    def rounding(self, kind):
        """Size of a kind below which a value is rounding."""
        nodes = self.request["model"]["nodes"]
        size = max(abs(node[axis]) for node in nodes for axis in "xy")
        force = max(EI_of(section) for section in self.request["model"]["sections"]) / size ** 2
        scales = {"displacement": size, "rotation": 1.0, "bending_moment": force * size}
        return TINY * scales.get(kind, force)


def points_of(document):
    """(kind, load factor, estimated error) of the critical points of branch 0, each as often as its multiplicity."""
    return [(point["type"], point["load_factor"], point["error_estimate"]) for point in document["critical_points"]
            if point["branch"] == 0 for _ in range(point["multiplicity"])]


def EI_of(section):
    value = section["EI"]
    return max(one for _, one in value["along"]) if isinstance(value, dict) else value


def compare(request, first, twin, second):
    """(class, sentence) of a disagreement; None where the twins agree."""
    codes = first.failure(), second.failure()
    if "timeout" in codes:
        return ("time", f"{codes[0] or 'completes'} and {codes[1] or 'completes'}") if codes[0] != codes[1] else None
    if bool(codes[0]) != bool(codes[1]):
        detail = first.detail() or second.detail()
        return "completes", f"{codes[0] or 'completes'} and {codes[1] or 'completes'}: {' '.join(detail.split())[:160]}"
    if codes[0] != codes[1]:
        return "codes", f"{codes[0]} and {codes[1]}"
    if codes[0]:
        return None
    found = "; ".join(Comparison(request, first, twin, second).differences())
    return ("differs", found) if found else None


def negative_mode(request):
    """The request with modes as imperfections of the other sign; None without such an imperfection."""
    imperfections = [{**item, "amplitude": -item["amplitude"]} if item["type"] == "mode" else item for item in request["model"]["imperfections"]]
    if imperfections == request["model"]["imperfections"]:
        return None
    return {**request, "model": {**request["model"], "imperfections": imperfections}}


def judged(binary, options, request, first, twin):
    """Compares a twin; a mode has no sign of its own, so that both signs of its imperfection are one request."""
    found = compare(request, first, twin, command_line.solve(binary, twin.request, options.seconds))
    other = negative_mode(twin.request)
    if found and other:
        found = compare(request, first, twin, command_line.solve(binary, other, options.seconds))
    return found


def drawn(seed, options):
    rng = random.Random(seed)
    while True:
        request, words = vocabulary.draw(rng, options.without)
        if not options.types or request["analysis"]["type"] in options.types:
            return request, words, rng


def chosen(options, rng):
    found = [name for name in twins.NAMES if not options.twins or name in options.twins]
    return rng.sample(found, options.per) if options.per and options.per < len(found) else found


def given(file):
    """A request as vocabulary.py writes it: with every list, and an accuracy or a mesh."""
    request = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))
    request["model"] = {**{key: [] for key in vocabulary.LISTS}, **request["model"]}
    request["analysis"].setdefault("discretization", {"accuracy": 1e-3})
    request["analysis"].setdefault("output", {})["points_per_member"] = reading.SAMPLES
    return request, set(), random.Random(1)


def check(binary, seed, options):
    """(code of the first, words, [(twin, class, sentence)]); `seed` is a number, or the name of a file"""
    request, words, rng = drawn(seed, options) if isinstance(seed, int) else given(seed)
    names = chosen(options, rng)
    first = command_line.solve(binary, request, options.seconds)
    if first.failure() == "document":
        return "document", words, [("drawn", "document", first.detail()[:300])]
    found = []
    for name in names:
        twin = twins.twin(request, name, random.Random(seed))
        disagreement = judged(binary, options, request, first, twin) if twin else None
        if disagreement:
            name_of = pathlib.Path(str(seed)).stem
            command_line.keep(options.keep, f"{name_of}_drawn", request)
            command_line.keep(options.keep, f"{name_of}_{name.replace(' ', '_')}", twin.request)
            found.append((name, *disagreement))
    return first.failure(), words, found


def report(results, options):
    """Prints disagreements and counts; the number of requests with one."""
    codes, classes, by_twin, by_word, wrong = (collections.Counter() for _ in range(5))
    for seed, (code, words, found) in results:
        codes[code or "completes"] += 1
        for name, kind, sentence in found:
            classes[kind] += 1
            by_twin[name] += 1
            print(f"{seed}, {name}: {kind}: {sentence}", flush=True)
        wrong.update({kind for _, kind, _ in found} if seed not in options.known else ())
        if seed in options.known and not found:
            print(f"{seed}, known, agrees now: take it off the list", flush=True)
        by_word.update(words if found else ())
        if options.verbose:
            print(f"seed {seed}: {code or 'completes'}; {', '.join(sorted(words))}", flush=True)
    total = sum(codes.values())
    requests = sum(wrong.values())
    for title, counts in (("answers", codes), ("disagreements", classes), ("twins that disagree", by_twin), ("words of such requests", by_word),
                          ("requests by class", wrong)):
        print(f"{title}: {', '.join(f'{key} {count}' for key, count in counts.most_common()) or 'none'}")
    print(f"{total} requests")
    return requests if total else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--keep")
    parser.add_argument("--twins", nargs="*", choices=twins.NAMES)
    parser.add_argument("--per", type=int)
    parser.add_argument("--types", nargs="*")
    parser.add_argument("--without", nargs="*", default=[], choices=vocabulary.WORDS)
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("--known", type=int, nargs="*", default=[])
    parser.add_argument("--show", type=int)
    parser.add_argument("--files", nargs="*")
    options = parser.parse_args()
    if options.show is not None:
        request = drawn(options.show, options)[0]
        if options.twins:
            request = twins.twin(request, options.twins[0], random.Random(options.show)).request
        print(json.dumps(request, indent=1))
        return 0
    seeds = options.files or range(options.seed, options.seed + options.count)
    return 1 if report(command_line.for_each(seeds, lambda seed: check(options.binary, seed, options), options.jobs), options) else 0


if __name__ == "__main__":
    sys.exit(main())
