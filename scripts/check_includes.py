#!/usr/bin/env python3
"""Checks that dependencies point one way: solver <- api <- server and clients, the folders of each of the first three from the
ground up, which libraries each layer sees, and that the solver's installed headers include installed ones alone.

  check_includes.py              exit status 1 names the includes that are not allowed
  check_includes.py --self-test  checks the checker
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.cpp_text import strip_comments  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'^[ \t]*#[ \t]*(?:include|include_next|import)\b[ \t]*([<"][^>"]*[>"]|\S+)?', re.MULTILINE)

# The standard headers that computing needs. No threads, clocks, files, streams or randomness: a result depends on
# its request alone, and the caller decides where it runs.
SOLVER_STANDARD = set("""
    algorithm any array atomic bit bitset cassert cctype cfloat charconv cinttypes climits cmath compare complex
    concepts cstddef cstdint cstdlib cstring deque exception forward_list functional initializer_list iterator
    limits list map memory memory_resource new numbers numeric optional queue ranges ratio set source_location span
    stack stdexcept stop_token string string_view system_error tuple type_traits typeindex typeinfo unordered_map
    unordered_set utility valarray variant vector version
    immintrin.h
""".split())

FORBIDDEN_SOLVER = ("thread", "chrono", "iostream", "fstream", "random", "mutex", "future", "filesystem", "ctime",
                    "cstdio", "ostream", "istream", "iomanip", "sstream", "condition_variable", "regex")
API_STANDARD = SOLVER_STANDARD | {"sstream", "iosfwd", "cstdio", "regex"}

# The folders of each layer, each above what it may include. Files beside the folders stand by their names, with their ending
# or without; "." are those that are not named. A folder in a folder that is not named stands with the folder around it.
SOLVER_ORDER = """
    numeric model result.h hooks.h resolve geometry support mesh element member discrete check column problem newton path events
    trace report sensitivity accuracy analysis sweep solve.h solve.cpp
""".split()
API_ORDER = "openapi soil . plot convert".split()
SERVER_ORDER = """
    status environment authority digest descriptor bell priority metrics log jobs store store/sqlite store/postgresql store/open_store
    worker sweeps queue neighbours maintenance resources front webhooks config key_settings settings service mcp cli main pages_main
""".split()
ORDERS = {"solver": SOLVER_ORDER, "api": API_ORDER, "server": SERVER_ORDER}


def place_of(path):
    """Where a file stands in the order of its layer; -1: nowhere."""
    layer, _, inside = path.partition("/")
    file = pathlib.PurePosixPath(inside)
    around = [folder.as_posix() for folder in file.parents]
    names = [inside, inside.removesuffix(file.suffix), *(around if len(around) == 1 else around[:-1])]
    return next((ORDERS[layer].index(name) for name in names if name in ORDERS[layer]), -1)


def points_down(path, name):
    """Whether a file includes its own folder or one below, or another layer."""
    return path.split("/")[0] != name.split("/")[0] or -1 < place_of(name) <= place_of(path)


def rows_of_readme(text):
    """Names in the first column of the table of server/README.md, which draws SERVER_ORDER."""
    rows = re.findall(r"^\| ((?:`[\w/.]+`(?:, )?)+) \|", text, re.MULTILINE)
    return [name.strip("/") for row in rows for name in re.findall(r"`([\w/.]+)`", row)]


def is_eigen(name):
    return re.fullmatch(r"(?:unsupported/)?Eigen/\w+", name) is not None


def is_json(name):
    return name in ("nlohmann/json.hpp", "nlohmann/json_fwd.hpp")


def allowed(layer, quoted, name):
    """Whether a file of that layer may include this."""
    if quoted:
        layers = {"solver": ("solver/",), "api": ("solver/", "api/"), "server": ("solver/", "api/", "server/"),
                  "clients": ("solver/", "api/", "clients/", "snapthrough.h")}
        return name.startswith(layers[layer])
    if layer == "solver":
        return name in SOLVER_STANDARD or is_eigen(name)
    if layer == "api":
        return name in API_STANDARD or is_json(name)
    if layer == "clients":
        return name in API_STANDARD | {"chrono", "stddef.h", "stdint.h", "typeinfo"} or is_json(name)
    return not is_eigen(name)


def check_source(source, layer, path=""):
    """Lines and words of what must not be there; `path` of the file from the root."""
    found = []
    text = strip_comments(source)
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        target = match[1] or ""
        if target[:1] not in ('"', "<") or not allowed(layer, target[0] == '"', target[1:-1]):
            found.append((line, f"{layer} must not include {target or 'this'}"))
        elif layer in ORDERS and target[0] == '"' and not points_down(path, target[1:-1]):
            found.append((line, f"{target} stands above {path} ({layer.upper()}_ORDER of scripts/check_includes.py)"))
    return found


def installed_headers(cmake):
    """Paths of the headers that solver/CMakeLists.txt installs, from the root."""
    files = re.search(r"FILE_SET HEADERS[^)]*?\bFILES\s+([^)]*)\)", cmake)
    return {f"solver/{name}" for name in files[1].split()}


def missing_when_installed(source, installed):
    """Headers that an installed one includes and that are not installed themselves."""
    names = (match[1] or "" for match in INCLUDE.finditer(strip_comments(source)))
    return [name for name in names if name.startswith('"') and name[1:-1] not in installed]


# where the snippets of each layer stand
SNIPPETS = {"solver": "solver/path/x.cpp", "api": "api/value.cpp", "server": "server/store/sqlite/x.cpp", "clients": ""}
GOOD = [
    ("solver", "#include <vector>\n#include <Eigen/Core>\n#include <stop_token>\n#include \"solver/model/model.h\"\n"),
    ("solver", "#include \"solver/path/x.h\"\n#include \"solver/newton/corrector.h\"\n#include \"solver/result.h\"\n"),
    ("solver", "// #include <thread>\n/* #include <iostream> */\n"),
    ("api", "#include <nlohmann/json.hpp>\n#include \"api/api.h\"\n#include \"solver/solve.h\"\n"),
    ("api", "#include \"api/openapi/embedded.h\"\n#include \"api/names.h\"\n"),
    ("server", "#include <sqlite3.h>\n#include <thread>\n#include \"server/status.h\"\n#include \"api/plot/figure.h\"\n"),
    ("server", "#include \"server/store/sqlite/parts.h\"\n#include \"server/store/store.h\"\n#include \"server/jobs/job.h\"\n"),
]
BAD = [("solver", f"#include <{name}>") for name in FORBIDDEN_SOLVER] + [
    ("solver", "#include <nlohmann/json.hpp>"),
    ("solver", "#include <nlohmann/json_fwd.hpp>"),
    ("solver", "#include \"api/api.h\""),
    ("solver", "#include \"server/status.h\""),
    ("solver", "#include \"../api/api.h\""),
    ("solver", "#include \"solver/solve.h\""),
    ("solver", "#include \"solver/trace/trace.h\""),
    ("solver", "#include \"solver/nowhere/x.h\""),
    ("solver", "#include HEADER"),
    ("solver", "  #  include <thread>"),
    ("solver", "/* comment */ \n#include <spdlog/spdlog.h>"),
    ("api", "#include <httplib.h>"),
    ("api", "#include <sqlite3.h>"),
    ("api", "#include <Eigen/Core>"),
    ("api", "#include <fstream>"),
    ("api", "#include \"server/status.h\""),
    ("api", "#include \"api/plot/figure.h\""),
    ("server", "#include \"server/store/postgresql/parts.h\""),
    ("server", "#include \"server/store/open_store.h\""),
    ("server", "#include \"server/sweeps/sweep_work.h\""),
    ("server", "#include \"server/service.h\""),
    ("server", "#include \"server/nowhere/x.h\""),
    ("server", "#include \"server/nowhere.h\""),
    ("clients", "#include \"server/status.h\""),
    ("clients", "#include <thread>"),
    ("server", "#include <Eigen/Dense>"),
    ("server", "#include \"tests/server/x.h\""),
]


def self_test():
    wrong = [f"not found: {layer}: {source}" for layer, source in BAD if not check_source(source, layer, SNIPPETS[layer])]
    wrong += [f"{layer}: {text}" for layer, source in GOOD for _, text in check_source(source, layer, SNIPPETS[layer])]
    if rows_of_readme("| `a`, `b/` | text |\n| `c/d/` | `e` |\n") != ["a", "b", "c/d"]:
        wrong.append("the table of a README is not read")
    installed = installed_headers("target_sources(x PUBLIC FILE_SET HEADERS BASE_DIRS ${D}\n  FILES a.h b/c.h\n  d.h)\n")
    if installed != {"solver/a.h", "solver/b/c.h", "solver/d.h"}:
        wrong.append("the installed headers are not read")
    if missing_when_installed('#include <vector>\n#include "solver/a.h"\n#include "solver/b/x.h"\n', installed) != ['"solver/b/x.h"']:
        wrong.append("a header that is not installed is not found")
    print("\n".join(wrong) if wrong else f"check_includes: self-test of {len(BAD) + len(GOOD)} snippets passed")
    return 1 if wrong else 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    offenders = 0
    files = 0
    for layer in ("solver", "api", "server", "clients"):
        for path in sorted((ROOT / layer).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            files += 1
            place = path.relative_to(ROOT).as_posix()
            for line, text in check_source(path.read_text(encoding="utf-8"), layer, place):
                offenders += 1
                print(f"{place}:{line}: {text}")
    installed = installed_headers((ROOT / "solver/CMakeLists.txt").read_text(encoding="utf-8"))
    for place in sorted(installed):
        for name in missing_when_installed((ROOT / place).read_text(encoding="utf-8"), installed):
            offenders += 1
            print(f"{place}: {name} is not installed, and this header is (FILES of solver/CMakeLists.txt)")
    if rows_of_readme((ROOT / "server/README.md").read_text(encoding="utf-8")) != SERVER_ORDER:
        offenders += 1
        print("server/README.md: the rows of its table are not those of SERVER_ORDER")
    print(f"check_includes: {files} files, {offenders} includes that are not allowed")
    return 1 if offenders else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
