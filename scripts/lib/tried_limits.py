"""The solver's limits as values that a program reads when it starts: a copy of the sources, for scripts/try_limits.py.

A limit is a number that the solver's sources name: `static constexpr double closing = 0.1;`. It is constexpr in the program, so
that trying costs the program nothing. In the copy it is a constant that the environment variable TRIED_LIMIT can name and
TRIED_FACTOR multiplies. Numbers that are sizes of arrays or template arguments stay as they are.
"""
import re
import shutil

# bounds of requests, which documents promise
PROMISED = "model/limits.h"
DECLARATION = re.compile(
    r"\b(?P<lead>static|inline) constexpr (?P<type>double|int|std::size_t|Eigen::Index|Index|long long) (?P<name>\w+)\s*"
    r"(?:=\s*(?P<value>[^;]*)|\{(?P<braced>[^;]*)\})\s*;")
OWNER = re.compile(r"\b(?:struct|class) (\w+)[^;{]*\{")
SIZES = re.compile(r"\b(?:array|Matrix|Array|integral_constant|make_integer_sequence|backward_row|forward_row)<([^;{}]*?)>")
READER = """#pragma once
#include <cstddef>
#include <cstdlib>
#include <cstring>

template <class T>
T tried_limit(const char* name, T value) {
  const char* tried = std::getenv("TRIED_LIMIT");
  if (tried == nullptr || std::strcmp(tried, name) != 0) return value;
  return static_cast<T>(static_cast<double>(value) * std::strtod(std::getenv("TRIED_FACTOR"), nullptr));
}
"""


def code_of(text):
    return re.sub(r"//.*", "", text)


def sizes_of(sources):
    """Names that stand where C++ wants a constant expression."""
    names = set()
    for text in sources:
        code = code_of(text)
        for arguments in SIZES.findall(code):
            names |= set(re.findall(r"\b[A-Za-z_]\w*\b", arguments))
        # constants of other constants' sizes: static constexpr int kRows = N + kSides
        for sum_of in re.findall(r"constexpr int k\w+ = ([^;]*);", code):
            names |= set(re.findall(r"\bk[A-Z]\w*\b", sum_of))
    return names


def tried(text, path, sizes):
    """(text whose limits can be tried, [(name, value as written)])."""
    limits = []

    def replaced(match):
        if match["name"] in sizes:
            return match[0]
        owners = OWNER.findall(text, 0, match.start())
        value = " ".join((match["value"] or match["braced"]).split())
        name = f"{path} {owners[-1] if owners else ''}::{match['name']}"
        if any(name == other for other, _ in limits):
            name += f" {text.count(chr(10), 0, match.start()) + 1}"
        limits.append((name, value))
        lead = "static inline" if match["lead"] == "static" else "inline"
        return f'{lead} const {match["type"]} {match["name"]} = tried_limit<{match["type"]}>("{name}", {value});'

    copied = DECLARATION.sub(replaced, text)
    # constants that are computed from limits cannot be constexpr either
    copied = re.sub(r"^( +)constexpr ((?:double|int|std::size_t) \w+ = \w+::)", r"\1const \2", copied, flags=re.MULTILINE)
    return copied.replace("static constexpr ChosenMesh", "static inline const ChosenMesh"), limits


def copy_with_tried_limits(root, copy):
    """Copies what libsnapthrough is built from to the folder `copy`. Returns [(name, value)] of the limits, in order of paths."""
    for part in ("solver", "api", "clients/c", "clients/python"):
        shutil.copytree(root / part, copy / part, ignore=shutil.ignore_patterns("__pycache__", "node_modules"))
    for part in ("CMakeLists.txt", "LICENSE"):
        shutil.copy(root / part, copy / part)
    (copy / "tried_limit.h").write_text(READER)
    sources = sorted(path for path in (copy / "solver").rglob("*") if path.suffix in (".h", ".cpp"))
    sizes = sizes_of(path.read_text() for path in sources)
    found = []
    for path in sources:
        name = path.relative_to(copy / "solver").as_posix()
        if name == PROMISED:
            continue
        text, limits = tried(path.read_text(), name, sizes)
        if limits:
            path.write_text(text)
            found += limits
    return found
