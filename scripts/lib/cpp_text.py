"""C++ source text with comments, literals and preprocessor lines blanked out, line by line as before."""
import re

_TOKEN = re.compile(
    r"""
    (?P<line_comment>//(?:\\\n|[^\n])*)
  | (?P<block_comment>/\*.*?\*/)
  | (?P<raw>\b(?:u8|[uUL])?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)")
  | (?P<string>(?:\b(?:u8|[uUL]))?"(?:\\.|[^"\\\n])*")
  | (?P<number>\b\d(?:'?[\w.])*)
  | (?P<char>(?:\b(?:u8|[uUL]))?'(?:\\.|[^'\\\n])+')
  | (?P<word>\w+)
    """,
    re.VERBOSE | re.DOTALL,
)
_DIRECTIVE = re.compile(r"^[ \t]*#(?:\\\n|[^\n])*", re.MULTILINE)


def _blank(text):
    return re.sub(r"[^\n]", " ", text)


def comments(source):
    """(line from 1, column from 0, text) of each comment, in order."""
    for match in _TOKEN.finditer(source):
        if match["line_comment"] or match["block_comment"]:
            begin = match.start()
            yield source.count("\n", 0, begin) + 1, begin - source.rfind("\n", 0, begin) - 1, match[0]


def strip_comments(source):
    """Blanks comments only; literals stay."""

    def replace(match):
        return _blank(match[0]) if match["line_comment"] or match["block_comment"] else match[0]

    return _TOKEN.sub(replace, source)


def strip_all(source):
    """Blanks comments and preprocessor lines; a literal becomes 0 followed by blanks."""

    def replace(match):
        if match["line_comment"] or match["block_comment"]:
            return _blank(match[0])
        if match["raw"] or match["string"] or match["char"]:
            return "0" + _blank(match[0][1:])
        return match[0]

    return _DIRECTIVE.sub(lambda match: _blank(match[0]), _TOKEN.sub(replace, source))
