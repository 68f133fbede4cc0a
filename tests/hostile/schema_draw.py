"""Random values of the schemas of an OpenAPI document: valid ones, valid ones changed at one place, spoilt ones."""
import copy
import json

LETTERS = ["a", "b", "c", "d", "/", "~", " ", '"', "ä", "梁", "🌉", "\x80"]
OTHERS = [1, 2.5, -1, 0, 1e200, 1e-320, 2 ** 63, -2 ** 63 - 1, "a", "", None, True, [], {}, "normal", [0, 0], "x" * 2000, "\x00", [[[[]]]]]
DEPTH = 40


class Drawer:
    def __init__(self, schemas, draw):
        self.schemas = schemas
        self.random = draw

    def value(self, schema, depth=0):
        """A valid value: small, at the ends of ranges now and then."""
        at = self.schemas.resolved(schema)
        for _ in range(20):
            found = self.candidate(at, depth)
            plain = at is True or not {"not", "contains", "pattern"} & at.keys()
            if plain or self.schemas.is_valid(at, found):
                break
        return found

    def candidate(self, at, depth):
        if at is True or depth > DEPTH:
            return self.random.choice(OTHERS)
        if "const" in at:
            return at["const"]
        if "enum" in at:
            return self.random.choice(at["enum"])
        if forms := at.get("oneOf") or at.get("anyOf"):
            return self.value(self.random.choice(forms), depth + 1)
        kind = at.get("type")
        kind = self.random.choice(kind) if isinstance(kind, list) else kind
        make = {"object": self.object, "array": self.list, "string": lambda at, _: self.text(at), "null": lambda *_: None,
                "boolean": lambda *_: self.random.random() < 0.5, "number": lambda at, _: self.number(at, False),
                "integer": lambda at, _: self.number(at, True)}.get(kind)
        return make(at, depth + 1) if make else self.random.choice(OTHERS)

    def object(self, at, depth):
        properties = at.get("properties", {})
        found = {name: self.value(one, depth) for name, one in properties.items()
                 if name in at.get("required", ()) or self.random.random() < 0.4}
        for name, others in at.get("dependentRequired", {}).items():
            for other in others if name in found else ():
                found.setdefault(other, self.value(properties[other], depth))
        if isinstance(at.get("additionalProperties"), dict):
            for _ in range(at.get("minProperties", 0) + self.random.randrange(2)):
                name = self.value(at.get("propertyNames", {"type": "string"}), depth)
                found[str(name)] = self.value(at["additionalProperties"], depth)
        return found

    def list(self, at, depth):
        if "prefixItems" in at:
            return [self.value(one, depth) for one in at["prefixItems"]]
        least = at.get("minItems", 0)
        found = []
        for _ in range(self.random.randint(least, max(least, min(at.get("maxItems", 1000), least + 3)))):
            item = self.value(at.get("items", True), depth)
            if not at.get("uniqueItems") or item not in found:
                found.append(item)
        return found

    def text(self, at):
        if at.get("format") == "date-time":
            return self.random.choice(["2026-01-01T00:00:00Z", "2030-12-31T23:59:59.123456Z", "1970-01-01T00:00:00Z"])
        length = at.get("maxLength", 3) if self.random.random() < 0.02 else self.random.randint(1, 3)
        start = "/" if at.get("pattern", "").startswith("^/") else ""
        if "model|analysis" in at.get("pattern", ""):
            start = self.random.choice(["/model/", "/analysis/"])
        letters = LETTERS if self.random.random() < 0.1 else LETTERS[:4]
        return start + "".join(self.random.choice(letters) for _ in range(length))

    def number(self, at, whole):
        def inside(end, sign):
            return end + sign * (1 if whole else max(abs(end) * 2 ** -52, 5e-324))
        least = inside(at["exclusiveMinimum"], 1) if "exclusiveMinimum" in at else at.get("minimum", -50)
        most = inside(at["exclusiveMaximum"], -1) if "exclusiveMaximum" in at else at.get("maximum", 50)
        chance = self.random.random()
        if chance < 0.06:
            return least if chance < 0.03 else most
        begin = max(least, -50)
        found = begin + (min(most, begin + 100) - begin) * self.random.random()
        return int(found) if whole else found

    def varied(self, schema, value, depth=0):
        """A valid value that is drawn anew at one place of `value`, which is valid, too."""
        at = self.schemas.resolved(schema)
        if forms := at.get("oneOf") or at.get("anyOf") if isinstance(at, dict) else None:
            met = [one for one in forms if self.schemas.is_valid(one, value)]
            return self.varied(met[0], value, depth + 1) if met and self.random.random() < 0.9 else self.value(at, depth)
        inner = self.inner_schemas(at, value)
        if not inner or self.random.random() < 0.1:
            return self.value(at, depth)
        key, one = self.random.choice(inner)
        changed = copy.copy(value)
        changed[key] = self.varied(one, value[key], depth + 1) if key in value or isinstance(value, list) else self.value(one, depth)
        return changed

    @staticmethod
    def inner_schemas(at, value):
        """(key or index, schema) of each place in a value, and of each property that it might have."""
        if at is True or not isinstance(value, (dict, list)):
            return []
        if isinstance(value, list):
            places = at.get("prefixItems") or [at.get("items", True)] * len(value)
            return list(enumerate(places))[:len(value)]
        properties = at.get("properties", {})
        others = at.get("additionalProperties", True)
        return list(properties.items()) + [(name, others) for name in value if name not in properties and others is not False]

    def spoilt(self, value):
        """A copy of a value with one place changed, so that it is probably none of its schema."""
        keys = list(value) if isinstance(value, dict) else list(range(len(value))) if isinstance(value, list) else []
        if not keys:
            return self.random.choice(OTHERS)
        key, chance, changed = self.random.choice(keys), self.random.random(), copy.copy(value)
        if chance < 0.7:
            changed[key] = self.spoilt(value[key])
        elif chance < 0.8:
            del changed[key]
        elif chance < 0.9 and isinstance(value, dict):
            changed[self.random.choice(["id", "range", "extra", "E", "side", "", "__proto__"])] = self.random.choice(OTHERS)
        else:
            changed[key] = self.random.choice(OTHERS)
        return changed

    def spoilt_text(self, value):
        """Bytes that are nearly the JSON of a value."""
        text = bytearray(json.dumps(value, ensure_ascii=self.random.random() < 0.5).encode("utf-8", "surrogatepass"))
        place = self.random.randrange(len(text) + 1)
        chance = self.random.random()
        if chance < 0.25:
            del text[place:]
        elif chance < 0.5:
            text[place:place] = self.random.choice([b"\x00", b"\xff", b"\xed\xa0\x80", b"1e400", b"NaN", b",", b"}", b"/* */", b"\\u0000",
                                                    b"-0", b"[" * 70])
        elif chance < 0.75:
            text[place:place + self.random.randint(1, 8)] = self.random.randbytes(self.random.randint(0, 8))
        else:
            text = text + self.random.choice([b" {}", b"\x00", b"\n\n", text[:100]])
        return bytes(text)
