"""Other ids for everything, and every list in another order."""

NAMED = {"nodes": "node", "sections": "section", "members": "member", "springs": "spring", "foundations": "foundation", "monitors": "monitor"}


def shuffled(request, rng):
    """Shuffles a request in place; returns {list: {old id: new id}}."""
    model = request["model"]
    new = {key: dict(zip([item["id"] for item in model.get(key, [])], others(len(model.get(key, [])), word, rng)))
           for key, word in NAMED.items()}
    refers = {"node": new["nodes"], "start": new["nodes"], "end": new["nodes"], "member": new["members"], "section": new["sections"]}

    def renamed(item, key):
        out = {field: refers.get(field, {}).get(value, value) if isinstance(value, str) else value for field, value in item.items()}
        if key in new:
            out["id"] = new[key][item["id"]]
        for field in ("at", "to"):
            if field in out:
                out[field] = {name: refers.get(name, {}).get(value, value) for name, value in out[field].items()}
        return out

    for owner in [*model.get("load_cases", []), model]:
        for key, items in owner.items():
            if isinstance(items, list) and key != "load_cases":
                owner[key] = [renamed(item, key) for item in items]
                rng.shuffle(owner[key])
    rename_analysis(request["analysis"], new)
    return new


def others(count, word, rng):
    numbers = list(range(count))
    rng.shuffle(numbers)
    return [f"{word}-{number}" for number in numbers]


def rename_analysis(analysis, new):
    rule = analysis.get("stop", {}).get("monitor")
    if rule:
        rule["id"] = new["monitors"][rule["id"]]
    elements = analysis["discretization"].get("elements")
    if isinstance(elements, dict):
        analysis["discretization"]["elements"] = {new["members"][name]: number for name, number in elements.items()}
