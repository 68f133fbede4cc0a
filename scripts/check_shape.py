#!/usr/bin/env python3
"""Checks the size of what people have to read: functions, files, nesting.

  check_shape.py [FILE...]    default: every .h, .cpp and .py of the project; exit status 1 names the offenders
  check_shape.py --self-test  checks the checker

A C++ function is counted from the first line of its signature to its closing brace, lambdas inside it included.
Nesting counts the blocks inside the function's own braces, statements without braces included. C++ is read by its
indentation, so it has to be formatted (scripts/format.sh).
"""
import ast
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.cpp_text import strip_all  # noqa: E402

MAX_FUNCTION = 60
MAX_FILE = 800
MAX_NESTING = 4
ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("solver", "api", "server", "clients", "tests", "bench", "scripts")
# Made by clients/python/generate.py, one entry for each field of the contract.
GENERATED = ("clients/python/snapthrough/documents.py", "clients/python/snapthrough/results.py")

SCOPE = re.compile(r"(?:template\s*<.*>\s*)?(?:inline |typedef )*(?:namespace|extern|class|struct|union|enum)\b")
CONTROL = re.compile(r"(?:\} )?(?:if|for|while|switch|else|do|try|catch)\b")
LABEL = re.compile(r"(?:case\b.*|default|public|private|protected):$")
INITIALISER = re.compile(r"(?:[^\s{]|\{\{|(?:=|,|\(|\breturn) )\{?$")


class CppScanner:
    """Reads blocks from the layout of clang-format: a block ends at a line that is indented as the first line of its head.

    A block is (kind, indentation, line): kind is scope (namespace, class), function, block (inside a function) or
    initialiser.
    """

    def __init__(self, source):
        self.lines = strip_all(source).split("\n")
        self.stack = []
        self.head = []  # lines of the statement that has begun
        self.start = (0, 0)  # indentation and line of its first line
        self.found = []  # (line, text)

    def scan(self):
        for number, line in enumerate(self.lines, 1):
            text = line.strip()
            if text:
                self.take(text, len(line) - len(line.lstrip()), number)
        return self.found

    def take(self, text, indentation, number):
        if not self.head or text.startswith("}"):
            self.begin(text, indentation, number)
        self.head.append(text)
        if text.endswith("{"):
            if self.is_in_parentheses():
                self.start = (indentation, number)  # a lambda among arguments
            self.open(text)
        if self.is_complete(text):
            self.head = []

    def is_complete(self, text):
        """Whether the statement, its head or its label ends with this line."""
        if text[-1] in "{}" or LABEL.match(text):
            return True
        return (text[-1] == ";" or CONTROL.match(self.head[0])) and not self.is_in_parentheses()

    def is_in_parentheses(self):
        head = " ".join(self.head)
        return head.count("(") > head.count(")")

    def begin(self, text, indentation, number):
        """A line begins a statement, or closes a block."""
        while self.stack and self.stack[-1][1] >= indentation:
            kind, _, first = self.stack.pop()
            length = number - first + 1
            if kind == "function" and length > MAX_FUNCTION:
                self.found.append((first, f"function of {length} lines, at most {MAX_FUNCTION}"))
        self.head = []
        self.start = (indentation, number)
        if self.function() and CONTROL.match(text):
            self.push("block")

    def open(self, text):
        """The statement ends with an opening brace."""
        if self.stack and self.stack[-1][1:] == self.start:
            return  # a control statement, pushed at its first line
        inside = self.stack[-1][0] if self.stack else "scope"
        if INITIALISER.search(text[:-1]) or (text == "{" and inside == "initialiser"):
            self.push("initialiser")
        elif self.function():
            self.push("block")
        else:
            self.push("scope" if SCOPE.match(" ".join(self.head)) else "function")

    def function(self):
        return any(kind == "function" for kind, _, _ in self.stack)

    def push(self, kind):
        self.stack.append((kind, *self.start))
        if kind == "block" and sum(one[0] == "block" for one in self.stack) == MAX_NESTING + 1:
            self.found.append((self.start[1], f"nesting deeper than {MAX_NESTING}"))


def check_cpp(source):
    return CppScanner(source).scan()


PY_BLOCKS = (ast.For, ast.AsyncFor, ast.While, ast.If, ast.With, ast.AsyncWith, ast.Try, ast.Match)


def python_nesting(node, depth=0):
    deepest = depth
    for field, value in ast.iter_fields(node):
        for child in value if isinstance(value, list) else [value]:
            if not isinstance(child, ast.AST):
                continue
            is_elif = isinstance(node, ast.If) and field == "orelse" and isinstance(child, ast.If)
            step = isinstance(child, PY_BLOCKS) and not is_elif
            deepest = max(deepest, python_nesting(child, depth + step))
    return deepest


def check_python(source):
    found = []
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            continue
        length = node.end_lineno - node.lineno + 1
        if length > MAX_FUNCTION:
            found.append((node.lineno, f"function of {length} lines, at most {MAX_FUNCTION}"))
        if python_nesting(node) > MAX_NESTING:
            found.append((node.lineno, f"nesting deeper than {MAX_NESTING}"))
    return found


def check_source(source, suffix):
    found = check_python(source) if suffix == ".py" else check_cpp(source)
    lines = len(source.splitlines())
    if lines > MAX_FILE:
        found.append((1, f"file of {lines} lines, at most {MAX_FILE}"))
    return found


# Self-test -------------------------------------------------------------------------------------------------------

LONG = "".join(f"  x += {i};\n" for i in range(60))
DEEP = "  if (a) {\n    for (;;) {\n      while (b) {\n        switch (c) {\n          case 1: {\n            x();\n"
BAD = {
    "long function": (".cpp", f"int f() {{\n{LONG}}}\n"),
    "long constructor": (".cpp", f"X::X(int a)\n    : a_(a),\n      b_{{1}} {{\n{LONG}}}\n"),
    "long method after access specifier": (".h", f"class X {{\n public:\n  void f() const {{\n{LONG.replace('  x', '    x')}  }}\n}};\n"),
    "long template": (".h", f"template <class T>\n  requires std::integral<T>\nT f(T x) {{\n{LONG}}}\n"),
    "long function with trailing return": (".cpp", f"auto f() -> std::vector<int> {{\n{LONG}}}\n"),
    "long lambda counts in its function": (".cpp", f"void f() {{\n  g([&](int x) {{\n{LONG.replace('  x', '    x')}  }});\n}}\n"),
    "long lambda at namespace scope": (".cpp", f"const auto f = [](int x) {{\n{LONG}}};\n"),
    "long operator": (".cpp", f"bool operator()(int x) {{\n{LONG}}}\n"),
    "long test": (".cpp", f"TEST(A, B) {{\n{LONG}}}\n"),
    "long signature": (".cpp", "void f(" + "int a,\n       " * 58 + "int b) {\n  x();\n}\n"),
    "deep blocks": (".cpp", f"void f() {{\n{DEEP}"),
    "deep without braces": (".cpp", "void f() {\n  if (a)\n    for (;;)\n      while (b)\n        if (c)\n          for (;;) x();\n}\n"),
    "deep through a lambda": (".cpp", "void f() {\n  g(\n      [&] {\n        if (a) {\n          for (;;) {\n            while (b) {\n"
                              "              if (c) x();\n"),
    "deep in an else": (".cpp", f"void f() {{\n  if (z) {{\n    x();\n  }} else {{\n{DEEP.replace('  ', '    ')}"),
    "deep after strings with braces": (".cpp", 'void f() {\n  s = "}}";\n  t = R"(\n}})";\n  c = \'}\';\n' + DEEP),
    "long file": (".cpp", "int x;\n" * 801),
    "long python": (".py", "def f():\n" + "    x = 1\n" * 60),
    "deep python": (".py", "def f():\n if a:\n  for b in c:\n   while d:\n    with e:\n     if g:\n      pass\n"),
}
GOOD = {
    "60 lines": (".cpp", "int f() {\n" + "  x += 1;\n" * 58 + "}\n"),
    "four levels": (".cpp", "void f() {\n  if (a) {\n    for (;;) {\n      while (b) {\n        if (c) {\n          x();\n"),
    "initialisers do not nest": (".cpp", "void f() {\n  if (a) {\n    for (;;) {\n      while (b) {\n        if (c) {\n          g({{\n"
                                 "              {\n                  1,\n"),
    "else if does not nest": (".cpp", "void f() {\n  if (a) {\n    x();\n" + "  } else if (b) {\n    x();\n" * 5 + "  } else {\n    x();\n  }\n}\n"),
    "unbraced statements in a row": (".cpp", "void f() {\n" + "  if (a) x();\n" * 6 + "}\n"),
    "conditions of many lines": (".cpp", "void f() {\n" + "  if (a &&\n      b) {\n    x();\n  }\n" * 6 + "}\n"),
    "long class of short functions": (".h", "struct X {\n" + "  int f() { return 1; }\n" * 100 + "};\n"),
    "long class template": (".h", "template <class T>\nclass X final : public Y<T> {\n" + "  int x;\n" * 100 + "};\n"),
    "long namespace": (".cpp", "namespace a {\n" + "int x;\n" * 100 + "}\n"),
    "long table": (".cpp", "const int t[] = {\n" + "    1,\n" * 100 + "};\nstd::vector<X> v{\n" + "    {1, 2},\n" * 99 + "};\n"),
    "long table of lambdas": (".cpp", "INSTANTIATE(X, Y,\n            Values(\n" + "                Z{1,\n                  [] {\n"
                              "                    x();\n                  }},\n" * 20 + "                Z{2}));\n"),
    "macro and comment": (".cpp", "#define F(x) { { { { { {\n// { { { {\n/* { { { */\nint f() { return 1; }\n"),
    "digit separators": (".cpp", "int f() { return 1'000'000 + '{'; }\n"),
    "elif python": (".py", "def f():\n if a:\n  pass\n elif b:\n  pass\n elif c:\n  pass\n elif d:\n  pass\n elif e:\n  pass\n"),
}


def self_test():
    wrong = [f"not found: {name}" for name, (suffix, source) in BAD.items() if not check_source(source, suffix)]
    for name, (suffix, source) in GOOD.items():
        wrong += [f"{name}: {line}: {text}" for line, text in check_source(source, suffix)]
    print("\n".join(wrong) if wrong else f"check_shape: self-test of {len(BAD) + len(GOOD)} snippets passed")
    return 1 if wrong else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    files = [pathlib.Path(name) for name in arguments] or sorted(
        path for folder in FOLDERS for path in (ROOT / folder).rglob("*") if path.suffix in (".h", ".cpp", ".py")
        and path.relative_to(ROOT).as_posix() not in GENERATED)
    offenders = 0
    for path in files:
        for line, text in check_source(path.read_text(encoding="utf-8"), path.suffix):
            offenders += 1
            print(f"{path.relative_to(ROOT) if path.is_absolute() else path}:{line}: {text}")
    print(f"check_shape: {len(files)} files, {offenders} too long or too deep")
    return 1 if offenders else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
