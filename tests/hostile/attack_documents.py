"""Documents that cost a service much: to read, to check, to compute, to keep or to send. All are bytes of JSON."""
import json

from service_process import example


def encoded(document):
    return json.dumps(document, separators=(",", ":")).encode()


def chain(count, curve=None, **more):
    """A request of `count` straight or curved members in a row, clamped at its first node."""
    member = {"section": "shaft", **({"curve": curve} if curve else {})}
    return {"model": {
        "nodes": [{"id": f"n{i}", "x": i, "y": 0} for i in range(count + 1)],
        "sections": [{"id": "shaft", "EA": 1e6, "EI": 1}],
        "members": [{"id": f"m{i}", "start": f"n{i}", "end": f"n{i + 1}", **member} for i in range(count)],
        "supports": [{"node": "n0", "fixed": ["x", "y", "rotation"]}],
        "loads": [{"type": "point", "at": {"node": f"n{count}"}, "force": [-1, 0]}]},
        "analysis": {"type": "critical", **more}}


def curves(count=2000):
    """Each curve has a thousand half waves, whose lengths are integrated before the document is accepted."""
    return encoded(chain(count, {"type": "sine", "rise": 0.01, "half_waves": 1000}))


def sensitivities(count=3500):
    """Two sensitivities for each of `count` nodes: the cost of checking was once the cube of their number."""
    pointers = [f"/model/nodes/{i}/{axis}" for i in range(1, count) for axis in "xy"]
    return encoded(chain(count, sensitivities=pointers))


def meshes():
    """1.2 KB that ask for ten members with 100 000 elements each."""
    return encoded(chain(10, discretization={"elements": 100_000}))


def long_title(size=8_000_000):
    request = example("column_winkler.json")
    request["model"]["title"] = "x" * size
    return encoded(request)


def beck(number):
    """A column under a following force whose path takes minutes: straight, leaning or soft, by `number`."""
    request = example("beck.json")
    request["model"]["nodes"][1]["x"] = (0, 0.3, 0)[number % 3]
    request["model"]["sections"][0]["EA"] = (1e8, 1e8, 1e3)[number % 3]
    request["model"]["title"] = f"costly {number}"
    request["analysis"]["stop"] = {"load_factor": [0, 1e6], "steps": 10_000_000}
    request["analysis"]["discretization"] = {"elements": 2000, "order": 3}
    return encoded(request)


def sweep(seed, points=100_000):
    document = example("sweeps/column_random.json")
    document["design"] = {"latin_hypercube": {"samples": points, "seed": seed}}
    return encoded(document)


def sweep_of_large_rows(seed, points=2000):
    """Each row has all states and branches of a path: some hundred kilobytes."""
    request = example("column_winkler.json")
    request["analysis"]["output"] = {"states": "all"}
    return encoded({**request,
                    "parameters": [{"name": "k", "targets": [{"pointer": "/model/foundations/0/stiffness"}],
                                    "range": {"from": 10 + seed, "to": 11 + seed, "count": points}}],
                    "design": "grid", "outputs": ["/states", "/branches"]})


def small_job(number, callback=None):
    request = example("column_winkler.json")
    request["model"]["foundations"][0]["stiffness"] = 20 + 1e-3 * (number % 100_000)
    return encoded({"callback": callback, "request": request} if callback else request)
