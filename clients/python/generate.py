#!/usr/bin/env python3
"""Makes the parts of the package that follow the contract from the project's OpenAPI document.

  generate.py    writes snapthrough/documents.py, results.py and _builders.py

documents.py has the types of what is sent, results.py classes with an attribute for every field of what is received,
and _builders.py the methods of Model and Sweep and the classes of analyses. The files are not committed: the build of
the library and the installation by pip make them. Standard library only.
"""
import json
import keyword
import pathlib
import re
import sys
import textwrap

FOLDER = pathlib.Path(__file__).resolve().parent
PACKAGE = FOLDER / "snapthrough"
CONTRACT = FOLDER.parent.parent / "api" / "openapi" / "openapi.json"
PREFIX = "#/components/schemas/"
WIDTH = 120

HEAD = '"""{what}\n\nMade by clients/python/generate.py from the OpenAPI document; change that instead.\n"""\n'

# What is sent, and what is received; everything that these name is written, too.
SENT_ROOTS = ("Request", "SweepDocument", "AnnotatedRequest", "AnnotatedSweep")
RECEIVED_ROOTS = ("Result", "Problem", "Check", "Job", "JobList", "Sweep", "SweepList", "Limits", "JobProgressEvent",
                  "PathPointsEvent", "CriticalPointEvent", "SweepProgressEvent")
# Tables of a result: the schema of their columns, and whether its fields are lists with a value for each row.
TABLES = {"CriticalPoint": False, "Branch": True, "Static": True, "MemberState": True}
# Any JSON value.
FREE = ("JsonValue", "JsonObject")
# Classes that the package extends by hand keep their plain names for that.
RECEIVED_NAMES = {"Result": "ResultFields"}
# Parameters of builders that take shorter forms than the contract: schema, type, function that makes the document.
CONVERTED = {"Location": ("Place", "as_place"), "[SweepTarget]": ("Targets", "as_targets"),
             "SweepRefine": ("Refine", "as_refine"),
             "Model": ("Any", "as_document"), "ModelTemplate": ("Any", "as_document"),
             "Analysis": ("Any", "as_document"), "AnalysisTemplate": ("Any", "as_document")}


def camel(name):
    """`latin_hypercube` as `LatinHypercube`."""
    return "".join(word[:1].upper() + word[1:] for word in re.split(r"[^A-Za-z0-9]+", name))


def attribute(name):
    """A name that Python takes for an attribute or argument."""
    return name + "_" if keyword.iskeyword(name) else name


def wrapped(text, indent):
    """Lines of a comment that fit the page."""
    return textwrap.wrap(text, WIDTH - len(indent), initial_indent=indent, subsequent_indent=indent,
                         break_long_words=False, break_on_hyphens=False)


def code_wrapped(head, items, tail, indent):
    """Lines of `head` + items + `tail` that fit the page, broken between items only."""
    text = ", ".join(item.replace(" ", "\0") for item in items)
    lines = textwrap.wrap(head.replace(" ", "\0") + text + tail.replace(" ", "\0"), WIDTH, subsequent_indent=indent,
                          break_long_words=False, break_on_hyphens=False)
    return [line.replace("\0", " ") for line in lines]


def docstring(lines, indent):
    """A docstring of paragraphs; backslashes and triple quotes do not occur in the contract's descriptions."""
    body = wrapped('"""' + lines[0], indent)
    for line in lines[1:]:
        own = indent + "    " if line.startswith("    ") else indent
        body += textwrap.wrap(line.strip(), WIDTH - 4, initial_indent=own, subsequent_indent=own + "    ",
                              break_long_words=False, break_on_hyphens=False) if line else [""]
    if len(body) == 1 and len(body[0]) + 3 <= WIDTH:
        return [body[0] + '"""']
    return body + [indent + '"""']


def sentence(schema):
    """What a field is, with its unit."""
    text = schema.get("description", "").rstrip(".")
    unit = schema.get("x-unit")
    if not unit and "prefixItems" in schema:
        units = {item.get("x-unit") for item in schema["prefixItems"]}
        unit = units.pop() if len(units) == 1 else None
    if not unit and isinstance(schema.get("items"), dict):
        unit = schema["items"].get("x-unit")
    return text + (f" [{unit}]" if unit else "")


class Contract:
    """The schemas of the document, and names for those that have none."""

    def __init__(self, path):
        self.schemas = json.loads(path.read_text(encoding="utf-8"))["components"]["schemas"]

    def at(self, schema):
        """The name that a reference leads to, or None."""
        return schema["$ref"][len(PREFIX):] if "$ref" in schema else None

    def resolved(self, schema):
        """The schema itself, its own words before those of what it refers to."""
        name = self.at(schema)
        if name is None:
            return schema
        return {**self.schemas[name], **{key: value for key, value in schema.items() if key != "$ref"}}

    def tag(self, alternative):
        """The constant `type` of an alternative, or None."""
        return alternative.get("properties", {}).get("type", {}).get("const")

    def alternative_name(self, owner, alternative, others):
        """`ArcCurve` by its type, else `SectionWithEA` by the first field that it alone requires or has."""
        if self.tag(alternative):
            return camel(self.tag(alternative)) + owner
        mine = alternative.get("properties", {})
        required = [name for name in alternative.get("required", [])
                    if not any(name in other.get("required", []) for other in others)]
        unique = [name for name in mine if not any(name in other.get("properties", {}) for other in others)]
        names = required or unique
        return f"{owner}With{camel(names[0])}" if names else owner + "Plain"

    def alternatives(self, owner, schema):
        """Pairs of name and schema of a choice among objects."""
        choices = schema.get("oneOf") or schema.get("anyOf") or []
        return [(self.alternative_name(owner, choice, [other for other in choices if other is not choice]), choice)
                for choice in choices]


class Types:
    """Collects definitions, each once, in an order in which every name is defined before it is used."""

    def __init__(self, contract):
        self.contract = contract
        self.lines = []
        self.names = []

    def literal(self, values):
        """One of some constants."""
        words = ", ".join(json.dumps(value) for value in values if value is not None)
        return f"Optional[Literal[{words}]]" if None in values else f"Literal[{words}]"

    def scalar(self, schema):
        """The type of a number, text or truth value; None for anything else."""
        if "enum" in schema or "const" in schema:
            return self.literal(schema.get("enum", [schema.get("const")]))
        names = {"string": "str", "number": "float", "integer": "int", "boolean": "bool", "null": "None"}
        kinds = schema.get("type")
        kinds = kinds if isinstance(kinds, list) else [kinds]
        if not all(kind in names for kind in kinds):
            return None
        types = [names[kind] for kind in kinds if kind != "null"]
        if not types:
            return "None"
        text = types[0] if len(types) == 1 else f"Union[{', '.join(types)}]"
        return f"Optional[{text}]" if "null" in kinds else text

    def union(self, types):
        """A union without repetitions; null makes it optional."""
        unique = list(dict.fromkeys(kind for kind in types if kind != "None"))
        text = unique[0] if len(unique) == 1 else f"Union[{', '.join(unique)}]"
        return f"Optional[{text}]" if "None" in types else text


class Documents(Types):
    """documents.py: the types of what is sent, as dictionaries."""

    def type_of(self, schema, name):
        """The type of a schema; `name` is for a definition of its own, should it need one."""
        referred = self.contract.at(schema)
        if referred in FREE:
            return "Any"
        if referred:
            return self.define(referred)
        if "oneOf" in schema or "anyOf" in schema:
            return self.union([self.type_of(choice, own) for own, choice in self.contract.alternatives(name, schema)])
        scalar = self.scalar(schema)
        if scalar:
            return scalar
        if schema["type"] == "array":
            if "prefixItems" in schema:
                items = [self.type_of(item, name + "Item") for item in schema["prefixItems"]]
                return f"Sequence[{self.union(items)}]"
            return f"Sequence[{self.type_of(schema['items'], name + 'Item')}]"
        if "properties" in schema:
            return self.define_object(name, schema)
        return f"Mapping[str, {self.type_of(schema['additionalProperties'], name + 'Value')}]"

    def define(self, name):
        """Writes the named schema, if it is not there."""
        schema = self.contract.schemas[name]
        if name in self.names:
            return name
        if "properties" in schema:
            return self.define_object(name, schema)
        kind = self.type_of(schema, name)
        if name not in self.names:
            self.names.append(name)
            self.lines += ["", ""] + wrapped(sentence(schema), "#: ") + [f"{name} = {kind}"]
        return name

    def define_object(self, name, schema):
        """Writes a dictionary type: required fields in a base of their own."""
        if name in self.names:
            return name
        self.names.append(name)
        required, optional, words = [], [], []
        for field, value in schema["properties"].items():
            kind = self.type_of(value, name + camel(field))
            is_required = field in schema.get("required", [])
            (required if is_required else optional).append((field, kind))
            resolved = self.contract.resolved(value)
            words.append(f"{field}{'' if is_required else ' (optional)'}: {sentence(resolved)}.")
        text = docstring([sentence(schema) + ".", ""] + words, "    ")
        if required and optional:
            self.write_type(f"_{name}Required", "TypedDict", required, [])
            self.write_type(name, f"_{name}Required, total=False", optional, text)
        else:
            self.write_type(name, "TypedDict" if required else "TypedDict, total=False", required or optional, text)
        return name

    def write_type(self, name, bases, fields, text):
        """A class, or a call where a field's name is a word of Python."""
        if any(keyword.iskeyword(field) for field, _ in fields):
            members = [f'"{field}": {kind}' for field, kind in fields]
            self.lines += ["", ""] + code_wrapped(f'{name} = TypedDict(', [f'"{name}"', "{" + ", ".join(members) + "}"],
                                                  ")", "    ")
            return
        body = [f"    {field}: {kind}" for field, kind in fields]
        self.lines += ["", "", f"class {name}({bases}):"] + text + body

    def text(self):
        for root in SENT_ROOTS:
            self.define(root)
        names = [name for name in self.names if not name.startswith("_")]
        head = HEAD.format(what="Types of the documents that are sent: requests and sweeps, as dictionaries.")
        return (head + "from typing import Any, Literal, Mapping, Optional, Sequence, TypedDict, Union\n\n"
                + "\n".join(textwrap.wrap(f"__all__ = {json.dumps(sorted(names))}", WIDTH,
                                          subsequent_indent=" " * 11))
                + "\n" + "\n".join(self.lines) + "\n")


class Received(Types):
    """results.py: a class for each object, with a property for each field."""

    def literal(self, values):
        """A text: a newer service may have more values than this document."""
        return "Optional[str]" if None in values else "str"

    def type_of(self, schema, name):
        """The type of an attribute, and how it is made of the document's value; None where it is the value itself."""
        referred = self.contract.at(schema)
        if referred in FREE:
            return "Any", None
        if referred:
            return self.type_of_named(referred)
        if "anyOf" in schema or "oneOf" in schema:
            return self.type_of_choice(schema, name)
        scalar = self.scalar(schema)
        if scalar:
            return scalar, None
        if isinstance(schema["type"], list):  # of something, or null
            something = next(kind for kind in schema["type"] if kind != "null")
            return self.type_of_choice({"anyOf": [{**schema, "type": something}, {"type": "null"}]}, name)
        if schema["type"] == "array":
            if "prefixItems" in schema:
                return "List[float]", None
            kind, make = self.type_of(schema["items"], name + "Item")
            return (f"PartList[{kind}]", f"PartList({self.maker(kind)}, {{}})") if make else (f"List[{kind}]", None)
        if "properties" in schema:
            kind = self.define(name, schema)
            return kind, f"{kind}({{}})"
        kind, make = self.type_of(schema["additionalProperties"], name + "Value")
        return (f"PartMap[{kind}]", f"PartMap({self.maker(kind)}, {{}})") if make else (f"Dict[str, {kind}]", None)

    def maker(self, kind):
        """What makes an item of a list or map, whose type may be Optional."""
        optional = re.fullmatch(r"Optional\[(.*)\]", kind)
        return f"or_none({optional.group(1)})" if optional else kind

    def type_of_named(self, name):
        schema = self.contract.schemas[name]
        if "properties" not in schema:
            return self.type_of(schema, name)
        kind = self.define(RECEIVED_NAMES.get(name, name), schema)
        return kind, f"{kind}({{}})"

    def type_of_choice(self, schema, name):
        """Something or null; among objects that differ the document itself is given."""
        choices = schema.get("anyOf") or schema.get("oneOf")
        made = [self.type_of(choice, name) for choice in choices]
        kinds = [kind for kind, _ in made]
        makes = [make for _, make in made if make]
        if not makes:
            return self.union(kinds), None
        if len(makes) == 1 and "None" in kinds:
            return self.union(kinds), f"(None if value is None else {makes[0]})"
        return "Any", None

    def define(self, name, schema):
        if name in self.names:
            return name
        self.names.append(name)
        lines = ["", "", f"class {name}(Part):"] + docstring([sentence(schema) + "."], "    ")
        lines += ["", "    __slots__ = ()"]
        for field, value in schema["properties"].items():
            required = field in schema.get("required", [])
            lines += self.property_lines(field, value, name + camel(field), required)
        self.lines += lines
        return name

    def property_lines(self, field, schema, name, required):
        kind, make = self.type_of(schema, name)
        resolved = self.contract.resolved(schema)
        values = [value for form in [resolved, *resolved.get("anyOf", [])]
                  for value in self.contract.resolved(form).get("enum", []) if value is not None]
        named = f"; one of {', '.join(map(str, values))}" if 1 < len(values) <= 8 else ""
        words = sentence(resolved) + named + ("." if required else "; None when absent.")
        value = f'self._document["{field}"]' if required else f'self._document.get("{field}")'
        if not required and not kind.startswith("Optional[") and kind != "Any":
            kind = f"Optional[{kind}]"
            make = f"(None if value is None else {make})" if make else None
        lines = ["", "    @property", f'    def {attribute(field)}(self) -> "{kind}":']
        lines += docstring([words], " " * 8)
        if make and make.startswith("(None"):
            return lines + [f"        value = {value}", "        return " + make[1:-1].format("value")]
        if make:
            return lines + ["        return " + make.format(value)]
        return lines + [f"        return {value}" if kind == "Any" else f'        return cast("{kind}", {value})']

    def is_scalar(self, schema):
        """Whether values are numbers, texts or truth values, or null."""
        resolved = self.contract.resolved(schema)
        return all(map(self.is_scalar, resolved["anyOf"])) if "anyOf" in resolved else self.scalar(resolved) is not None

    def is_column(self, schema, lists):
        """Whether a field has a column: a scalar, or a list with a scalar for each row."""
        return schema.get("type") == "array" and self.is_scalar(schema["items"]) if lists else self.is_scalar(schema)

    def is_by_id(self, schema, lists):
        """Whether a field has a column for each id: an object of scalars or of lists, or null."""
        return any("additionalProperties" in one and one.get("type") == "object" and "properties" not in one
                   and self.is_column(one["additionalProperties"], lists) for one in schema.get("anyOf", [schema]))

    def columns(self, name, lists):
        """Fields with a column, and fields with a column for each id, by the rules of api/result_table.cpp."""
        properties = {field: self.contract.resolved(schema)
                      for field, schema in self.contract.schemas[name]["properties"].items()
                      if schema.get("x-column", True)}
        return (tuple(field for field, schema in properties.items() if self.is_column(schema, lists)),
                tuple(field for field, schema in properties.items() if self.is_by_id(schema, lists)))

    def tables(self):
        """The constant COLUMNS."""
        lines = ["#: Of the tables of a result: fields with a column, and fields with a column for each id.",
                 "COLUMNS: Dict[str, Tuple[Tuple[str, ...], Tuple[str, ...]]] = {"]
        for name, lists in TABLES.items():
            lines += textwrap.wrap(f"{json.dumps(name)}: {self.columns(name, lists)},", WIDTH, initial_indent="    ",
                                   subsequent_indent="        ")
        return lines + ["}"]

    def text(self):
        for root in RECEIVED_ROOTS:
            self.type_of_named(root)
        head = HEAD.format(what="Attributes of the documents that are received: results, states of jobs and sweeps, "
                                "events.")
        return (head + "from typing import Any, Dict, List, Literal, Optional, Tuple, Union, cast\n\n"
                + "from ._part import Part, PartList, PartMap, or_none\n\n"
                + "\n".join(textwrap.wrap(f"__all__ = {json.dumps(sorted(self.names + ['COLUMNS']))}", WIDTH,
                                          subsequent_indent=" " * 11))
                + "\n\n" + "\n".join(self.tables()) + "\n" + "\n".join(self.lines) + "\n")


class Argument:
    """A parameter of a builder."""

    def __init__(self, field, kind, required, words, function=None, leading=False):
        self.field = field
        self.name = attribute(field)
        self.kind = kind
        self.required = required
        self.words = words
        self.function = function
        self.leading = leading

    def declared(self):
        if self.required:
            return f"{self.name}: {self.kind}"
        optional = self.kind if self.kind == "Any" else f"Optional[{self.kind}]"
        return f"{self.name}: {optional} = None"

    def value(self):
        if not self.function:
            return self.name
        plain = f"{self.function}({self.name})"
        return plain if self.required else f"None if {self.name} is None else {plain}"

    def described(self):
        return f"    {self.name}: {self.words}."


class Builders:
    """_builders.py: bases of Model and Sweep with a method for each kind of item, and the classes of analyses."""

    def __init__(self, contract):
        self.contract = contract
        self.documents = Documents(contract)
        for root in SENT_ROOTS:
            self.documents.define(root)
        self.lines = []

    def kind_of(self, schema, name):
        """The type of a parameter in terms of documents.py, and the function that takes its shorter forms."""
        key = self.contract.at(schema)
        if schema.get("type") == "array" and "items" in schema and isinstance(schema["items"], dict):
            key = f"[{self.contract.at(schema['items'])}]"
        choices = [self.contract.at(choice) for choice in schema.get("anyOf", [])]
        for candidate in [key] + choices:
            if candidate in CONVERTED:
                return CONVERTED[candidate]
        kind = self.documents.type_of(schema, name)
        return re.sub(r"\b([A-Z]\w*)\b(?!\")", self.qualified, kind), None

    def qualified(self, match):
        name = match.group(1)
        return f"documents.{name}" if name in self.documents.names else name

    def arguments(self, owner, schemas):
        """Parameters of an object with the given alternatives: required ones first, as all of them require it."""
        fields = {}
        for schema in schemas:
            fields.update((field, value) for field, value in schema["properties"].items() if field != "type")
        result = []
        for field in fields:
            required = all(field in schema.get("required", []) for schema in schemas)
            leading = field in schemas[0].get("required", [])  # positional, too: the first alternative is the usual one
            kind, function = self.kind_of_field(owner, field, schemas)
            words = dict.fromkeys(sentence(self.contract.resolved(schema["properties"][field])) for schema in schemas
                                  if field in schema["properties"])
            result.append(Argument(field, kind, required, " / ".join(words), function, leading))
        return sorted(result, key=lambda argument: not argument.required)

    def kind_of_field(self, owner, field, schemas):
        """A field that alternatives give different types takes any of them."""
        kinds = {}
        for schema in schemas:
            if field in schema["properties"]:
                name = owner
                if len(schemas) > 1:
                    name = self.contract.alternative_name(owner, schema, [s for s in schemas if s is not schema])
                kind, function = self.kind_of(schema["properties"][field], name + camel(field))
                kinds.setdefault(kind, function)
        if len(kinds) == 1:
            return next(iter(kinds.items()))
        return f"Union[{', '.join(kinds)}]", None

    def method(self, name, what, arguments, target, made):
        """A method that appends an item; `made` are fields that are not parameters, as text."""
        required = [argument for argument in arguments if argument.required]
        required += [argument for argument in arguments if argument.leading and not argument.required]
        optional = [argument for argument in arguments if argument not in required]
        declared = ["self: _Self"] + [argument.declared() for argument in required]
        declared += ["*"] * bool(optional) + [argument.declared() for argument in optional]
        head = f"    def {name}("
        signature = code_wrapped(head, declared, ") -> _Self:", " " * len(head))
        described = [argument.described() for argument in arguments]
        fields = made + [f'"{argument.field}": {argument.value()}' for argument in arguments]
        text = docstring([what + ".", "", "Arguments:"] + described, " " * 8)
        return [""] + signature + text + self.addition(target, fields)

    def addition(self, target, fields):
        """The statement that appends an item."""
        head = f'        return self._add("{target}", {{'
        return code_wrapped(head, fields, "})", " " * len(head))

    def methods_of(self, target, item):
        """The methods of a list: one, or one for each `type` of its items; and one for each kind of curve."""
        schema = self.contract.schemas[item]
        singular = re.sub("(?<=ss)es$|s$", "", target)
        choices = schema.get("oneOf", [schema])
        if all(self.contract.tag(choice) for choice in choices):
            lines = []
            for choice in choices:
                tag = self.contract.tag(choice)
                owner = self.contract.alternative_name(item, choice, [])
                lines += self.method(f"{tag}_{singular}", choice["description"], self.arguments(owner, [choice]),
                                     target, [f'"type": "{tag}"'])
            return lines
        lines = self.method(singular, schema["description"], self.arguments(item, choices), target, [])
        for field, value in (choices[0]["properties"] if len(choices) == 1 else {}).items():
            lines += self.tagged_methods(singular, target, item, field, value)
        return lines

    def tagged_methods(self, singular, target, item, field, value):
        """Methods such as arc_member: an item with its tagged field spelled out."""
        referred = self.contract.at(value)
        choices = self.contract.schemas[referred].get("oneOf", []) if referred else []
        if not choices or not all(self.contract.tag(choice) for choice in choices):
            return []
        lines = []
        for choice in choices:
            tag = self.contract.tag(choice)
            inner = self.arguments(self.contract.alternative_name(referred, choice, []), [choice])
            outer = [argument for argument in self.arguments(item, [self.contract.schemas[item]])
                     if argument.field != field]
            arguments = sorted(outer + inner, key=lambda argument: not argument.required)
            made = ", ".join([f'"type": "{tag}"'] + [f'"{argument.field}": {argument.value()}' for argument in inner])
            what = f"{self.contract.schemas[item]['description']}: {choice['description'][0].lower()}" \
                   f"{choice['description'][1:]}"
            lines += self.method_of_tagged(f"{tag}_{singular}", what, arguments, outer, target, f'"{field}"', made)
        return lines

    def method_of_tagged(self, name, what, arguments, outer, target, field, made):
        lines = self.method(name, what, arguments, target, [])
        keep = lines[:next(i for i, line in enumerate(lines) if line.startswith("        return self._add"))]
        fields = [f'"{argument.field}": {argument.value()}' for argument in outer] + [f"{field}: given({{{made}}})"]
        return keep + self.addition(target, fields)

    def list_class(self, name, schema_name):
        """A dataclass with the fields of a document and methods that append to its lists."""
        schema = self.contract.schemas[schema_name]
        required = schema.get("required", [])
        plain, optional, lists, methods, words = [], [], [], [], []
        for field, value in sorted(schema["properties"].items(), key=lambda item: item[0] not in required):
            item = self.contract.at(value["items"]) if value.get("type") == "array" else None
            words.append(f"    {attribute(field)}: {sentence(self.contract.resolved(value))}.")
            if item:
                lists.append(f"    {attribute(field)}: List[documents.{item}] = field(default_factory=list)")
                methods += self.methods_of(field, item)
                continue
            kind, _ = self.kind_of(value, schema_name + camel(field))
            if field in required:
                plain.append(f"    {attribute(field)}: {kind}")
            else:
                optional.append(f"    {attribute(field)}: {kind if kind == 'Any' else f'Optional[{kind}]'} = None")
        self.lines += ["", "", "@dataclass", f"class {name}(Buildable):"]
        self.lines += docstring([sentence(schema) + ".", "", "Fields:"] + words, "    ")
        self.lines += [""] + plain + optional + lists
        names = ", ".join(f'"{field}"' for field in required)
        self.lines += ["", f"    _required: ClassVar[Tuple[str, ...]] = ({names},)"] + methods

    def analyses(self):
        """A class for each type of analysis, with the fields that concern it."""
        schema = self.contract.schemas["Analysis"]
        types = schema["properties"]["type"]["enum"]
        words = dict(part.split(": ", 1) for part in schema["properties"]["type"]["description"].split("; "))
        for kind in types:
            fields, described = [], []
            for field, value in schema["properties"].items():
                if field == "type" or not self.concerns(value, kind, types):
                    continue
                hint, _ = self.kind_of(value, "Analysis" + camel(field))
                fields.append(f"    {attribute(field)}: Optional[{hint}] = None")
                said = sentence(self.contract.resolved(value))
                said = said.split(": ", 1)[1] if self.named(said, types) else said
                described.append(f"    {attribute(field)}: {said}.")
            text = words[kind][0].upper() + words[kind][1:]
            self.lines += ["", "", "@dataclass", f"class {camel(kind)}(AnalysisBase):"]
            self.lines += docstring([f"Analysis of type {kind}. {text}.", "", "Every field is optional:"] + described,
                                    "    ")
            self.lines += [""] + fields + ["", f'    _type: ClassVar[str] = "{kind}"']

    def concerns(self, schema, kind, types):
        """Whether a field concerns a type: its description begins with the types that it does, unless with all."""
        named = self.named(schema.get("description", ""), types)
        return kind in named if named else True

    def named(self, words, types):
        """The types of analysis that a description begins with, as in `critical, path: what it is`."""
        head = re.split(r"[, ]+", words.split(": ", 1)[0]) if ": " in words else []
        return [word for word in head if word in types]

    def text(self):
        self.list_class("ModelFields", "Model")
        self.list_class("SweepFields", "SweepDocument")
        self.analyses()
        return (HEAD.format(what="Builders of models, analyses and sweeps, with the fields of the contract.")
                + "from dataclasses import dataclass, field\n"
                + "from typing import Any, ClassVar, List, Literal, Mapping, Optional, Sequence, Tuple, TypeVar, "
                + "Union\n\nfrom . import documents\n"
                + "from ._buildable import AnalysisBase, Buildable, Place, Refine, Targets, as_place, as_targets, "
                + "given\n\n"
                + '_Self = TypeVar("_Self", bound="Buildable")\n' + "\n".join(self.lines) + "\n")


def main(arguments):
    if arguments:
        print(__doc__, file=sys.stderr)
        return 2
    contract = Contract(CONTRACT)
    made = {"documents.py": Documents(contract).text(), "results.py": Received(contract).text(),
            "_builders.py": Builders(contract).text()}
    for name, text in made.items():
        (PACKAGE / name).write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
