"""The tables of the errata page, and what is checked of them."""
import json
import math

from lib.thesis_data import EXAMPLES, digits, percent, references, run_program, run_sweep_at, value_of

MESHES = "errata_table_4_4_meshes"
IMPERFECTION = "errata_table_4_4_imperfection"
POLYGON = EXAMPLES / "paths" / "errata_table_4_4_polygon.json"
CONVERGED_4_4 = 75.7604348680  # collocation
BELOW = 1e-4  # that a mesh may be below it: the accuracy asked of converged values
# Two-node corotational elements with nodal springs, computed apart from this solver
COROTATIONAL = {10: 80.233599, 20: 76.854908, 40: 76.038223}
PRINTED_4_4 = {10: 61.15, 20: 72.47, 40: 76.24}
# Factors of the stiffness between which the one that gives a published load is looked for
FACTORS = (3, 3.5, 4, 4.5, 5, 5.5, 6, 6.5, 7, 8, 9, 10, 11, 12, 13)


def polygon(request, count):
    """The request's arch with another number of straight members: its corners on the arc of 20 degrees and R = 100."""
    changed = json.loads(json.dumps(request))
    model, radius, half = changed["model"], 100.0, math.radians(10)
    stiffness = 1e5 * 1.4 / radius**4 * radius * 2 * half / count
    turns = [-half + 2 * half * i / count for i in range(count + 1)]
    model["nodes"] = [{"id": f"n{i}", "x": radius * math.sin(t), "y": radius * math.cos(t)} for i, t in enumerate(turns)]
    model["members"] = [{"id": f"m{i}", "start": f"n{i}", "end": f"n{i + 1}", "section": "rib"} for i in range(count)]
    model["supports"] = [{"node": end, "fixed": ["x", "y"]} for end in ("n0", f"n{count}")]
    model["springs"] = [{"id": f"s{i}", "at": {"node": f"n{i}"}, "direction": [math.sin(t), math.cos(t)],
                         "stiffness": stiffness, "reaction": "compression_only"} for i, t in enumerate(turns[1:-1], 1)]
    model["loads"][0]["at"]["node"] = f"n{count // 2}"
    return changed


def polygon_limits(program):
    """{members: limit load} of the polygon with springs at its corners."""
    request = json.loads(POLYGON.read_text(encoding="utf-8"))
    limits = {}
    for count in PRINTED_4_4:
        result, _ = run_program([program, "solve", "-"], f"polygon of {count}", json.dumps(polygon(request, count)))
        limits[count] = next(p["load_factor"] for p in result["critical_points"] if p["type"] == "limit_max")
    return limits


def mesh_limits(results):
    """{order: {elements: limit load}} of the meshes of table 4.4."""
    limits = {}
    for row in results[MESHES]:
        found = value_of(row, "limit_max")
        limits.setdefault(row["mesh"]["order"], {})[row["mesh"]["elements"]] = found[0] if found else float("nan")
    return limits


class Table44:
    """Table 4.4 beside other meshes and beside an imperfect arch."""

    def __init__(self, program, results):
        self.rows = [("printed", PRINTED_4_4)]
        self.rows += [(f"order {order}, springs lumped at the elements' nodes", limits) for order, limits in mesh_limits(results).items()]
        self.rows += [("polygon of straight elements of order 3, springs at its corners", polygon_limits(program)),
                      ("corotational elements of two nodes, springs at the nodes, computed apart", COROTATIONAL)]
        self.imperfect = [(row["amplitude"], row["/critical_points/0/type"], row["/critical_points/0/load_factor"])
                          for row in results[IMPERFECTION]]

    def check(self):
        """(mistakes, numbers compared): no mesh errs downwards, which is what the erratum says."""
        ours = [(f"table 4.4, {name}, {n} elements", load) for name, limits in self.rows[1:-1] for n, load in limits.items()]
        wrong = [f"{name}: {load} is below {CONVERGED_4_4}" for name, load in ours if not load > CONVERGED_4_4 * (1 - BELOW)]
        loads = [load for _, _, load in self.imperfect]
        wrong += [] if loads == sorted(loads, reverse=True) else [f"table 4.4: imperfect arches {loads} do not fall with the amplitude"]
        return wrong, len(ours)

    def meshes(self):
        yield from ("| limit load Λ | 10 elements | 20 | 40 |", "| --- | --- | --- | --- |")
        for name, limits in self.rows:
            yield f"| {name} | " + " | ".join(digits(limits[n], 2) for n in (10, 20, 40)) + " |"
        yield f"| converged | {CONVERGED_4_4:.2f} | | |"

    def amplitudes(self):
        yield from ("| amplitude a | a/R | first loss of stability | Λ |", "| --- | --- | --- | --- |")
        for amplitude, kind, load in self.imperfect:
            yield f"| {amplitude:g} | {amplitude / 100:.2e} | {kind} | {load:.2f} |"


def stiffer_springs(results, file, source):
    """Rows of the published loads beside those with springs as much stiffer as the published loads suggest."""
    yield from ("| k as printed | what | published | ours, stiffer springs | % | converged with k as printed |",
                "| --- | --- | --- | --- | --- | --- |")
    for row in results[file]:
        for r in references():
            if r["file"] == source and float(r["value"]) == row["k"] and r["published"]:
                numbers = range(1, 8) if r["what"] == "limit_min" else [1]  # springs that switch make several minima
                found = [value_of(row, f"{r['what']} {n}") for n in numbers]
                ours = min((value[0] for value in found if value), default=None)
                yield (f"| {r['value']} | {r['what']} | {r['published']} | {digits(ours, 3)} | {percent(ours, r['published'])} | "
                       f"{float(r['converged']):.3f} |")


def factor_giving(curve, load):
    """(factor, d ln load/d ln factor) at which a curve [(factor, load), ...] has a load, between its points straight in logarithms."""
    for (f1, load1), (f2, load2) in zip(curve, curve[1:]):
        if load1 <= load <= load2:
            slope = math.log(load2 / load1) / math.log(f2 / f1)
            return f1 * (load / load1) ** (1 / slope), slope
    raise SystemExit(f"errata: no factor of the stiffness gives the load {load}")


def spring_factors(program, name, mesh, published):
    """[(k, published load, factor of the springs that gives it, exponent)] on a mesh of examples/thesis/NAME.json."""
    found = []
    for k, load in published:
        rows = run_sweep_at(program, name, {"mesh": [mesh], "k": [k * factor for factor in FACTORS]})
        curve = [(row["k"] / k, value_of(row, "limit_max")[0]) for row in rows]
        found.append((k, load, *factor_giving(curve, load)))
    return found


def published_limits(file):
    return [(float(r["value"]), float(r["published"])) for r in references()
            if r["file"] == file and r["published"] and r["what"] == "limit_max"]


def deep_arch_factors(program):
    yield from ("| degrees | k as printed | published | factor that gives it | over L_elem | d ln Λ/d ln k there |",
                "| --- | --- | --- | --- | --- | --- |")
    published = published_limits("figure_4_31_deep_arch_235")
    for degrees in (235, 215):
        length = 100 * math.radians(degrees) / 40
        mesh = {"elements": 40, "order": 1, "foundation": "lumped"}
        for k, load, factor, slope in spring_factors(program, f"figure_4_31_deep_arch_{degrees}", mesh, published):
            yield f"| {degrees} | {k:g} | {load:g} | {factor:.2f} | {factor / length:.2f} | {slope:.2f} |"


def ring_factors(program):
    yield from ("| k as printed | published | factor that gives it | over 2 π | d ln Λ/d ln k there |", "| --- | --- | --- | --- | --- |")
    mesh = {"elements": 50, "order": 1, "foundation": "lumped"}
    for k, load, factor, slope in spring_factors(program, "figure_4_35_ring", mesh, published_limits("figure_4_35_ring")):
        yield f"| {k:g} | {load:g} | {factor:.2f} | {factor / (2 * math.pi):.2f} | {slope:.2f} |"


def errata_page(program, results, springs, table_4_4):
    """The handwritten errata, with tables where their names stand in braces."""
    text = (EXAMPLES / "errata.md").read_text(encoding="utf-8")
    tables = {"{springs}": springs, "{table_4_4}": table_4_4.meshes(), "{table_4_4_imperfect}": table_4_4.amplitudes(),
              "{deep_arch}": stiffer_springs(results, "errata_deep_arch_springs", "figure_4_31_deep_arch_235"),
              "{deep_arch_factors}": deep_arch_factors(program),
              "{ring}": stiffer_springs(results, "errata_ring_springs", "figure_4_35_ring"),
              "{ring_factors}": ring_factors(program)}
    for name, table in tables.items():
        if text.count(name) != 1:
            raise SystemExit(f"errata.md: {name} must stand there once")
        text = text.replace(name, "\n".join(table))
    return text
