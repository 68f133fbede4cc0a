#!/usr/bin/env python3
"""Checks the size of what people have to read: functions, files, nesting.

  check_shape.py [FILE...]    default: every .h, .cpp and .py of the project; exit status 1 names the offenders
  check_shape.py --self-test  checks the checker

A C++ function is counted from the first line of its signature to its closing brace, lambdas inside it included.
Nesting counts the blocks inside the function's own braces, statements without braces included.
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

TYPE_HEAD = re.compile(r"^(?:typedef\s+)?(?:class|struct|union|enum)\b")
SIGNATURE_END = re.compile(
    r"\)\s*(?:const|noexcept(?:\s*\([^()]*\))?|override|final|mutable|try|&&?|\s)*"
    r"(?:->\s*[\w:<>,\s*&.()]+?)?(?:\brequires\b.*)?\s*$", re.DOTALL)
LAMBDA_END = re.compile(r"\[[^\[\]]*\]\s*$")
BLOCK_WORD = re.compile(r"\b(?:else|do|try|mutable|noexcept|const)\s*$")
CONTROL = re.compile(r"\b(?:if|for|while|switch|catch|else|do)\b")
TOKEN = re.compile(r"\w+|::|->|\S")


class Block:
    """An open brace, or (virtual) the body of a control statement without braces."""

    def __init__(self, kind, line, parens, head_line=0):
        self.kind = kind  # scope, function, block, init, virtual
        self.line = line
        self.parens = parens
        self.head_line = head_line


def is_member_initialiser(head):
    """Whether the head is a constructor's and stands inside its list of initialisers: `X::X(a) : a_(a), b_`."""
    colon = re.search(r"\)\s*(?:noexcept\s*)?:(?!:)", head)
    return bool(colon) and re.search(r"[\w>]\s*$", head) is not None


def classify(head, inside, parent):
    """What an opening brace after `head` (the text since the last boundary) opens."""
    text = re.sub(r"\b(?:public|private|protected)\s*:(?!:)", " ", head).strip()
    if inside:
        if not text:
            return "init" if parent == "init" else "block"
        if SIGNATURE_END.search(text) or LAMBDA_END.search(text) or BLOCK_WORD.search(text) or text.endswith(":"):
            return "block"
        if TYPE_HEAD.match(text):
            return "block"
        return "init"
    if parent == "init" and not text:
        return "init"
    if re.match(r"^(?:inline\s+)?namespace\b", text) or re.match(r"^extern\s+0\s*$", text):
        return "scope"
    text = re.sub(r"^(?:template\s*<[^{};]*?>\s*(?=class\b|struct\b|union\b))+", "", text)
    if TYPE_HEAD.match(text) and not SIGNATURE_END.search(text):
        return "scope"
    if is_member_initialiser(text):
        return "init"
    if SIGNATURE_END.search(text) or LAMBDA_END.search(text):
        return "function"
    return "init"


class CppScanner:
    """Walks the tokens of one file with a stack of blocks."""

    def __init__(self, source):
        self.text = strip_all(source)
        self.stack = []
        self.head = []
        self.head_line = 0
        self.parens = 0
        self.control = None  # parenthesis depth of a control statement whose body has not begun
        self.depth_problem = None
        self.found = []  # (line, text)

    def function(self):
        return next((block for block in self.stack if block.kind == "function"), None)

    def nesting(self):
        inside = False
        depth = 0
        for block in self.stack:
            depth += inside and block.kind in ("block", "virtual")
            inside = inside or block.kind == "function"
        return depth

    def push(self, kind, line):
        self.stack.append(Block(kind, line, self.parens, self.head_line or line))
        if self.function() and self.nesting() > MAX_NESTING and self.depth_problem is None:
            self.depth_problem = line
            self.found.append((line, f"nesting deeper than {MAX_NESTING}"))

    def boundary(self):
        self.head = []
        self.head_line = 0

    def pop_virtual(self):
        while self.stack and self.stack[-1].kind == "virtual" and self.stack[-1].parens >= self.parens:
            self.stack.pop()

    def open_brace(self, line):
        parent = self.stack[-1].kind if self.stack else "scope"
        kind = classify(" ".join(self.head), self.function() is not None, parent)
        self.control = None
        self.push(kind, line)
        if kind != "init":
            self.boundary()
        else:
            self.stack[-1].saved = self.head
            self.head = []

    def close_brace(self, line):
        while self.stack and self.stack[-1].kind == "virtual":
            self.stack.pop()
        if not self.stack:
            return
        block = self.stack.pop()
        self.parens = block.parens
        if block.kind == "init":
            self.head = block.saved + ["0", ")"] if is_member_initialiser(" ".join(block.saved)) else block.saved + ["0"]
            return
        if block.kind == "function":
            length = line - block.head_line + 1
            self.depth_problem = None
            if length > MAX_FUNCTION:
                self.found.append((block.head_line, f"function of {length} lines, at most {MAX_FUNCTION}"))
        self.boundary()
        self.pop_virtual()

    def begin_statement(self, token, line):
        """A token that is neither brace: opens a virtual block when it is the body of a control statement."""
        if self.control is None or self.parens != self.control:
            return
        if token == "(" or (token == "if" and self.head[-1:] == ["else"]):
            return
        self.control = None
        self.push("virtual", line)
        self.boundary()

    def scan(self):
        line = 1
        position = 0
        for match in TOKEN.finditer(self.text):
            line += self.text.count("\n", position, match.start())
            position = match.start()
            self.token(match[0], line)
        return self.found

    def token(self, token, line):
        if token == "{":
            self.open_brace(line)
            return
        if token == "}":
            self.close_brace(line)
            return
        if self.control_pending_done(token):
            self.begin_statement(token, line)
        if token == "(":
            self.parens += 1
        elif token == ")":
            self.parens -= 1
        if token == ";" and not self.in_parens():
            self.pop_virtual()
            self.control = None
            self.boundary()
            return
        if not self.head:
            self.head_line = line
        self.head.append(token)
        if self.function() and CONTROL.fullmatch(token):
            self.control = self.parens

    def control_pending_done(self, token):
        """Whether the condition of a pending control statement, if it has one, is complete."""
        if self.control is None:
            return False
        last = self.head[-1] if self.head else ""
        return last in ("else", "do") or (last == ")" and self.parens == self.control)

    def in_parens(self):
        base = self.stack[-1].parens if self.stack else 0
        return self.parens > base


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
DEEP = "if (a) { for (;;) { while (b) { switch (c) { case 1: { x(); } } } } }"
BAD = {
    "long function": (".cpp", f"int f() {{\n{LONG}}}\n"),
    "long constructor": (".cpp", f"X::X(int a) : a_(a), b_{{1}} {{\n{LONG}}}\n"),
    "long method after access specifier": (".h", f"class X {{\n public:\n  void f() const {{\n{LONG}}}\n}};\n"),
    "long template": (".h", f"template <class T>\n  requires std::integral<T>\nT f(T x) {{\n{LONG}}}\n"),
    "long function with trailing return": (".cpp", f"auto f() -> std::vector<int> {{\n{LONG}}}\n"),
    "long lambda counts in its function": (".cpp", f"void f() {{\n g([&](int x) {{\n{LONG}}});\n}}\n"),
    "long lambda at namespace scope": (".cpp", f"const auto f = [](int x) {{\n{LONG}}};\n"),
    "long operator": (".cpp", f"bool operator()(int x) {{\n{LONG}}}\n"),
    "long test": (".cpp", f"TEST(A, B) {{\n{LONG}}}\n"),
    "deep blocks": (".cpp", f"void f() {{ {DEEP} }}"),
    "deep without braces": (".cpp", "void f() { if (a) for (;;) while (b) if (c) for (;;) x(); }"),
    "deep through a lambda": (".cpp", "void f() { g([&] { if (a) { for (;;) { while (b) { if (c) { x(); } } } } }); }"),
    "deep after strings with braces": (".cpp", 'void f() { s = "}}"; t = R"(}})"; c = \'}\'; ' + DEEP + " }"),
    "long file": (".cpp", "int x;\n" * 801),
    "long python": (".py", "def f():\n" + "    x = 1\n" * 60),
    "deep python": (".py", "def f():\n if a:\n  for b in c:\n   while d:\n    with e:\n     if g:\n      pass\n"),
}
GOOD = {
    "60 lines": (".cpp", "int f() {\n" + "  x += 1;\n" * 58 + "}\n"),
    "four levels": (".cpp", "void f() { if (a) { for (;;) { while (b) { if (c) { x(); } } } } }"),
    "initialisers do not nest": (".cpp", "void f() { if (a) { g({{{{1, 2}}}}, X{Y{Z{1}}}); } }"),
    "else if does not nest": (".cpp", "void f() { if (a) { } else if (b) { } else if (c) { } else if (d) { } "
                              "else if (e) { } else { x(); } }"),
    "unbraced statements in a row": (".cpp", "void f() { if (a) x(); if (b) x(); if (c) x(); if (d) x(); if (e) x(); }"),
    "long class of short functions": (".h", "struct X {\n" + "  int f() { return 1; }\n" * 100 + "};\n"),
    "long namespace": (".cpp", "namespace a {\n" + "int x;\n" * 100 + "}\n"),
    "long table": (".cpp", "const int t[] = {\n" + "  1,\n" * 100 + "};\nstd::vector<X> v{\n" + " {1, 2},\n" * 99 + "};\n"),
    "macro and comment": (".cpp", "#define F(x) { { { { { {\n// { { { {\n/* { { { */ int f() { return 1; }\n"),
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
