"""Structures that nearly lose stability, in series over one parameter, and structures with a plain limit point."""
import math


def section(name, ea, ei):
    return {"id": name, "EA": ea, "EI": ei}


def frame(bays, storeys, a):
    """Bays of 1, 1 + a, 1 + 2 a ..., storeys of 1, pinned feet, beams loaded by 1 per length; one bay: the last column is
    1 + a times as stiff. Symmetric at a = 0."""
    xs = [0.0]
    for i in range(bays):
        xs.append(xs[-1] + 1 + (i * a if bays > 1 else 0.0))
    model = {"nodes": [], "members": [], "sections": [section("s", 1e4, 1.0)], "supports": [], "loads": []}
    if bays == 1:
        model["sections"].append(section("last", 1e4, 1.0 + a))
    for i, x in enumerate(xs):
        last = bays == 1 and i == 1
        for j in range(storeys + 1):
            model["nodes"].append({"id": f"n{i}{j}", "x": x, "y": float(j)})
            if j:
                model["members"].append({"id": f"c{i}{j}", "start": f"n{i}{j - 1}", "end": f"n{i}{j}", "section": "last" if last else "s"})
        model["supports"].append({"node": f"n{i}0", "fixed": ["x", "y"]})
    for j in range(1, storeys + 1):
        for i in range(bays):
            name = f"b{i}{j}"
            model["members"].append({"id": name, "start": f"n{i}{j}", "end": f"n{i + 1}{j}", "section": "s"})
            model["loads"].append({"type": "distributed", "member": name, "force": [0, -1.0]})
    return model


def arch(rise, clamped, loading, offset=0.0, share=0.0):
    """A circular arch of span 1, EI 1, EA 1e6: a sine offset of two half waves, or one half loaded `share` more than the other."""
    half = 2 * math.atan(2 * rise)
    fixed = ["x", "y", "rotation"] if clamped else ["x", "y"]
    model = {"nodes": [{"id": "l", "x": -0.5, "y": 0.0}, {"id": "r", "x": 0.5, "y": 0.0}], "sections": [section("s", 1e6, 1.0)],
             "members": [{"id": "arch", "start": "l", "end": "r", "section": "s",
                          "curve": {"type": "arc", "sweep_degrees": -math.degrees(2 * half)}}],
             "supports": [{"node": node, "fixed": fixed} for node in "lr"]}
    if loading == "crown":
        model["loads"] = [{"type": "point", "at": {"member": "arch", "fraction": 0.5}, "force": [0, -1.0]}]
    else:
        model["loads"] = [{"type": "distributed", "member": "arch", "force": [0, -1.0], "per": "horizontal"}]
    if share:
        model["loads"].append({"type": "distributed", "member": "arch", "force": [0, -share], "per": "horizontal", "range": [0, 0.5]})
    if offset:
        model["imperfections"] = [{"type": "sine", "member": "arch", "half_waves": 2, "amplitude": offset}]
    return model


def linear(values):
    """0 to 0.3 in equal steps."""
    return [0.3 * i / (values - 1) for i in range(values)]


def powers(values):
    """0, then 1e-6 to 1e-2 in equal ratios."""
    return [0.0] + [10 ** (-6 + 4 * i / (values - 2)) for i in range(values - 1)]


def all_series():
    """{name: (values of the parameter for a count, model of a value)}; the first value is the perfect structure."""
    series = {}
    for storeys in (1, 3):
        for bays in range(1, 6):
            series[f"frame_{bays}_bays_{storeys}_storeys"] = (linear, lambda a, b=bays, s=storeys: frame(b, s, a))
    for clamped in (False, True):
        ends = "clamped" if clamped else "pinned"
        for rise in (0.1, 0.2, 0.35):
            for loading in ("crown", "even"):
                series[f"arch_{ends}_{rise}_{loading}"] = (
                    powers, lambda e, r=rise, c=clamped, p=loading: arch(r, c, p, offset=e))
            series[f"arch_{ends}_{rise}_half"] = (powers, lambda e, r=rise, c=clamped: arch(r, c, "even", share=e))
    return series


def toggle(slope, stiffness, hinged):
    """Two bars that meet in a crown which is loaded; hinged, or rigidly joined and clamped. Shallow and thick: they snap."""
    release = {"release": {"start": ["rotation"], "end": ["rotation"]}} if hinged else {}
    return {"nodes": [{"id": "l", "x": -1.0, "y": 0.0}, {"id": "c", "x": 0.0, "y": slope}, {"id": "r", "x": 1.0, "y": 0.0}],
            "sections": [section("s", stiffness, 1.0)],
            "members": [{"id": "a", "start": "l", "end": "c", "section": "s", **release},
                        {"id": "b", "start": "c", "end": "r", "section": "s", **release}],
            "supports": [{"node": node, "fixed": ["x", "y"] if hinged else ["x", "y", "rotation"]} for node in "lr"],
            "loads": [{"type": "point", "at": {"node": "c"}, "force": [0, -1.0]}]}


def one_sided_arch(rise, clamped):
    """An arch of which the left half is loaded: it has no symmetry to lose."""
    model = arch(rise, clamped, "even")
    model["loads"] = [{"type": "distributed", "member": "arch", "force": [0, -1.0], "per": "horizontal", "range": [0, 0.5]}]
    return model


def unequal_truss(left, right, height):
    """Two hinged bars of unequal length that snap through under a load at their crown."""
    model = toggle(height, 50.0, True)
    model["nodes"][0]["x"], model["nodes"][2]["x"] = -left, right
    return model


def shallow_arch(rise, clamped, ratio):
    """A shallow arch that snaps symmetrically: EA L^2 / EI small enough that it flattens before it can sway."""
    model = arch(rise, clamped, "crown")
    model["sections"][0]["EA"] = ratio
    return model


def plain_limits():
    """{name: model} of 20 structures that lose stability at a limit point without a bifurcation before it."""
    found = {}
    for i, (slope, stiffness, hinged) in enumerate(((0.1, 300, True), (0.2, 100, True), (0.3, 50, True), (0.15, 2000, False),
                                                    (0.2, 1000, False))):
        found[f"toggle_{i}"] = toggle(slope, float(stiffness), hinged)
    for i, sides in enumerate(((1, 1.3, 0.2), (1, 2, 0.25), (0.7, 1.1, 0.15), (1, 1.05, 0.3), (1.5, 1, 0.2))):
        found[f"truss_{i}"] = unequal_truss(*sides)
    for i, (rise, clamped) in enumerate(((0.08, False), (0.15, False), (0.25, False), (0.15, True), (0.25, True))):
        found[f"one_sided_arch_{i}"] = one_sided_arch(rise, clamped)
    for i, (rise, clamped, ratio) in enumerate(((0.05, False, 4e3), (0.04, False, 7e3), (0.1, False, 1e3), (0.05, True, 1.5e4),
                                                (0.08, True, 6e3))):
        found[f"shallow_arch_{i}"] = shallow_arch(rise, clamped, ratio)
    return found
