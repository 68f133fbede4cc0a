#!/usr/bin/env python3
"""Checks two habits of writing that make a line hard to read.

  check_words.py [FILE...]    default: C++ of solver, api and server, and the documents; exit status 1 names the lines
  check_words.py --self-test  checks the checker

opening   A C++ comment does not begin with one of the words of OPENINGS: what it says has no subject then, or a pronoun without
          its noun. A comment is a /* */, a // behind code, or consecutive lines of one marker (//, ///, ///<) and nothing else; only
          its first words count. A comment alone on its line below one behind code continues that one if the marker is the same.
width     A line of a document has at most 120 columns. Rows of tables, code between fences and lines that are one word
          (a long address) cannot be wrapped and are not counted.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.cpp_text import comments  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
CODE = ("solver", "api", "server")
DOCUMENTS = ("*.md", "docs/**/*.md", "examples/**/*.md", "solver/*.md", "server/*.md", "bench/*.md", "clients/*/*.md",
             "tests/*/*.md", "web/src/*/*.md")
WIDTH = 120

OPENINGS = ("of", "the same", "as", "those", "it")
OPENING = re.compile(rf"(?:{'|'.join(OPENINGS)})\b", re.IGNORECASE)
LINE_COMMENT = re.compile(r"///?!?<?")
BLOCK_COMMENT = re.compile(r"/\*[*!]?<?")
FENCE = re.compile(r" {0,3}(```|~~~)")


def wrong_openings(source):
    """(line, text) of each comment that begins with one of OPENINGS."""
    lines = source.split("\n")
    above = (0, "")  # line and marker of the comment before
    for number, column, text in comments(source):
        marker = (LINE_COMMENT if text.startswith("//") else BLOCK_COMMENT).match(text)[0]
        alone = not lines[number - 1][:column].strip()
        continues = alone and text.startswith("//") and above == (number - 1, marker.rstrip("<"))
        above = (number, marker.rstrip("<"))
        words = re.sub(r"^[\s*]*(?:@brief\s+)?", "", text[len(marker):])
        found = None if continues else OPENING.match(words)
        if found:
            yield number, f"a comment begins with '{found[0]}'"


def wide_lines(text):
    """(line, text) of each line that is wider than WIDTH and could be wrapped."""
    fence = None
    for number, line in enumerate(text.split("\n"), 1):
        mark = FENCE.match(line)
        if mark and fence in (None, mark[1]):
            fence = None if fence else mark[1]
        elif fence is None and len(line) > WIDTH and not line.lstrip().startswith("|") and " " in line.strip():
            yield number, f"{len(line)} columns, more than {WIDTH}"


def check(root, path):
    """Prints what is wrong in one file; how many lines."""
    text = path.read_text(encoding="utf-8")
    rule, found = ("width", wide_lines(text)) if path.suffix == ".md" else ("opening", wrong_openings(text))
    wrong = [f"{path.relative_to(root)}:{number}: {rule}: {what}" for number, what in found]
    for line in wrong:
        print(line)
    return len(wrong)


def self_test():
    code = ["// of a member", "int a;  ///< The same", "/* As given */", "/// @brief Those", "/**\n * It ends\n */",
            "int b;  // first\nint c;  // of c", "/// First\n// of", "int x;  ///<  it"]
    for source in code:
        assert len(list(wrong_openings(source))) == 1, source
    for source in ["// Load factor\n// of a member", "int a;  ///< first\n        ///< of it", "// offset", "// Items",
                   'auto s = "// of";', "// Asks", "// The sameness", "int a;  // x\n        // of a", "// see [1]\n//\n// as"]:
        assert not list(wrong_openings(source)), source
    assert [line for line, _ in wrong_openings("int a;\n\n  // of a\n  int b;  /* it */\n")] == [3, 4]

    wide = "word " * 25
    assert [line for line, _ in wide_lines(f"a\n{wide}\n- {wide}")] == [2, 3]
    assert [line for line, _ in wide_lines(f"```\n{wide}\n```\n{wide}")] == [4]
    assert not list(wide_lines(f"| {wide} |\n{'w' * 130}\n~~~ sh\n{wide}\n```\n{wide}\n~~~\n{'w' * 60} {'w' * 59}"))
    print("check_words: self-test passed")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    paths = [pathlib.Path(name).resolve() for name in sys.argv[1:]]
    if not paths:
        paths = [path for folder in CODE for end in ("h", "cpp") for path in sorted((ROOT / folder).rglob(f"*.{end}"))]
        paths += sorted({path for pattern in DOCUMENTS for path in ROOT.glob(pattern)
                         if not {"node_modules", "build"} & set(path.parts)})
    found = sum(check(ROOT, path) for path in paths)
    print(f"check_words: {len(paths)} files, {found} lines")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
