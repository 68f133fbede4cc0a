"""Twenty perfect structures: each is symmetric or straight, and loses stability at bifurcations or limit points.

Several arches with inside bases are near values of k where two critical points meet. Lengths and EI are 1 unless
a line says otherwise, so load factors are P R^2/EI, P L^2/EI or p R^3/EI.
"""
import json
import math
import pathlib


class Structure:
    """A model, where its path stops, and a sine (member, half waves) that breaks its symmetry."""

    def __init__(self, name, model, stop, sine):
        self.name = name
        self.model = model
        self.stop = stop
        self.sine = sine

    def request(self, accuracy):
        return {"model": self.model,
                "analysis": {"type": "path", "discretization": {"accuracy": accuracy},
                             "stop": {"steps": 120, **self.stop}}}


def node(name, x, y):
    return {"id": name, "x": x, "y": y}


def member(name, start, end, sweep=0.0, section="s"):
    line = {"id": name, "start": start, "end": end, "section": section}
    return {**line, "curve": {"type": "arc", "sweep_degrees": sweep}} if sweep else line


def support(name, components="xy"):
    full = {"x": "x", "y": "y", "r": "rotation"}
    return {"node": name, "fixed": [full[letter] for letter in components]}


def section(axial, bending=1.0, name="s"):
    return {"id": name, "EA": axial, "EI": bending}


def base(on, stiffness, side, reaction="bilateral", gap=0.0):
    line = {"id": f"base {on} {side}", "member": on, "stiffness": stiffness, "side": side, "reaction": reaction}
    return {**line, "gap": gap} if gap else line


def down(at, force=1.0):
    return {"type": "point", "at": at, "force": [0, -force]}


def arch(half_angle, axial, ends="xy", k=0.0, side="right", reaction="bilateral"):
    """One arc of radius 1 with a force at its crown; the right side is the inside."""
    half_span = math.sin(math.radians(half_angle))
    model = {"nodes": [node("left", -half_span, 0), node("right", half_span, 0)], "sections": [section(axial)],
             "members": [member("arch", "left", "right", -2 * half_angle)],
             "supports": [support("left", ends), support("right", ends)],
             "loads": [down({"member": "arch", "fraction": 0.5})]}
    if k:
        model["foundations"] = [base("arch", k, side, reaction)]
    return model


def arch_of_two(half_angle, axial, ends="xy", k=0.0, side="right", reaction="bilateral"):
    """The same arch of two members that meet at the crown."""
    half_span, rise = math.sin(math.radians(half_angle)), 1 - math.cos(math.radians(half_angle))
    model = {"nodes": [node("left", -half_span, 0), node("crown", 0, rise), node("right", half_span, 0)],
             "sections": [section(axial)],
             "members": [member("first", "left", "crown", -half_angle),
                         member("second", "crown", "right", -half_angle)],
             "supports": [support("left", ends), support("right", ends)], "loads": [down({"node": "crown"})]}
    if k:
        model["foundations"] = [base(name, k, side, reaction) for name in ("first", "second")]
    return model


def toggle(rise, axial, ends="xyr", k=0.0, side="left", reaction="bilateral"):
    """Two straight members of span 2."""
    model = {"nodes": [node("left", -1, 0), node("apex", 0, rise), node("right", 1, 0)],
             "sections": [section(axial)],
             "members": [member("first", "left", "apex"), member("second", "apex", "right")],
             "supports": [support("left", ends), support("right", ends)], "loads": [down({"node": "apex"})]}
    if k:
        model["foundations"] = [base(name, k, side, reaction) for name in ("first", "second")]
    return model


def column(axial, k=0.0, foot="xy", head="x", bases=None):
    """An upright column of length 1 under a force at its head."""
    model = {"nodes": [node("foot", 0, 0), node("head", 0, 1)], "sections": [section(axial)],
             "members": [member("shaft", "foot", "head")],
             "supports": [support("foot", foot), support("head", head)], "loads": [down({"node": "head"})]}
    if k:
        model["foundations"] = [base("shaft", k, "left")]
    if bases:
        model["foundations"] = bases
    return model


def portal(ends, axial, beam=1.0, spread=False):
    """Columns of height 1 and a beam of span 1; forces at the corners, or spread over the beam."""
    loads = [{"type": "distributed", "member": "beam", "force": [0, -1]}] if spread else [
        down({"node": "left corner"}), down({"node": "right corner"})]
    return {"nodes": [node("left foot", 0, 0), node("left corner", 0, 1), node("right corner", 1, 1),
                      node("right foot", 1, 0)],
            "sections": [section(axial), section(axial, beam, "beam")],
            "members": [member("left column", "left foot", "left corner"),
                        member("beam", "left corner", "right corner", section="beam"),
                        member("right column", "right corner", "right foot")],
            "supports": [support("left foot", ends), support("right foot", ends)], "loads": loads}


def ring(axial, k=0.0):
    """A ring of radius 1 of two halves under outer pressure, which follows it; supports hold rigid motions only."""
    model = {"nodes": [node("bottom", 0, -1), node("top", 0, 1)], "sections": [section(axial)],
             "members": [member("right half", "bottom", "top", 180), member("left half", "top", "bottom", 180)],
             "supports": [support("bottom", "x" if k else "xyr")],
             "loads": [{"type": "pressure", "member": name, "value": 1, "side": "right"}
                       for name in ("right half", "left half")]}
    if k:
        model["foundations"] = [base(name, k, "right") for name in ("right half", "left half")]
    return model


def walls(stiffness, gap):
    return [base("shaft", stiffness, side, "compression_only", gap) for side in ("left", "right")]


def known_gable():
    path = pathlib.Path(__file__).resolve().parent / "gable.json"
    return json.loads(path.read_text(encoding="utf-8"))["model"]


BOTH = {"limit_points": 2, "load_factor": [-400, 400]}
ONE_SIDED = "compression_only"


def off_axis(model):
    """The model away from the origin: drawn about x = 0 it is symmetric in floating point too, which hides much."""
    for place in model["nodes"]:
        place["x"] += 0.37
        place["y"] -= 0.81
    return model


def up_to(load):
    return {"load_factor": [-1, load]}


def structures():
    """All of them; "stable" in a name: the branch at the first bifurcation begins stable."""
    crown, half_arch = ("arch", 2), ("first", 1)
    rows = [
        ("gable, stable", known_gable(), BOTH, ("r1", 1)),
        ("arch 14 k 1e4, stable", arch(14, 1e6, k=1e4), up_to(150), crown),
        ("arch 14 k 1.1e4 one-sided, stable", arch(14, 1e6, k=1.1e4, reaction=ONE_SIDED), up_to(150), crown),
        ("arch 14 k 1.2e4, stable", arch_of_two(14, 1e6, k=1.2e4), up_to(150), half_arch),
        ("arch 28 k 500 one-sided, stable", arch(28, 1e6, k=500, reaction=ONE_SIDED), BOTH, crown),
        ("arch 10 k 1e4 thick", arch(10, 1e5, k=1e4), BOTH, crown),
        ("arch 10 k 48600 one-sided, stable", arch(10, 1e6, k=48600, reaction=ONE_SIDED), up_to(200), crown),
        ("arch 8 k 1.298e5 one-sided, stable", arch(8, 1e7, k=1.298e5, reaction=ONE_SIDED), up_to(250), crown),
        ("arch 60", arch_of_two(60, 1e6), BOTH, half_arch),
        ("arch 28 outside k 1e3 one-sided", arch(28, 1e6, k=1e3, side="left", reaction=ONE_SIDED), BOTH, crown),
        ("clamped arch 14", arch_of_two(14, 1e6, "xyr"), BOTH, half_arch),
        ("clamped arch 28 outside k 3e3", arch(28, 1e6, "xyr", 3e3, "left", ONE_SIDED), BOTH, crown),
        ("toggle", toggle(0.3, 8000), BOTH, half_arch),
        ("toggle on a base, stable", toggle(0.3, 8000, k=300), BOTH, half_arch),
        ("portal, stable", portal("xyr", 1e5), up_to(28), ("left column", 1)),
        ("portal pinned under a spread load, stable", portal("xy", 1e5, spread=True), {"limit_points": 1},
         ("left column", 1)),
        ("column on a base", column(1e6, 380), up_to(70), ("shaft", 1)),
        ("column between walls, stable", column(1e6, bases=walls(1e4, 0.01)), up_to(70), ("shaft", 1)),
        ("pipe in the ground", ring(1e6, 50), up_to(20), ("right half", 2)),
        ("ring, stable", ring(1e4), up_to(12), ("right half", 2)),
    ]
    return [Structure(name, off_axis(model), stop, sine) for name, model, stop, sine in rows]
