#!/usr/bin/env python3
"""Draws the figures of docs/theory.md as docs/theory_*.svg. Needs python3-numpy; the curves are computed here."""
import pathlib
import sys

import numpy as np

DOCS = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(DOCS.parent / "scripts"))
from lib.chart import Axes, Curve, chart  # noqa: E402
from lib.svg_figure import Size, arrow, circle, document, label, line, path  # noqa: E402

from shallow_arch import REFERENCE, Arch, limit_load  # noqa: E402

SIZE = Size(720, 340)


class Figure:
    """A drawing with a plot's coordinates: the ranges x and y map to the frame, which leaves `margins` (left, top, right, bottom)."""

    def __init__(self, title, x, y, margins=(56, 44, 24, 44)):
        self.title, self.x, self.y, self.margins = title, x, y, margins
        self.shapes = [label("heading", (14, 25), title, size=13)]

    def at(self, x, y):
        left, top, right, bottom = self.margins
        across = left + (x - self.x[0]) / (self.x[1] - self.x[0]) * (SIZE.width - left - right)
        return across, SIZE.height - bottom - (y - self.y[0]) / (self.y[1] - self.y[0]) * (SIZE.height - top - bottom)

    def line(self, points, classes):
        self.shapes.append(path(classes, [[self.at(*point) for point in points]]))

    def arrow(self, start, end, colour):
        self.shapes.append(arrow(colour, self.at(*start), self.at(*end)))

    def dot(self, x, y, colour, radius=4):
        self.shapes.append(circle(f"fill {colour}", self.at(x, y), radius))

    def text(self, x, y, words, classes="", anchor="start", shift=(0, 0)):
        a, b = self.at(x, y)
        self.shapes.append(label(classes, (a + shift[0], b + shift[1]), words, anchor))

    def frame(self, across, up):
        """Axes without numbers: what is drawn holds for any."""
        (x0, x1), (y0, y1) = self.x, self.y
        self.shapes += [line("axis", self.at(x0, y0), self.at(x1, y0)), line("axis", self.at(x0, y0), self.at(x0, y1))]
        self.text(0.5 * (x0 + x1), y0, across, "axis-label", "middle", (0, 28))
        left, middle = self.at(x0, 0.5 * (y0 + y1))
        self.shapes.append(label("axis-label", (left - 22, middle), up, "middle", upright=True))

    def write(self, name, description):
        (DOCS / f"theory_{name}.svg").write_text(document(self.title, description, SIZE, self.shapes), encoding="utf-8")


def element():
    figure = Figure("An element before and after deformation", (0, 4.2), (0.1, 2.0), margins=(20, 44, 20, 20))
    t = np.linspace(0.0, 1.0, 60)
    axis = np.column_stack([0.2 + 3.6 * t, 0.25 + 0.3 * np.sin(np.pi * t)])
    bent = np.column_stack([0.3 + 3.5 * t, 0.55 + 1.15 * np.sin(1.9 * t) - 0.35 * t])
    figure.line(axis, "axis-line")
    figure.line(bent, "deformed")
    for end in (0, -1):
        figure.dot(*bent[end], "ink")
        figure.dot(*axis[end], "muted")
    for gauss in (0.1127, 0.5, 0.8873):
        figure.dot(*bent[int(round(gauss * 59))], "contact")
    i = 30
    figure.arrow(axis[i], bent[i], "accent")
    figure.text(*(0.5 * (axis[i] + bent[i])), "(u, v)", "accent-text", shift=(8, 4))
    i = int(round(0.1127 * 59))
    dx, dy = np.subtract(figure.at(*bent[i + 1]), figure.at(*bent[i - 1]))
    angle = np.arctan2(-dy, dx) + 0.12  # the section is sheared by 0.12 rad
    x, y = figure.at(*bent[i])
    for name, turn in (("d_1", angle), ("d_2", angle + np.pi / 2)):
        along = np.array([np.cos(turn), -np.sin(turn)])
        figure.shapes.append(arrow("contact", (x, y), tuple((x, y) + 70 * along)))
        figure.shapes.append(label("contact-text", tuple((x, y) + 84 * along + [0, 4]), name, "middle"))
    figure.text(*axis[44], "stress-free axis X(s)", "muted", "middle", (0, 24))
    figure.text(*bent[44], "deformed axis x = X + u", "", "middle", (0, -14))
    figure.text(*bent[53], "N, Q, M at Gauss points", "contact-text", "end", (14, 26))
    figure.write("element", "The displacement (u, v) carries a point of the stress-free axis to the deformed axis. Vectors d_1 and "
                            "d_2 are the frame of a section. Section forces are computed at Gauss points.")


def law():
    figure = Figure("A law with a plateau on an element, cut where it is not smooth", (-0.25, 1.65), (0.0, 1.3))
    figure.frame("place s along an element", "reaction p(w(s))")
    s = np.linspace(-0.25, 1.65, 400)
    w = 1.2 * np.sin(1.9 * s + 0.1)
    figure.line(np.column_stack([s, w.clip(0.0)]), "axis-line")
    figure.line(np.column_stack([s, np.clip(w, 0.0, 0.8)]), "path")
    roots = [-0.1 / 1.9, (np.arcsin(0.8 / 1.2) - 0.1) / 1.9, (np.pi - np.arcsin(0.8 / 1.2) - 0.1) / 1.9, (np.pi - 0.1) / 1.9]
    for root in roots:
        figure.shapes.append(line("cut", figure.at(root, 0.0), figure.at(root, 1.22)))
    points, _ = np.polynomial.legendre.leggauss(3)
    for low, high in zip(roots[:-1], roots[1:]):
        for place in 0.5 * (low + high) + 0.5 * (high - low) * points:
            figure.dot(place, 0.0, "contact")
    figure.text(0.78, 0.0, "cut where p or p' jumps;", "contact-text", "middle", (0, -32))
    figure.text(0.78, 0.0, "Gauss points in each part", "contact-text", "middle", (0, -14))
    figure.text(0.78, 0.8, "plateau", "accent-text", "middle", (0, 18))
    figure.text(0.78, 1.2, "without the plateau", "muted", "middle", (0, 30))
    figure.text(roots[3], 0.9, "contact ends", "contact-text", "end", (-8, 0))
    figure.write("law", "The reaction along an element: it follows the displacement, stays at the plateau, and is zero where contact "
                        "has ended. Each smooth part has its own Gauss points.")


def kink():
    figure = Figure("A kink of the path where a support begins to act", (0.0, 2.0), (0.0, 1.7))
    figure.frame("displacement", "load factor")
    figure.line([(0, 0), (0.8, 1.2), (1.9, 1.42)], "deformed")
    figure.arrow((0.8, 1.2), (1.09, 1.635), "muted")
    figure.text(1.09, 1.635, "tangent before", "muted", shift=(10, 6))
    figure.arrow((0.8, 1.2), (1.3, 1.3), "accent")
    figure.text(1.05, 1.25, "direction beyond, with the new contact", "accent-text", shift=(0, 26))
    figure.dot(0.8, 1.2, "contact", 5)
    figure.text(0.8, 1.2, "a support begins to act", "contact-text", "end", (-12, 4))
    figure.write("kink", "The path goes straight up to the point where a support begins to act and is flatter beyond it.")


def pair():
    figure = Figure("Two critical points inside one step", (0.0, 1.0), (-0.25, 0.72))
    figure.frame("length along one step", "stiffness of a motion")
    s = np.linspace(0.0, 1.0, 200)
    k = 0.62 - 2.9 * s * (1 - s) * (1.0 + 0.15 * s)
    figure.line([(0, 0), (1, 0)], "axis")
    figure.text(0, 0, "0", "tick", "end", (-4, 4))
    figure.line(np.column_stack([s, k]), "deformed")
    slopes = np.gradient(k, s)
    floor = -0.22
    figure.line([(0, k[0]), ((floor - k[0]) / slopes[0], floor)], "tangent")
    figure.line([(1, k[-1]), (1 + (floor - k[-1]) / slopes[-1], floor)], "tangent")
    for i in np.flatnonzero(np.diff(np.sign(k))):
        figure.dot(s[i] - k[i] / slopes[i], 0.0, "contact", 5)
    figure.dot(0, k[0], "ink")
    figure.dot(1, k[-1], "ink")
    figure.text(0.5, 0.62, "both ends are stable, with the same inertia;", "", "middle")
    figure.text(0.5, 0.62, "their tangents (dashed) meet beyond zero, so the step is searched", "accent-text", "middle", (0, 20))
    figure.text(0.535, 0.03, "two critical points", "contact-text", "middle")
    figure.write("pair", "The stiffness of a motion is positive at both ends of a step and negative between. "
                         "The tangents at the ends meet below zero.")


def estimate():
    elements = (2, 4, 8, 16)
    loads = [limit_load(Arch(n, 2)) for n in elements]
    errors = [(n, abs(load / REFERENCE - 1)) for n, load in zip(elements, loads)]
    estimates = [(n, 2 * abs(a / b - 1)) for n, a, b in zip(elements, loads, loads[1:])]
    axes = Axes("Error and estimate of a shallow arch's limit load", "elements of order 2", "relative error", logarithmic="xy", x_ticks=elements[:3])
    curves = [Curve("estimate", [estimates], 0, mark="dot", dashed=True), Curve("error", [errors[:3]], 1, mark="dot", dashed=True)]
    (DOCS / "theory_estimate.svg").write_text(chart(axes, curves, Size(720, 380)), encoding="utf-8")


if __name__ == "__main__":
    for draw in (element, law, kink, pair, estimate):
        draw()
