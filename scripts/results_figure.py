#!/usr/bin/env python3
"""Draws docs/results.svg: a state of an example with axes, signs and reactions.

  python3 scripts/results_figure.py build/release/snapthrough [--check]

--check compares the drawing with the one that is there: exit status 1 when it differs."""
import json
import math
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.svg_figure import ROOT, Size, arrow, arrow_head, document, label, path, polygon, rectangle  # noqa: E402

SIZE = Size(860, 560)


def turn(at, radius, angles, words, colour="accent"):
    """An arrow on a circle from one angle to another (degrees, counter-clockwise as drawn), labelled at its start."""
    start, end = angles

    def on_circle(angle, distance=radius):
        return at[0] + distance * math.cos(math.radians(angle)), at[1] - distance * math.sin(math.radians(angle))

    sign = 1 if end > start else -1
    tip = math.radians(end + sign * 7)  # the head is a chord of the circle
    along = (-sign * math.sin(tip), -sign * math.cos(tip))
    steps = [on_circle(start + (end - start) * i / 24) for i in range(25)]
    x, y = on_circle(start, radius + 14)
    return [path(f"arrow {colour}", [steps]), arrow_head(colour, on_circle(end + sign * 14), along),
            label(f"{colour}-text", (x, y + 8), words, "middle")]


def state_of(executable):
    """The state at the last critical point of the example, and its result."""
    request = json.loads((ROOT / "examples" / "arch_no_base.json").read_text(encoding="utf-8"))
    request["analysis"]["output"] = {"states": "critical", "points_per_member": 81}
    done = subprocess.run([executable, "solve", "-"], input=json.dumps(request), capture_output=True, text=True, check=True)
    result = json.loads(done.stdout)
    return result["states"][result["critical_points"][-1]["state"]]


def member_shapes(state):
    """The shapes of the deformed member with its bending moments; its points in pixels; its name."""
    (name, member), = state["members"].items()
    xs, ys = member["x0"], member["y0"]
    scale = 620 / (max(xs) - min(xs))

    def place(x, y):
        return 120 + (x - min(xs)) * scale, 220 - (y - min(ys)) * scale

    deformed = [place(x, y) for x, y in zip(member["x"], member["y"])]
    largest = max(map(abs, member["bending_moment"]))
    angles = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in zip(deformed[:-1], deformed[1:])]
    angles.append(angles[-1])
    offset = [(p[0] + 60 * m / largest * math.sin(a), p[1] - 60 * m / largest * math.cos(a))
              for p, a, m in zip(deformed, angles, member["bending_moment"])]
    i = len(deformed) // 5
    (x, y), a = deformed[i], angles[i]
    shapes = [path("undeformed", [[place(x, y) for x, y in zip(xs, ys)]]),
              path("thin", list(zip(deformed, offset))[::2]), path("section-line moment", [offset]), path("member", [deformed]),
              arrow("ink", (x, y), (x + 60 * math.cos(a), y + 60 * math.sin(a))), label("", (x + 56, y - 10), "t"),
              arrow("ink", (x, y), (x + 60 * math.sin(a), y - 60 * math.cos(a))),
              label("", (x + 70 * math.sin(a) - 12, y - 66 * math.cos(a)), "n"),
              label("", (x + 6, y + 22), "s")]
    return shapes, deformed, name


def reaction_shapes(state, deformed):
    largest = max(math.hypot(r["fx"], r["fy"]) for r in state["supports"].values())
    ends = [deformed[0], deformed[-1]] if deformed[0][0] < deformed[-1][0] else [deformed[-1], deformed[0]]
    reactions = sorted(state["supports"].items(), key=lambda one: -one[1]["fx"])  # the left support pushes to the right
    for (node, r), (x, y), side in zip(reactions, ends, (-1, 1)):
        dx, dy = 70 * r["fx"] / largest, -70 * r["fy"] / largest
        yield polygon("support-body", [(x, y), (x - 9, y + 15), (x + 9, y + 15)])
        yield arrow("contact", (x - dx, y - dy), (x - 0.06 * dx, y - 0.06 * dy))
        yield label("contact-text", (x + 14 * side, y + 40), f'supports["{node}"]', "middle")
        yield label("contact-text", (x + 14 * side, y + 56), f'fx = {r["fx"]:.4g}, fy = {r["fy"]:.4g}'.replace("-", "−"), "middle")


def load_shapes(state, crown, name):
    x, y = crown
    words = f'load; loads.fy = {state["loads"]["fy"]:.4g}'.replace("-", "−")
    return [arrow("contact", (x, y - 92), (x, y - 6)), label("contact-text", (x + 10, y - 84), words),
            label("", (x, y + 26), f'members["{name}"]', "middle")]


def element_shapes():
    """A piece of a member between two sections, with what acts on its ends."""
    x0, x1, y = 470, 670, 445
    shapes = [rectangle("body", x0, y - 16, x1 - x0, 32), path("dimension", [[(x0, y), (x0 + 42, y)], [(x1 - 42, y), (x1, y)]])]
    for at, sign in ((x1, 1), (x0, -1)):
        shapes += [arrow("contact", (at + 6 * sign, y), (at + 66 * sign, y)), label("contact-text", (at + 77 * sign, y + 5), "N", "middle"),
                   arrow("contact", (at + 6 * sign, y), (at + 6 * sign, y - 52 * sign)),
                   label("contact-text", (at + 6 * sign, y - 62 * sign + 5), "Q", "middle")]
    shapes += turn((x1 + 2, y), 38, (-60, 45), "M") + turn((x0 - 2, y), 38, (240, 135), "M")
    middle = (x0 + x1) / 2
    shapes += [label("", (middle, y + 5), "positive N, Q, M", "middle"), label("", (x0, y + 84), "section at s", "middle"),
               label("", (x1, y + 84), "section beyond", "middle")]
    start = (middle - 35, y - 40)
    return shapes + [arrow("ink", start, (start[0] + 60, start[1])), label("", (start[0] + 70, start[1] + 5), "t", "middle"),
                     arrow("ink", start, (start[0], start[1] - 40)), label("", (start[0], start[1] - 46), "n", "middle")]


def axes_shapes():
    x, y = 120, 480
    return [arrow("ink", (x, y), (x + 70, y)), label("", (x + 82, y + 5), "x", "middle"), arrow("ink", (x, y), (x, y - 70)),
            label("", (x, y - 78), "y", "middle"), *turn((x, y), 34, (15, 70), "", "ink"), label("", (x + 40, y - 32), "rotation, moment")]


def figure(state):
    """The complete drawing."""
    title = f"State at load factor {state['load_factor']:.4g}"
    key = "dashed: undeformed (x0, y0); thick: deformed (x, y); blue: bending_moment, drawn along n where positive"
    members, deformed, name = member_shapes(state)
    shapes = [label("heading", (14, 25), title, size=13), label("muted", (14, 45), key), *members, *reaction_shapes(state, deformed),
              *load_shapes(state, deformed[len(deformed) // 2], name), *element_shapes(), *axes_shapes()]
    return document(title, f"{key}. Below: global axes, and the positive senses of N, Q and M on a piece of a member.", SIZE, shapes)


def main():
    executable, *options = sys.argv[1:]
    drawing = figure(state_of(str(pathlib.Path(executable).resolve())))
    target = ROOT / "docs" / "results.svg"
    if "--check" in options:
        sys.exit(0 if target.read_text(encoding="utf-8") == drawing else
                 "docs/results.svg is out of date: scripts/results_figure.py draws it anew")
    target.write_text(drawing, encoding="utf-8")


if __name__ == "__main__":
    main()
