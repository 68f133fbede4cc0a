"""JSON Schema 2020-12 as far as the service's OpenAPI document uses it; another keyword raises a ValueError.

Not judged: formats, and annotations. With the package jsonschema (python3-jsonschema of Debian) that package judges instead.
"""
import json
import math
import re

try:
    import jsonschema
except ImportError:
    jsonschema = None

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}
ANNOTATIONS = {"description", "title", "default", "format", "example", "examples", "deprecated", "discriminator", "readOnly",
               "contentMediaType"}


def bounded(kind, measure, keeps):
    """The rule of a bound: of values of a kind, `measure` must keep the bound."""
    def judge(rule, value, path, _):
        is_kind = isinstance(value, kind) and not isinstance(value, bool)
        return [f"{path}: {measure(value)} beside the bound {rule}"] if is_kind and not keeps(measure(value), rule) else []
    return staticmethod(judge)


class Schemas:
    """The schemas of an OpenAPI document; references are to places in it."""

    def __init__(self, document):
        self.document = document
        self.validators = {}
        self.rules = {name[6:]: getattr(self, name) for name in dir(self) if name.startswith("judge_")}
        if jsonschema is None:
            self.check_keywords({"anyOf": list(document["components"]["schemas"].values())})

    def check_keywords(self, schema):
        """Raises for a keyword that judge() does not know."""
        if isinstance(schema, bool):
            return
        for keyword, value in schema.items():
            if keyword not in ANNOTATIONS | {"$ref", "type"} | self.rules.keys() and not keyword.startswith("x-"):
                raise ValueError(f"the schema keyword {keyword} is not in the subset of json_schema.py")
            if keyword in ("properties", "dependentSchemas"):
                value = list(value.values())
            for inner in value if isinstance(value, list) else [value]:
                if isinstance(inner, dict) and keyword not in ("const", "enum", "default", "discriminator", "dependentRequired"):
                    self.check_keywords(inner)

    def target(self, reference):
        found = self.document
        for part in reference.removeprefix("#/").split("/"):
            found = found[part.replace("~1", "/").replace("~0", "~")]
        return found

    def resolved(self, schema):
        """The schema itself, behind references; keywords beside a reference are kept."""
        while isinstance(schema, dict) and "$ref" in schema:
            beside = {key: value for key, value in schema.items() if key != "$ref" and key not in ANNOTATIONS}
            schema = {**self.target(schema["$ref"]), **beside}
        return schema

    def faults(self, schema, value):
        """Sentences about what a value has against a schema; empty: it is valid."""
        if jsonschema is None:
            return self.judge(schema, value, "")
        key = json.dumps(schema, sort_keys=True)
        if key not in self.validators:
            self.validators[key] = jsonschema.Draft202012Validator({**schema, "components": self.document["components"]})
        return [f"{fault.json_path}: {fault.message[:300]}" for fault in self.validators[key].iter_errors(value)]

    def is_valid(self, schema, value):
        """The same by the subset alone, which is quicker for small values."""
        return not self.judge(schema, value, "")

    def judge(self, schema, value, path):
        if schema is True or schema is False:
            return [] if schema else [f"{path}: nothing is allowed here"]
        schema = self.resolved(schema)
        if not self.has_type(schema.get("type"), value):
            return [f"{path}: is no {schema['type']}"]
        found = []
        for keyword, rule in schema.items():
            if keyword in self.rules:
                found += self.rules[keyword](rule, value, path, schema)
        return found

    @staticmethod
    def has_type(types, value):
        def has(one):
            if one in ("number", "integer"):
                is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
                return is_number and (one == "number" or (math.isfinite(value) and value == int(value)))
            return isinstance(value, TYPES[one])
        return types is None or any(has(one) for one in ([types] if isinstance(types, str) else types))

    def judge_const(self, rule, value, path, _):
        return [] if json.dumps(value) == json.dumps(rule) else [f"{path}: is not {rule!r}"]

    def judge_enum(self, rule, value, path, _):
        return [] if value in rule else [f"{path}: {value!r} is none of {rule}"]

    def judge_anyOf(self, rule, value, path, _):
        return [] if any(not self.judge(one, value, path) for one in rule) else [f"{path}: meets no form of anyOf"]

    def judge_oneOf(self, rule, value, path, _):
        met = sum(not self.judge(one, value, path) for one in rule)
        return [] if met == 1 else [f"{path}: meets {met} forms of oneOf"]

    def judge_allOf(self, rule, value, path, _):
        return [fault for one in rule for fault in self.judge(one, value, path)]

    def judge_not(self, rule, value, path, _):
        return [] if self.judge(rule, value, path) else [f"{path}: is what it must not be"]

    def judge_properties(self, rule, value, path, _):
        if not isinstance(value, dict):
            return []
        return [fault for name, one in rule.items() if name in value for fault in self.judge(one, value[name], f"{path}/{name}")]

    def judge_required(self, rule, value, path, _):
        return [f"{path}: lacks {name}" for name in rule if isinstance(value, dict) and name not in value]

    def judge_additionalProperties(self, rule, value, path, schema):
        others = set(value) - set(schema.get("properties", {})) if isinstance(value, dict) else ()
        return [fault for name in others for fault in self.judge(rule, value[name], f"{path}/{name}")]

    def judge_propertyNames(self, rule, value, path, _):
        return [fault for name in value for fault in self.judge(rule, name, path)] if isinstance(value, dict) else []

    def judge_dependentRequired(self, rule, value, path, _):
        return [f"{path}: {name} needs {other}" for name, others in rule.items() for other in others
                if isinstance(value, dict) and name in value and other not in value]

    def judge_items(self, rule, value, path, schema):
        if not isinstance(value, list):
            return []
        first = len(schema.get("prefixItems", ()))
        return [fault for n, one in enumerate(value[first:], first) for fault in self.judge(rule, one, f"{path}/{n}")]

    def judge_prefixItems(self, rule, value, path, _):
        pairs = zip(rule, value) if isinstance(value, list) else ()
        return [fault for n, (one, item) in enumerate(pairs) for fault in self.judge(one, item, f"{path}/{n}")]

    def judge_contains(self, rule, value, path, _):
        met = not isinstance(value, list) or any(not self.judge(rule, one, path) for one in value)
        return [] if met else [f"{path}: contains none of what it must"]

    def judge_uniqueItems(self, rule, value, path, _):
        texts = [json.dumps(one, sort_keys=True) for one in value] if rule and isinstance(value, list) else []
        return [] if len(set(texts)) == len(texts) else [f"{path}: has an item twice"]

    def judge_pattern(self, rule, value, path, _):
        return [f"{path}: does not match {rule}"] if isinstance(value, str) and not re.search(rule, value) else []

    judge_minLength = bounded(str, len, lambda a, b: a >= b)
    judge_maxLength = bounded(str, len, lambda a, b: a <= b)
    judge_minItems = bounded(list, len, lambda a, b: a >= b)
    judge_maxItems = bounded(list, len, lambda a, b: a <= b)
    judge_minProperties = bounded(dict, len, lambda a, b: a >= b)
    judge_maxProperties = bounded(dict, len, lambda a, b: a <= b)
    judge_minimum = bounded((int, float), float, lambda a, b: a >= b)
    judge_maximum = bounded((int, float), float, lambda a, b: a <= b)
    judge_exclusiveMinimum = bounded((int, float), float, lambda a, b: a > b)
    judge_exclusiveMaximum = bounded((int, float), float, lambda a, b: a < b)
