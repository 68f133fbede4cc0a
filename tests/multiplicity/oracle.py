"""Buckling loads and squared frequencies of one straight member, in closed form (Timoshenko and Gere, Theory of elastic stability, 2.1;
Blevins, Formulas for natural frequency and mode shape, table 8-1). The axis keeps its length, and rotary inertia is zero."""
import math

# Each pair (f, c) is a characteristic function, divided by its growing exponentials, and the start of its root intervals: the n-th
# root x of f, the wave number of mode n times the member length, is the only one from (c + n - 1) pi to (c + n) pi.
PROPPED = (lambda x: math.sin(x) - x * math.cos(x), 1.0)  # tan x = x
VIBRATION = {"clamped": (lambda x: math.cos(x) - 1 / math.cosh(x), 1.0), "cantilever": (lambda x: math.cos(x) + 1 / math.cosh(x), 0.0),
             "propped": (lambda x: math.sin(x) - math.cos(x) * math.tanh(x), 0.5)}


def root(f, low, high):
    """Bisection of an interval at whose ends f has opposite signs."""
    sign = f(low) > 0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if (f(middle) > 0) == sign else (low, middle)
    return (low + high) / 2


def roots(equation, count):
    f, first = equation
    return [root(f, (first + n) * math.pi, (first + n + 1) * math.pi) for n in range(count)]


def buckling_roots(ends, count):
    if ends == "pinned":
        return [n * math.pi for n in range(1, count + 1)]
    if ends == "cantilever":
        return [(n - 0.5) * math.pi for n in range(1, count + 1)]
    if ends == "propped":
        return roots(PROPPED, count)
    whole_waves = [2 * n * math.pi for n in range(1, count + 1)]
    return sorted(whole_waves + [2 * x for x in roots(PROPPED, count)])[:count]


def bending_roots(ends, count):
    return [n * math.pi for n in range(1, count + 1)] if ends == "pinned" else roots(VIBRATION[ends], count)


def buckling_loads(ends, EI, length, count):
    return [EI * (x / length) ** 2 for x in buckling_roots(ends, count)]


def squared_frequencies(ends, section, length, count, axially_fixed):
    """Bending and axial vibrations without load, by size."""
    EI, EA, mass = section["EI"], section["EA"], section["mass"]
    bending = [EI / mass * (x / length) ** 4 for x in bending_roots(ends, count)]
    shift = 0.0 if axially_fixed else 0.5
    axial = [EA / mass * ((n - shift) * math.pi / length) ** 2 for n in range(1, count + 1)]
    return sorted(bending + axial)[:count]
