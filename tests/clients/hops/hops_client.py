"""A client of the protocol that Hops (Grasshopper) speaks, as its source has it (mcneel/compute.rhino3d:
src/hops/RemoteDefinition.cs, HopsComponent.cs, src/compute.geometry/IO/Schema.cs).

It does what Hops does where that matters to a service:
  - The address is asked twice without a key: the media type tells that it is a component, then it is described.
  - Calls go to http://HOST/solve, whatever the component's address is; `pointer` has its path without the first slash.
  - The key is sent in RhinoComputeKey, with calls only.
  - Documents are read into typed members. What does not fit (an object where a text is expected) loses the whole document.
  - Numbers are read by the type that stands beside them; a value that cannot be read stops the component.
  - The statuses 408 and 500 have a meaning, no other.
"""
import http.client
import json
import math
import urllib.parse

PARAM_TYPES = {"Number", "Integer", "Text", "Boolean", "Point"}


class Broken(Exception):
    """Hops would fail here in a way that tells its user nothing."""


def _texts(value, name):
    if not isinstance(value, list) or not all(isinstance(one, str) for one in value):
        raise Broken(f"{name} is no list of texts: {value!r}")
    return value


def _item(kind, value):
    """A value as .NET serialises it."""
    if kind == "Point":
        return {"type": "Rhino.Geometry.Point3d", "data": json.dumps(dict(zip("XYZ", value)))}
    if isinstance(value, bool):
        return {"type": "System.Boolean", "data": json.dumps(value)}
    if isinstance(value, float) and not math.isfinite(value):
        return {"type": "System.Double", "data": '"NaN"'}
    names = {float: "System.Double", int: "System.Int32", str: "System.String"}
    return {"type": names[type(value)], "data": json.dumps(value)}


def _goo(item):
    """The value that Grasshopper makes of an item."""
    data = item["data"].strip('"')
    kind = item["type"]
    if kind == "System.Boolean":
        return {"true": True, "false": False}[data.lower()]
    if kind == "System.Double":
        return float(data)
    if kind == "System.Int32":
        number = int(data)
        if abs(number) >= 2**31:
            raise Broken(f"no System.Int32: {data}")
        return number
    if kind == "System.String":
        return data
    if kind == "Rhino.Geometry.Point3d":
        point = json.loads(data)
        return point["X"], point["Y"], point["Z"]
    raise Broken(f"unable to convert {kind}")


def _branch(key):
    """The path of a branch: numbers between braces, separated by semicolons."""
    return tuple(int(token) for token in key.strip("{}").split(";") if token.strip())


class Answer:
    """What the component shows after a call: its outputs, and its messages."""

    def __init__(self, status, text):
        self.status = status
        self.outputs = {}
        if status == 408:
            self.errors, self.warnings = ["Request timeout"], []
            return
        try:
            document = json.loads(text)
            self.errors = _texts(document.get("errors", []), "errors")
            self.warnings = _texts(document.get("warnings", []), "warnings")
            self.values = document["values"]
        except (ValueError, KeyError, AttributeError) as error:
            raise Broken(f"no document of the protocol ({status}): {text[:200]!r}") from error
        for tree in self.values:
            branches = {_branch(key): [_goo(item) for item in items] for key, items in tree["InnerTree"].items()}
            self.outputs[tree["ParamName"]] = branches

    def one(self, name):
        """The only value of an output; None when it has none."""
        values = [value for branch in self.outputs[name].values() for value in branch]
        assert len(values) <= 1, (name, values)
        return values[0] if values else None


class Component:
    """A component on the canvas that was given an address."""

    def __init__(self, address, key=None, timeout=100):
        self.url = urllib.parse.urlsplit(address)
        self.key = key
        self.timeout = timeout
        _, media_type, _ = self._send("GET", self.url.path)
        if "json" not in media_type:
            raise Broken("the address is taken for that of a Grasshopper file")
        _, _, text = self._send("GET", self.url.path)
        document = json.loads(text)
        self.description = document["Description"]
        self.errors = _texts(document.get("Errors", []), "Errors")
        self.inputs = {one["Name"]: one for one in document["Inputs"]}
        self.outputs = {one["Name"]: one for one in document["Outputs"]}
        for plug in list(self.inputs.values()) + list(self.outputs.values()):
            if plug["ParamType"] not in PARAM_TYPES:
                raise Broken(f"no type of Grasshopper: {plug['ParamType']}")

    def _send(self, method, path, body=None, headers=None):
        """Status, media type and text of the response."""
        connection = http.client.HTTPConnection(self.url.hostname, self.url.port, timeout=self.timeout)
        try:
            connection.request(method, path, body=body, headers=headers or {})
            response = connection.getresponse()
            return response.status, response.getheader("Content-Type", "").lower(), response.read().decode()
        finally:
            connection.close()

    def defaults(self):
        """What the inputs have when nothing is connected to them."""
        values = {}
        for name, one in self.inputs.items():
            initial = one["Default"]
            if isinstance(initial, dict) and "InnerTree" in initial:
                initial = [_goo(item) for items in initial["InnerTree"].values() for item in items]
            values[name] = initial
        return values

    def document(self, values, path="{0}"):
        """The call with these values, as lists where the input takes a list."""
        trees = []
        for name, value in values.items():
            kind = self.inputs.get(name, {}).get("ParamType", "")
            items = value if isinstance(value, list) else [value]
            branch = [_item(kind, one) for one in items if one is not None]
            trees.append({"ParamName": name, "InnerTree": {path: branch} if branch else {}})
        return {"absolutetolerance": 0.001, "angletolerance": 1.0, "modelunits": "Meters", "dataversion": 7, "algo": None,
                "pointer": self.url.path[1:], "cachesolve": False, "values": trees}

    def refused_here(self, values):
        """What Hops says itself of numbers beyond the bounds of an input, without calling."""
        errors = []
        for name, value in values.items():
            one = self.inputs.get(name, {})
            least, most = one.get("Minimum"), one.get("Maximum")
            if isinstance(value, (int, float)) and least is not None and not least <= value <= most:
                errors.append(name)
        return errors

    def post(self, document, path="/solve", headers=None):
        """Sends a call; a document that is a text is sent as it is."""
        body = document if isinstance(document, (str, bytes)) else json.dumps(document)
        sent = {"Content-Type": "application/json; charset=utf-8"}
        if self.key is not None:
            sent["RhinoComputeKey"] = self.key
        sent.update(headers or {})
        status, _, text = self._send("POST", path, body.encode() if isinstance(body, str) else body, sent)
        return Answer(status, text)

    def solve(self, **values):
        """Calls the component with these values, the others as they are at the beginning."""
        answer = self.post(self.document({**self.defaults(), **values}))
        if answer.values and len(answer.values) != len(self.outputs):
            raise Broken("Hops would take the component for changed")
        return answer
