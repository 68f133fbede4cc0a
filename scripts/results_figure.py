#!/usr/bin/env python3
"""Draws docs/results.svg: a state of an example with axes, signs and reactions.

  python3 scripts/results_figure.py build/release/snapthrough [--check]

--check compares the drawing with the one that is there: exit status 1 when it differs."""
import json
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WIDTH, HEIGHT = 860, 560
INK, PALE, FORCE, MOMENT = "#222", "#999", "#b22", "#258"


class Drawing:
    """Lines of an SVG file; y points down."""

    def __init__(self):
        self.lines = []

    def add(self, text):
        self.lines.append("  " + text)

    def path(self, points, stroke=INK, width=1.5, extra=""):
        d = "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.add(f'<path d="{d}" fill="none" stroke="{stroke}" stroke-width="{width}" {extra}/>')

    def text(self, x, y, words, fill=INK, anchor="start", size=14):
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" fill="{fill}" text-anchor="{anchor}" font-size="{size}">{words}</text>')

    def arrow(self, x, y, dx, dy, label, stroke=FORCE, at=1.18):
        length = math.hypot(dx, dy)
        tx, ty = dx / length, dy / length
        self.path([(x, y), (x + dx - 6 * tx, y + dy - 6 * ty)], stroke, 2)
        corners = [(x + dx, y + dy)] + [(x + dx - 9 * tx + s * 4 * ty, y + dy - 9 * ty - s * 4 * tx) for s in (1, -1)]
        self.add('<polygon points="' + " ".join(f"{a:.1f},{b:.1f}" for a, b in corners) + f'" fill="{stroke}"/>')
        if label:
            self.text(x + at * dx, y + at * dy + 5, label, stroke, "middle")

    def turn(self, x, y, radius, angles, label, stroke=MOMENT):
        """An arrow on a circle from one angle to another (degrees, counter-clockwise as drawn), labelled at its start."""
        start, end = angles
        at = lambda a, r=radius: (x + r * math.cos(math.radians(a)), y - r * math.sin(math.radians(a)))
        steps = [start + (end - start) * i / 24 for i in range(25)]
        self.path([at(a) for a in steps], stroke, 2)
        sign = 1 if end > start else -1
        (tipx, tipy) = at(end + sign * 14)
        corners = [(tipx, tipy), at(end, radius + 5), at(end, radius - 5)]
        self.add('<polygon points="' + " ".join(f"{a:.1f},{b:.1f}" for a, b in corners) + f'" fill="{stroke}"/>')
        self.text(at(start, radius + 14)[0], at(start, radius + 14)[1] + 8, label, stroke, "middle")

    def svg(self):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="DejaVu Sans, Arial, sans-serif">\n'
                f'  <rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>\n')
        return head + "\n".join(self.lines) + "\n</svg>\n"


def state_of(executable):
    """The state at the last critical point of the example, and its result."""
    request = json.loads((ROOT / "examples" / "arch_no_base.json").read_text())
    request["analysis"]["output"] = {"states": "critical", "points_per_member": 81}
    done = subprocess.run([executable, "solve", "-"], input=json.dumps(request), capture_output=True, text=True, check=True)
    result = json.loads(done.stdout)
    return result["states"][result["critical_points"][-1]["state"]]


def draw_state(drawing, state):
    (name, member), = state["members"].items()
    xs, ys = member["x0"], member["y0"]
    scale = 620 / (max(xs) - min(xs))
    place = lambda x, y: (120 + (x - min(xs)) * scale, 230 - (y - min(ys)) * scale)
    deformed = [place(x, y) for x, y in zip(member["x"], member["y"])]
    drawing.path([place(x, y) for x, y in zip(xs, ys)], PALE, 1.5, 'stroke-dasharray="6 5"')
    largest = max(map(abs, member["bending_moment"]))
    angle = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in zip(deformed[:-1], deformed[1:])]
    angle.append(angle[-1])
    offset = [(p[0] + 60 * m / largest * math.sin(a), p[1] - 60 * m / largest * math.cos(a))
              for p, a, m in zip(deformed, angle, member["bending_moment"])]
    for a, b in list(zip(deformed, offset))[::2]:
        drawing.path([a, b], "#9bc", 0.8)
    drawing.path(offset, MOMENT, 1.2)
    drawing.path(deformed, INK, 3)
    i = len(deformed) // 5
    (x, y), a = deformed[i], angle[i]
    drawing.arrow(x, y, 60 * math.cos(a), 60 * math.sin(a), "", INK)
    drawing.text(x + 56, y - 10, "t", INK)
    drawing.arrow(x, y, 60 * math.sin(a), -60 * math.cos(a), "n", INK)
    drawing.text(x + 6, y + 22, "s", INK)
    return place, deformed, name


def draw_reactions(drawing, state, deformed):
    largest = max(math.hypot(r["fx"], r["fy"]) for r in state["supports"].values())
    ends = [deformed[0], deformed[-1]] if deformed[0][0] < deformed[-1][0] else [deformed[-1], deformed[0]]
    reactions = sorted(state["supports"].items(), key=lambda one: -one[1]["fx"])  # the left support pushes to the right
    for (node, r), (x, y), side in zip(reactions, ends, (-1, 1)):
        dx, dy = 70 * r["fx"] / largest, -70 * r["fy"] / largest
        drawing.add(f'<polygon points="{x:.1f},{y:.1f} {x - 9:.1f},{y + 15:.1f} {x + 9:.1f},{y + 15:.1f}" fill="none" stroke="{INK}"/>')
        drawing.arrow(x - dx, y - dy, dx * 0.94, dy * 0.94, "")
        drawing.text(x + 14 * side, y + 40, f'supports["{node}"]', FORCE, "middle", 12)
        drawing.text(x + 14 * side, y + 56, f'fx = {r["fx"]:.4g}, fy = {r["fy"]:.4g}', FORCE, "middle", 12)


def draw_element(drawing):
    """A piece of a member between two sections, with what acts on its ends."""
    x0, x1, y = 470, 670, 455
    drawing.add(f'<rect x="{x0}" y="{y - 16}" width="{x1 - x0}" height="32" fill="#eee" stroke="{INK}"/>')
    drawing.path([(x0, y), (x1, y)], PALE, 1, 'stroke-dasharray="4 4"')
    drawing.arrow(x1 + 6, y, 60, 0, "N")
    drawing.arrow(x0 - 6, y, -60, 0, "N")
    drawing.arrow(x1 + 6, y, 0, -52, "Q")
    drawing.arrow(x0 - 6, y, 0, 52, "Q")
    drawing.turn(x1 + 2, y, 38, (-60, 45), "M")
    drawing.turn(x0 - 2, y, 38, (240, 135), "M")
    drawing.text((x0 + x1) / 2, y + 5, "positive N, Q, M", INK, "middle", 13)
    drawing.text(x0, y + 84, "section at s", INK, "middle", 12)
    drawing.text(x1, y + 84, "section beyond", INK, "middle", 12)
    drawing.arrow((x0 + x1) / 2 - 35, y - 40, 60, 0, "t", INK)
    drawing.arrow((x0 + x1) / 2 - 35, y - 40, 0, -40, "n", INK)


def draw_axes(drawing):
    x, y = 120, 490
    drawing.arrow(x, y, 70, 0, "x", INK)
    drawing.arrow(x, y, 0, -70, "y", INK)
    drawing.turn(x, y, 34, (15, 70), "", INK)
    drawing.text(x + 36, y - 32, "rotation, moment", INK, "start", 12)


def main():
    executable, *options = sys.argv[1:]
    state = state_of(str(pathlib.Path(executable).resolve()))
    drawing = Drawing()
    load = state["load_factor"]
    drawing.text(30, 30, f"State at load factor {load:.4g}: dashed undeformed (x0, y0), thick deformed (x, y); "
                         "bending_moment drawn along n where positive", INK, "start", 13)
    _, deformed, name = draw_state(drawing, state)
    draw_reactions(drawing, state, deformed)
    x, y = deformed[len(deformed) // 2]
    drawing.arrow(x, y - 92, 0, 86, "", FORCE)
    drawing.text(x + 10, y - 84, f'load; loads.fy = {state["loads"]["fy"]:.4g}', FORCE, "start", 12)
    drawing.text(x, y + 26, f'members["{name}"]', INK, "middle", 12)
    draw_element(drawing)
    draw_axes(drawing)
    path = ROOT / "docs" / "results.svg"
    if "--check" in options:
        sys.exit(0 if path.read_text() == drawing.svg() else "docs/results.svg is out of date: scripts/results_figure.py draws it anew")
    path.write_text(drawing.svg())


if __name__ == "__main__":
    main()
