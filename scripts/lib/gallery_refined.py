"""Straight lines of refined charts, compared with points that are solved on their own.

A refined chart is a sweep with `refine`: rows are added along its last parameter until straight lines between them are within a share
of the output. Places of a parameter with the spacing log are logarithms. Rows of different pieces are not joined.
"""
import bisect
import copy
import dataclasses
import itertools
import math
import random

SHARE = 0.01  # distance of a line from the answer that pages state, as a share of the answer
POINTS = 100  # random points of a chart
MOST_BETWEEN = 2  # of them that may lie between two pieces: jumps are enclosed to 1/4096 of the range
LEAST = 0.01  # values below this share of the largest one of their curve count as this share
SEED = 1


def place_of(document):
    """The function from a value of the last parameter to its place."""
    return math.log if document["parameters"][-1]["range"].get("spacing") == "log" else float


def random_points(document):
    """Values of all parameters at random points: as many on each curve, uniform over the places of the last parameter."""
    draw = random.Random(SEED)
    *others, last = document["parameters"]
    place = place_of(document)
    low, high = place(last["range"]["from"]), place(last["range"]["to"])
    curves = itertools.cycle(itertools.product(*(parameter["values"] for parameter in others)))
    for curve in itertools.islice(curves, POINTS):
        at = draw.uniform(low, high)
        yield [*curve, math.exp(at) if place is math.log else at]


def separate_points(document):
    """A sweep over random points of a refined chart, each of which is solved on its own."""
    sweep = copy.deepcopy(document)
    del sweep["refine"]
    sweep["design"] = "zip"
    for parameter, values in zip(sweep["parameters"], zip(*random_points(document))):
        parameter.pop("range", None)
        parameter["values"] = list(values)
    return sweep


class Table:
    """A drawn table as {curve: [(place, value, piece), ...]}; the curves differ in all columns before the value but the last parameter."""

    def __init__(self, table, document):
        place, last = place_of(document), len(document["parameters"]) - 1
        value = next(i for i, column in enumerate(table["columns"]) if column.startswith("/"))
        piece = table["columns"].index("piece") if "piece" in table["columns"] else None
        self.curves = {}
        for row in table["rows"]:
            key = tuple(row[:last] + row[last + 1:value])
            self.curves.setdefault(key, []).append((place(row[last]), row[value], None if piece is None else row[piece]))
        for rows in self.curves.values():
            rows.sort(key=lambda row: row[0])

    def largest(self, key):
        return max((abs(value) for _, value, _ in self.curves[key] if value is not None), default=0.0)

    def neighbours(self, key, place):
        """The rows before and after a place."""
        rows = self.curves[key]
        after = min(max(bisect.bisect_left(rows, place, key=lambda row: row[0]), 1), len(rows) - 1)
        return rows[after - 1], rows[after]


def are_joined(before, after):
    """Whether a line joins two rows: both of one piece, both with a value or both without one."""
    return before[2] == after[2] and (before[1] is None) == (after[1] is None)


def straight(before, after, place):
    """The value on the straight line between two rows; None where they have none."""
    if before[1] is None:
        return None
    return before[1] + (after[1] - before[1]) * (place - before[0]) / (after[0] - before[0])


def off_by(line, answer, largest):
    """Distance of a line from the answer as a share of the answer; 0 where neither has a value, infinite where one has none."""
    if line is None or answer is None:
        return 0.0 if line is answer else math.inf
    return abs(line - answer) / max(abs(answer), LEAST * largest)


@dataclasses.dataclass
class Comparison:
    """A chart's lines beside separate points: mistakes, how many were compared or lie between pieces, and the largest share."""

    wrong: list
    compared: int = 0
    between: int = 0
    worst: float = 0.0


def compared(name, document, lines, answers):
    """Comparison of a refined chart with separate points: two drawn tables with the same columns before `piece`."""
    found, is_log = Comparison([]), place_of(document) is math.log
    lines, answers = Table(lines, document), Table(answers, document)
    for key, rows in answers.curves.items():
        largest = lines.largest(key)
        for place, answer, _ in rows:
            before, after = lines.neighbours(key, place)
            if not are_joined(before, after):
                found.between += 1
                continue
            line = straight(before, after, place)
            off = off_by(line, answer, largest)
            found.compared += 1
            found.worst = max(found.worst, off)
            if not off <= SHARE:
                where = ", ".join(map(str, [*key, f"{math.exp(place) if is_log else place:.9g}"]))
                found.wrong.append(f"{name}, at {where}: {line} on the line, {answer} solved, {100 * off:.3g} % off")
    if found.between > MOST_BETWEEN:
        found.wrong.append(f"{name}: {found.between} of {POINTS} points lie between two pieces, {MOST_BETWEEN} may")
    return found


def made_up(rows):
    """A drawn table of two curves whose value is 2 at the ends, 4 in the middle, and jumps to 10 between 3 and 3.01."""
    return {"columns": ["wall", "x", "/y", "piece", "change", "error"], "rows": [[wall, *row, None, None] for wall in (1, 2) for row in rows]}


def refined_self_test():
    """Names of what is wrong with these functions; empty when all is well."""
    document = {"parameters": [{"name": "wall", "targets": [], "values": [1, 2]}, {"name": "x", "range": {"from": 1, "to": 4, "count": 3}}],
                "design": "grid", "refine": {"output": "/y"}}
    in_log = {"parameters": [{"name": "x", "range": {"from": 1, "to": 100, "count": 3, "spacing": "log"}}], "refine": {}}
    lines = made_up([[1, 2.0, 0], [2, 4.0, 0], [3, 2.0, 0], [3.01, 10.0, 1], [4, 10.0, 1]])

    def beside(*points):
        return compared("made up", document, lines, {"columns": ["wall", "x", "/y", "error"], "rows": [[2, *one, None] for one in points]})

    points = list(random_points(document))
    in_decades = [x < 10 for [x] in random_points(in_log)]
    decade = Table({"columns": ["x", "/y", "piece"], "rows": [[1, 0.0, 0], [100, 4.0, 0]]}, in_log)
    sweep = separate_points(document)
    fine = beside([1.5, 3.0], [2.25, 3.5], [3.5, 10.0], [1.5, 3.029], [3.005, 6.0])
    checks = {
        "lines that are near": (fine.wrong, fine.compared, fine.between) == ([], 4, 1) and 0.009 < fine.worst < 0.01,
        "a line that is off by more than a hundredth": beside([1.5, 3.04]).wrong == ["made up, at 2, 1.5: 3.0 on the line, 3.04 solved, 1.32 % off"],
        "an answer where the line has none, and the other way round": all(off_by(*one, 1.0) == math.inf for one in ((None, 1.0), (1.0, None))),
        "neither has a value": off_by(None, None, 1.0) == 0.0,
        "values near zero": abs(off_by(0.0, 1e-4, 1.0) - 0.01) < 1e-15,
        "too many points between pieces": len(beside([3.001, 3.0], [3.002, 3.0], [3.003, 3.0]).wrong) == 1,
        "a row without a value is not joined": not are_joined((0, 1.0, 0), (1, None, 0)),
        "straight over a logarithm": straight(*decade.neighbours((), math.log(10)), math.log(10)) == 2.0,
        "points on each curve, within the range": {wall for wall, _ in points} == {1, 2} and all(1 <= x <= 4 for _, x in points),
        "points in each decade": 30 < sum(in_decades) < 70,
        "a sweep of separate points": (len(sweep["parameters"][1]["values"]), sweep["design"], "refine" in sweep) == (POINTS, "zip", False),
    }
    return [name for name, right in checks.items() if not right]
