#!/usr/bin/env python3
"""Draws the figures of docs/theory.md as docs/theory_*.svg. Needs python3-numpy; the curves are computed here."""
import pathlib

import numpy as np

from shallow_arch import REFERENCE, Arch, limit_load

DOCS = pathlib.Path(__file__).resolve().parent.parent
INK, BLUE, ORANGE, GREY = "#1c2733", "#1f5fa8", "#d97706", "#9aa5b1"


class Figure:
    """An SVG with a plot's coordinates: x and y ranges map to the frame."""

    def __init__(self, x, y, width=640, height=300, left=60, bottom=40):
        self.x, self.y, self.width, self.height, self.left, self.bottom = x, y, width, height, left, bottom
        self.parts = []

    def at(self, x, y):
        across = self.left + (x - self.x[0]) / (self.x[1] - self.x[0]) * (self.width - self.left - 16)
        up = (y - self.y[0]) / (self.y[1] - self.y[0]) * (self.height - self.bottom - 14)
        return across, self.height - self.bottom - up

    def line(self, points, colour=INK, dash="", stroke=1.8):
        data = " ".join(f"{a:.1f},{b:.1f}" for a, b in (self.at(*point) for point in points))
        self.parts.append(f'<polyline points="{data}" fill="none" stroke="{colour}" stroke-width="{stroke}" stroke-dasharray="{dash}"/>')

    def arrow(self, start, end, colour=INK, stroke=1.8):
        (a, b), (c, d) = self.at(*start), self.at(*end)
        along = np.array([c - a, d - b]) / np.hypot(c - a, d - b)
        across = np.array([-along[1], along[0]])
        head = [np.array([c, d]), np.array([c, d]) - 9 * along + 4 * across, np.array([c, d]) - 9 * along - 4 * across]
        self.line([start, end], colour, stroke=stroke)
        self.parts.append(f'<polygon points="{" ".join(f"{p[0]:.1f},{p[1]:.1f}" for p in head)}" fill="{colour}"/>')

    def dot(self, x, y, colour=INK, radius=4):
        a, b = self.at(x, y)
        self.parts.append(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="{radius}" fill="{colour}"/>')

    def text(self, x, y, words, colour=INK, anchor="start", shift=(0, 0)):
        a, b = self.at(x, y)
        self.parts.append(f'<text x="{a + shift[0]:.1f}" y="{b + shift[1]:.1f}" fill="{colour}" text-anchor="{anchor}">{words}</text>')

    def frame(self, across, up):
        (x0, x1), (y0, y1) = self.x, self.y
        self.line([(x0, y1), (x0, y0), (x1, y0)], GREY, stroke=1)
        self.text(0.5 * (x0 + x1), y0, across, anchor="middle", shift=(0, 30))
        self.text(x0, y1, up, shift=(8, 12))

    def write(self, name, title):
        (DOCS / f"theory_{name}.svg").write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" width="{self.width}" '
            f'height="{self.height}" font-family="DejaVu Sans, sans-serif" font-size="13">\n<title>{title}</title>\n'
            f'<rect width="100%" height="100%" fill="#ffffff"/>\n' + "\n".join(self.parts) + "\n</svg>\n", encoding="utf-8")


def element():
    figure = Figure((-0.2, 4.4), (-0.35, 2.0), height=330, left=10, bottom=10)
    t = np.linspace(0.0, 1.0, 60)
    axis = np.column_stack([0.2 + 3.6 * t, 0.1 + 0.3 * np.sin(np.pi * t)])
    bent = np.column_stack([0.3 + 3.5 * t, 0.55 + 1.15 * np.sin(1.9 * t) - 0.35 * t])
    figure.line(axis, GREY, "6 4")
    figure.line(bent, INK, stroke=2.6)
    for end in (0, -1):
        figure.dot(*bent[end])
        figure.dot(*axis[end], GREY)
    for gauss in (0.1127, 0.5, 0.8873):
        i = int(round(gauss * 59))
        figure.dot(*bent[i], ORANGE)
    i = 30
    figure.arrow(axis[i], bent[i], BLUE)
    figure.text(*(0.5 * (axis[i] + bent[i])), "(u, v)", BLUE, shift=(6, 4))
    i = int(round(0.1127 * 59))
    angle = 0.75
    figure.arrow(bent[i], bent[i] + 0.6 * np.array([np.cos(angle), 0.9 * np.sin(angle)]), ORANGE)
    figure.arrow(bent[i], bent[i] + 0.6 * np.array([-0.75 * np.sin(angle), np.cos(angle)]), ORANGE)
    figure.text(*(bent[i] + [0.46, 0.42]), "d1", ORANGE, shift=(10, 4))
    figure.text(*(bent[i] + [-0.36, 0.46]), "d2", ORANGE, shift=(-22, 4))
    figure.text(3.3, 0.15, "stress-free axis X(s)", GREY, anchor="end", shift=(60, 26))
    figure.text(2.9, 1.75, "deformed axis x = X + u; N, Q, M at Gauss points (orange)", INK, anchor="end", shift=(150, -14))
    figure.write("element", "An element before and after deformation with the frame of a section")


def law():
    figure = Figure((-0.25, 1.6), (0.0, 1.25))
    figure.frame("place s along an element", "reaction p(w(s))")
    s = np.linspace(-0.25, 1.6, 400)
    w = 1.2 * np.sin(1.9 * s + 0.1)
    p = np.clip(w, 0.0, 0.8)
    figure.line(np.column_stack([s, w.clip(0.0)]), GREY, "5 4")
    figure.line(np.column_stack([s, p]), BLUE, stroke=2.6)
    roots = [-0.1 / 1.9, (np.arcsin(0.8 / 1.2) - 0.1) / 1.9, (np.pi - np.arcsin(0.8 / 1.2) - 0.1) / 1.9, (np.pi - 0.1) / 1.9]
    for root in roots:
        figure.line([(root, 0.0), (root, 1.1)], ORANGE, "2 3", 1.2)
    edges = [max(roots[0], -0.25), *roots[1:3], min(roots[3], 1.6)]
    points, _ = np.polynomial.legendre.leggauss(3)
    for low, high in zip(edges[:-1], edges[1:]):
        for place in 0.5 * (low + high) + 0.5 * (high - low) * points:
            figure.dot(place, 0.0, ORANGE, 4)
    figure.text(roots[1], 1.1, "cut where p or p' jumps; Gauss points in each part", ORANGE, shift=(-40, -4))
    figure.text(0.62, 0.8, "plateau", BLUE, shift=(30, -8))
    figure.text(1.45, 0.24, "contact ends", anchor="end", shift=(-30, 0))
    figure.write("law", "A law with a plateau on an element, cut where it is not smooth")


def kink():
    figure = Figure((0.0, 2.0), (0.0, 1.6))
    figure.frame("displacement", "load factor")
    figure.line([(0, 0), (0.8, 1.2)], INK, stroke=2.6)
    figure.line([(0.8, 1.2), (1.9, 1.42)], INK, stroke=2.6)
    figure.arrow((0.8, 1.2), (1.05, 1.575), GREY)
    figure.text(0.62, 1.52, "tangent before", GREY, anchor="end", shift=(60, 0))
    figure.arrow((0.8, 1.2), (1.3, 1.3), BLUE, 2.4)
    figure.text(1.15, 1.18, "direction beyond, with the new contact", BLUE, shift=(-40, 22))
    figure.dot(0.8, 1.2, ORANGE, 5)
    figure.text(0.8, 1.2, "a support begins to act", ORANGE, anchor="end", shift=(-10, 4))
    figure.write("kink", "A kink of the path where a support begins to act")


def pair():
    figure = Figure((0.0, 1.0), (-0.25, 0.8))
    figure.frame("length along one step", "stiffness of a motion")
    s = np.linspace(0.0, 1.0, 200)
    k = 0.62 - 2.9 * s * (1 - s) * (1.0 + 0.15 * s)
    figure.line(np.column_stack([s, k]), INK, stroke=2.4)
    figure.line([(0, 0), (1, 0)], GREY, stroke=1)
    slopes = np.gradient(k, s)
    meet = (k[-1] - slopes[-1] - k[0]) / (slopes[0] - slopes[-1])
    floor = -0.22
    figure.line([(0, k[0]), ((floor - k[0]) / slopes[0], floor)], BLUE, "6 4")
    figure.line([(1, k[-1]), (1 + (floor - k[-1]) / slopes[-1], floor)], BLUE, "6 4")
    for i in np.flatnonzero(np.diff(np.sign(k))):
        figure.dot(s[i], 0.0, ORANGE, 5)
    figure.dot(0, k[0])
    figure.dot(1, k[-1])
    figure.text(meet, 0.45, "both ends are stable, with the same inertia;", anchor="middle", shift=(0, -30))
    figure.text(meet, 0.45, "their tangents (dashed) meet beyond zero, so the step is searched", BLUE, anchor="middle", shift=(0, -10))
    figure.text(meet, 0.06, "two critical points", ORANGE, anchor="middle")
    figure.write("pair", "Two critical points inside one step that the inertia of its ends does not show")


def estimate():
    elements = (2, 4, 8, 16)
    loads = [limit_load(Arch(n, 2)) for n in elements]
    figure = Figure((0.8, 3.4), (-4.5, 0.0))
    figure.frame("elements of order 2", "relative error, powers of ten")
    errors = [(np.log2(n), np.log10(abs(load / REFERENCE - 1))) for n, load in zip(elements, loads)]
    estimates = [(np.log2(n), np.log10(2 * abs(a / b - 1))) for n, a, b in zip(elements, loads, loads[1:])]
    for points, colour, name in ((errors[:3], INK, "error"), (estimates, BLUE, "estimate")):
        figure.line(points, colour)
        for point in points:
            figure.dot(*point, colour)
        figure.text(*points[1], name, colour, shift=(-12, 22) if colour == INK else (12, -12), anchor="end" if colour == INK else "start")
    for n in elements[:3]:
        figure.text(np.log2(n), -4.5, str(n), anchor="middle", shift=(0, 15))
    for power in (-1, -2, -3, -4):
        figure.text(0.8, power, str(power), anchor="end", shift=(-6, 4))
    figure.write("estimate", "Error and estimate of a shallow arch's limit load")


if __name__ == "__main__":
    for draw in (element, law, kink, pair, estimate):
        draw()
