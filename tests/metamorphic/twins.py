"""Twins of a request: the same structure in another drawing, and how their results are read as those of the first."""
import copy
import math
import pathlib
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent / "variations")]
import names  # noqa: E402
import units  # noqa: E402
import variations  # noqa: E402

KN_AND_M = {"N and mm": (1e3, 1e3), "MN and km": (1e-3, 1e-3)}  # (length, force) in units of the first request, kN and m
LISTS = ("nodes", "members", "springs", "foundations", "monitors")


class View:
    """How the ids, directions and units of a twin's result are those of the first request.

    ids: {list: {id of the first: ids of the twin}}, several where a member was cut; degrees and mirrored: the twin is the first
    mirrored at the y axis, then turned; backwards: members that are drawn from their end; length, force: the twin's numbers over
    the first's.
    """

    def __init__(self, model):
        self.ids = {key: {item["id"]: [item["id"]] for item in model.get(key, [])} for key in LISTS}
        self.degrees = 0.0
        self.mirrored = False
        self.backwards = set()
        self.length = self.force = 1.0

    def vector(self, x, y):
        """A vector of the twin in the axes of the first request."""
        angle = -math.radians(self.degrees)
        x, y = math.cos(angle) * x - math.sin(angle) * y, math.sin(angle) * x + math.cos(angle) * y
        return (-x if self.mirrored else x), y

    def hand(self):
        return -1.0 if self.mirrored else 1.0


class Twin:
    def __init__(self, name, request, view):
        self.name = name
        self.request = request
        self.view = view


def turned(request, view, degrees, mirrored):
    variations.move(request, degrees, mirrored)
    view.degrees, view.mirrored = degrees, mirrored
    return mirror_rule(request, -1 if mirrored else 1)


def mirror_rule(request, sign):
    """A rule of `stop` on a monitor whose sign changes with the drawing."""
    rule = request["analysis"].get("stop", {}).get("monitor")
    if rule and sign < 0:
        rule["range"] = [-value for value in reversed(rule["range"])]
    return request


def backwards(request, view):
    names_of_all = {member["id"] for member in request["model"]["members"]}
    rule = request["analysis"].get("stop", {}).get("monitor")
    variations.reverse_members(request, names_of_all)
    view.backwards = names_of_all
    return mirror_rule(request, -1 if rule else 1)


def cut(request, view, fraction):
    """Cuts each member that can be cut; None if there is none, and on a given mesh, which is another one where loads end on a member."""
    if "elements" in request["analysis"]["discretization"]:
        return None
    for member in list(request["model"]["members"]):
        name = member["id"]
        if variations.split_member(request["model"], name, fraction) is not None:
            view.ids["members"][name] = [name, f"{name} beyond"]
    left = {item["id"] for item in request["model"]["foundations"]}
    for name, ids in view.ids["foundations"].items():
        view.ids["foundations"][name] = [one for one in (ids[0], f"{ids[0]} beyond") if one in left]
    return request if any(len(ids) > 1 for ids in view.ids["members"].values()) else None


def shuffled(request, view, rng):
    new = names.shuffled(request, rng)
    view.ids = {key: {old: [new[key][old]] for old in ids} for key, ids in view.ids.items()}
    return request


def converted(request, view, length, force):
    view.length, view.force = length, force
    return units.convert(request, length, force)


def edits(rng):
    """{name: edit of a request and a view}"""
    found = {name: lambda request, view, factors=factors: converted(request, view, *factors) for name, factors in KN_AND_M.items()}
    found["turn 37"] = lambda request, view: turned(request, view, 37, False)
    found["mirror"] = lambda request, view: turned(request, view, 0, True)
    found["reverse"] = backwards
    found["cut 0.5"] = lambda request, view: cut(request, view, 0.5)
    found["cut 0.43"] = lambda request, view: cut(request, view, 0.43)
    found["shuffle"] = lambda request, view: shuffled(request, view, rng)
    return found


def twin(request, name, rng):
    """The twin `name`; None where the drawing can not be changed in this way."""
    if name == "turn 37" and any(load.get("per", "length") != "length" for load in all_loads(request["model"])):
        return None
    view = View(request["model"])
    changed = edits(rng)[name](copy.deepcopy(request), view)
    return Twin(name, changed, view) if changed else None


def all_loads(model):
    return [load for holder in [model, *model.get("load_cases", [])] for load in holder.get("loads", [])]


NAMES = tuple(edits(None))
