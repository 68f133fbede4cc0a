"""The figures of docs/thesis: load curves of the sweeps, equilibrium paths, deformed shapes, base reactions."""
import math

from lib.chart import Axes, Curve, chart, guide, line_of, marks
from lib.path_curves import COLOURS, equilibrium_paths
from lib.thesis_data import DOCS, ROOT, SPRINGS, on_thesis_mesh, read_csv, references, run_request, value_of

STIFFNESS = "/model/foundations/0/stiffness"
BEAM_SUPPORTS = (("sliding", ["y"], 1e9), ("fixed, EA = 10^4", ["x", "y"], 1e4), ("fixed, EA = 10^6", ["x", "y"], 1e6))
NONLINEAR_BEAM = ROOT / "tests/verification/data/beam_winkler_uniform_nonlinear_4_2.csv"
PICTURES = ("deep_arch", "sensitivity",
            *(f"figure_4_{name}" for name in ("2", "3", "3_resultant", "6", "7", "8", "9", "12", "14", "15", "17", "18", "23", "24", "25", "28",
                                              "29", "29_shape", "31", "32", "33", "35", "36", "36_reaction", "37")))


def plot(path, axes, curves):
    if path.stem not in PICTURES:  # scripts/figures.sh --list tells of pictures that are missing by this list
        raise ValueError(f"{path.name} is not among PICTURES")
    path.write_text(chart(axes, curves), encoding="utf-8")


def power(k):
    """A stiffness as a label: 10^{5}, 2.5·10^{4}, 1200."""
    if k < 2000:
        return f"{k:g}"
    digits, _, exponent = f"{k:e}".partition("e")
    factor = f"{float(digits):g}"
    return ("" if factor == "1" else factor + "·") + f"10^{{{int(exponent)}}}"


class Runs:
    """Results of path requests, each computed once, with the seconds they took."""

    def __init__(self, program):
        self.program, self.results, self.times = program, {}, []

    def __call__(self, name, *changes):
        changes = tuple((pointer, float(value) if isinstance(value, int) and pointer == STIFFNESS else value) for pointer, value in changes)
        key = (name, repr(changes))
        if key not in self.results:
            self.results[key], seconds = run_request(self.program, name, changes)
            shown = ", ".join(f"{pointer} {value:.6g}" if isinstance(value, float) else f"{pointer} {value}" for pointer, value in changes)
            self.times.append(f"{seconds:8.2f} s  paths/{name}.json {shown}".rstrip())
        return self.results[key]


def beam_runs(runs):
    """{(K, support): result} of the beam on soil."""
    return {(K, label): runs("beam_on_soil", (STIFFNESS, K), ("/model/supports/1/fixed", fixed), ("/model/sections/0/EA", EA))
            for K in (1, 9, 30, 50) for label, fixed, EA in BEAM_SUPPORTS}


def base_force(state):
    """Resultant of the base of a state: the sum of its reaction along the member (trapezoids between 201 points)."""
    soil = state["foundations"]["soil"]
    s, r = soil["s"], soil["reaction"]
    return sum((s[i + 1] - s[i]) * (r[i] + r[i + 1]) / 2 for i in range(len(s) - 1))


def beam_point(state):
    """(load, mid deflection / L, r L^3/EI of the base in the middle, R L^2/EI of its resultant); L = 10, EI = 100."""
    middle = state["foundations"]["soil"]["reaction"][100]
    return state["load_factor"], -state["members"]["beam"]["y"][100] / 10, 10 * middle, base_force(state)


def plot_beam(runs):
    looks = ("", "long", "short")
    for name, title, index, label in (("figure_4_2", "Beam on soil: load against mid deflection", 1, "mid deflection w/L"),
                                      ("figure_4_3", "Beam on soil: load against base reaction in the middle", 2, "R_B = r L^3/EI"),
                                      ("figure_4_3_resultant", "Beam on soil: load against resultant of the base", 3, "R L^2/EI")):
        curves = []
        for (K, support), result in beam_runs(runs).items():
            points = [(0, 0)] + [(beam_point(state)[index], state["load_factor"]) for state in result["states"]]
            number = [s for s, _, _ in BEAM_SUPPORTS].index(support)
            curves.append(line_of(f"K = {K}" if number == 0 else None, points, (1, 9, 30, 50).index(K), looks=looks[number]))
        curves += [Curve(support, None, 4, dashes) for (support, _, _), dashes in zip(BEAM_SUPPORTS, looks)]
        column = {1: "wmid_over_L", 2: "k_wmid"}.get(index)
        if column:
            known = [(float(row[column]), float(row["Lam"])) for row in read_csv(NONLINEAR_BEAM) if row["K"] in ("1", "9", "30", "50")]
            curves.append(marks("sliding, reference", known, "known"))
        plot(DOCS / f"{name}.svg", Axes(title, label, "Λ = q L^3/EI", (0, None), (0, 200)), curves)


def plot_columns(runs):
    length, crest = "/model/nodes/1/y", "/model/monitors/0/at/fraction"
    waves, slender = "/model/imperfections/0/half_waves", "/model/foundations/0/stiffness"
    crooked = [("n = 1", runs("column_bonded_base"))]
    plot(DOCS / "figure_4_12.svg", Axes("Imperfect column on a bonded base, L = 5, K = 10", "deflection at the crest w/L", "P", (0, 0.1), (0, 80)),
         equilibrium_paths(crooked, lambda m: abs(m["crest"]) / 5) + [guide("P_1 = 64.809", [(0, 64.808714), (0.1, 64.808714)])])
    for name, K, top in (("figure_4_14", 15.6, 250), ("figure_4_15", 47, 250)):
        paths = [(f"n = {n}", runs("column_bonded_base", (slender, K), (length, 10), (waves, n), (crest, 0.5 / n),
                                  ("/analysis/stop/load_factor", [-1, 260]))) for n in (1, 2, 3, 4)]
        plot(DOCS / f"{name}.svg", Axes(f"Imperfect columns on a bonded base, L = 10, K = {K}", "deflection at the first crest w/L", "P",
                                        (0, 0.1), (0, top)),
             equilibrium_paths(paths, lambda m: abs(m["crest"]) / 10))
    stiffnesses = (0, 10, 50, 75, 500, 1000)
    free = [(f"K = {K}", runs("column_one_sided_base", (STIFFNESS, K))) for K in stiffnesses]
    plot(DOCS / "figure_4_17.svg", Axes("Imperfect column on a compression-only base", "|mid deflection| w/L", "P", (0, 0.1), (0, 60)),
         equilibrium_paths(free, lambda m: abs(m["mid"]) / 5) + [guide("P(1 − P/EA) = P_e", [(0, 39.494012), (0.1, 39.494012)])])
    before = [(f"K = {K}", runs("column_one_sided_base", (STIFFNESS, K), ("/analysis/stop/load_factor", [-1, 39.4]), ("/analysis/step/max", 0.02)))
              for K in stiffnesses]
    plot(DOCS / "figure_4_18.svg", Axes("Imperfect column before it leaves a compression-only base: deflection at the lower quarter",
                                        "10^6 w/L", "P", (-8, 4), (0, 42)),
         equilibrium_paths(before, lambda m: 1e6 * m["quarter"] / 5))


def arch_runs(runs, name, scale, stiffnesses):
    return [(f"k = {power(k)}", runs(name, (STIFFNESS, k * scale))) for k in stiffnesses]


def state_at(result, kind):
    """The state of the first critical point of a kind; None where there is none."""
    for point in result["critical_points"]:
        if point["type"] == kind:
            return result["states"][point["state"]]
    return None


def stretch(s, x, y, ends):
    """The points of a line between two arc lengths."""
    return [(a, b) for t, a, b in zip(s, x, y) if ends[0] - 1e-9 <= t <= ends[1] + 1e-9]


def shape_curves(label, state, series, radius, mirrored=False):
    """Deformed axis, its contact regions drawn thick."""
    member = next(iter(state["members"].values()))
    x, y = ([value / radius for value in member[key]] for key in ("x", "y"))
    soil = state["foundations"]["soil"]
    touching = soil["contact"] if any(soil["reaction"]) else []  # a base of stiffness 0 is not there
    thick = [stretch(member["s"], x, y, ends) for ends in touching]
    pieces = [list(zip(x, y))]
    if mirrored:
        pieces += [[(-a, b) for a, b in piece] for piece in pieces]
        thick += [[(-a, b) for a, b in piece] for piece in thick]
    return [Curve(label, pieces, series), Curve(None, thick, series, "touching")]


def plot_shapes(path, axes, undeformed, states, radius, mirrored=False):
    curves = [Curve("undeformed", undeformed, None)]
    for series, (label, state) in zip(COLOURS, states):
        curves += shape_curves(label, state, series, radius, mirrored)
    curves.append(Curve("contact", None, 4, "touching"))
    plot(path, axes, curves)


def plot_reactions(path, title, states, group):
    """Base reaction over group = EI/R^3 along the member; the far side's positive where it pushes."""
    curves = [line_of(label, list(zip([s / state["foundations"]["soil"]["s"][-1] for s in state["foundations"]["soil"]["s"]],
                                      [r / group for r in state["foundations"]["soil"]["reaction"]])), series, dashed=True)
              for series, (label, state) in zip(COLOURS, states)]
    plot(path, Axes(title, "s/S from the start", "base reaction r R^3/EI", (0, 1)), curves)


def arc(half_angle, base=None):
    """Points of a circular axis of radius 1 about the vertical, its ends at height 0 (or as `base` says)."""
    height = math.cos(half_angle) if base is None else base
    return [(math.sin(half_angle * i / 100), math.cos(half_angle * i / 100) - height) for i in range(-100, 101)]


SHALLOW_SHAPE = {"x_range": (-0.19, 0.19), "y_range": (None, 0.017)}
ROUND = {"equal": True, "x_range": (-1.2, 1.2), "y_range": (-0.4, 1.6)}
RING = {"equal": True, "x_range": (-1.2, 1.2), "y_range": (-1.15, 1.15)}


def plot_shallow_arches(runs):
    def drop(monitors):
        return -monitors["crown"] / 100

    outside = arch_runs(runs, "arch_outside_base", 1.4e-8, (0, 1e5, 1e7, 1e9))
    inside = arch_runs(runs, "arch_inside_base", 1.4e-8, (0, 1e4, 2.5e4, 1e5))
    for name, side, paths in (("figure_4_23", "outside", outside), ("figure_4_28", "inside", inside)):
        plot(DOCS / f"{name}.svg", Axes(f"Shallow arch, base {side}", "crown displacement v/R", "Λ = P R^2/EI",
                                        (0, 0.04), (-250, 150)), equilibrium_paths(paths, drop))
    at_limit = [(label, state_at(result, "limit_max")) for label, result in outside[1:]]
    plot_shapes(DOCS / "figure_4_24.svg", Axes("Shallow arch, base outside, at the limit load", "x/R", "y/R (stretched)", **SHALLOW_SHAPE),
                [arc(math.radians(10))], at_limit, 100)
    plot_reactions(DOCS / "figure_4_25.svg", "Shallow arch, base outside, at the limit load", at_limit, 1.4e-6)
    pressed = [(f"{label}, {word}", state_at(result, kind)) for label, result in inside[1:]
               for kind, word in (("limit_max", "maximum"), ("limit_min", "minimum")) if state_at(result, kind)]
    pressed = [(label, state) for label, state in pressed if state["load_factor"] > 0]
    plot_shapes(DOCS / "figure_4_29_shape.svg", Axes("Shallow arch, base inside, at its limit points", "x/R", "y/R (stretched)", **SHALLOW_SHAPE),
                [arc(math.radians(10))], pressed, 100)
    plot_reactions(DOCS / "figure_4_29.svg", "Shallow arch, base inside, at its limit points", pressed, 1.4e-6)


def plot_deep_arch(runs):
    paths = [(f"k = {power(k)}", runs("deep_arch_235", (STIFFNESS, k * 1e-6), ("/analysis/step/max", 1 if k < 1e4 else 4)))
             for k in (0, 1e2, 1e3, 1e4, 1e5)]
    plot(DOCS / "figure_4_31.svg", Axes("Deep arch of 235 degrees, base outside", "crown displacement v/R", "Λ = P R^2/EI",
                                        (0, 2), (-2, 30)),
         equilibrium_paths(paths, lambda m: -m["crown"] / 100))
    states = [(label, state_at(result, "limit_max")) for label, result in paths]
    plot_shapes(DOCS / "figure_4_32.svg", Axes("Deep arch, at the first limit load", "x/R", "y/R", **ROUND),
                [arc(math.radians(117.5))], states, 100)
    plot_reactions(DOCS / "figure_4_33.svg", "Deep arch, at the first limit load", states[1:], 1e-4)


def plot_ring(runs, results):
    paths = arch_runs(runs, "ring", 3, (1200, 1e4, 5e4, 1.8e5))
    plot(DOCS / "figure_4_35.svg", Axes("Ring in an elastic medium", "displacement of the top v/R", "Λ = q R^3/EI",
                                        (0, 1.2), (0, 70)),
         equilibrium_paths(paths, lambda m: -m["top"] / 10))
    states = [(label, state_at(result, "limit_max")) for label, result in paths]
    plot_shapes(DOCS / "figure_4_36.svg", Axes("Ring, at the limit load", "x/R", "y/R", **RING), [arc(math.pi, 0)], states, 10, True)
    plot_reactions(DOCS / "figure_4_36_reaction.svg", "Ring, from the bottom to the top, at the limit load", states, 30)
    plot_limit_against_stiffness(results, "figure_4_35_ring", "figure_4_37.svg", "Ring in an elastic medium: limit load", "q R^3/EI")


def plot_limit_against_stiffness(results, file, name, title, group):
    curves = [Curve(label, [[(row["k"], value_of(row, "limit_max")[0]) for row in results[file]
                             if row["k"] > 0 and on_thesis_mesh(row) == coarse]], series, mark="dot", dashed=True)
              for series, label, coarse in ((1, "thesis mesh", True), (0, "converged", False))]
    published = [(float(r["value"]), float(r["published"])) for r in references()
                 if r["file"] == file and r["published"] and r["what"] == "limit_max"]
    plot(DOCS / name, Axes(title, "k = K R^4/EI", f"Λ = {group}", logarithmic="x"), curves + [marks("published", published, "known")])


def plot_sweeps(results):
    for number, file in enumerate(SPRINGS.values(), 6):
        stiffnesses = sorted({row["k_x"] for row in results[file]})
        curves = [Curve(f"k_x = {power(k)}", [[(1 - row["fraction"], row["/buckling/load_factors/0"])
                                               for row in results[file] if row["k_x"] == k]], series, mark="dot", dashed=True)
                  for series, k in enumerate(stiffnesses)]
        plot(DOCS / f"figure_4_{number}.svg", Axes("Column with one spring: " + file.split("spring_")[1].replace("_", "-"),
                                                  "c_b = c/L from the top", "Γ = P_{cr}/P_e", (0, 1)), curves)
    points = [(row["amplitude"], row["/summary/critical_load_factor"]) for row in results["imperfection_sensitivity_arch"]]
    plot(DOCS / "sensitivity.svg", Axes("Shallow arch, k = 0: antisymmetric imperfection", "amplitude / R, per cent",
                                        "Λ = P R^2/EI at the first loss of stability"),
         [Curve("imperfect: limit", [points], mark="dot")])
    plot_limit_against_stiffness(results, "figure_4_31_deep_arch_235", "deep_arch.svg", "Deep arch, 235 degrees: first limit load", "P R^2/EI")


def plot_all(runs, results):
    plot_sweeps(results)
    plot_beam(runs)
    plot_columns(runs)
    plot_shallow_arches(runs)
    plot_deep_arch(runs)
    plot_ring(runs, results)
