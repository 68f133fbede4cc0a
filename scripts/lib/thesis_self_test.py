"""Checks of what the report does with results that are made up: no solver takes part."""
import json

from lib.path_curves import path_pieces
from lib.thesis_data import as_printed, percent, pick, value_of
from lib.thesis_errata import POLYGON, factor_giving, polygon

ROW = {"mesh": {"accuracy": 1e-6}, "k": 1e5, "/critical_points/0/type": "limit_max", "/critical_points/0/load_factor": 3.0,
       "/critical_points/0/error_estimate": 1e-8, "/critical_points/1/type": "limit_max", "/critical_points/1/load_factor": 2.0}
COARSE = {"mesh": {"elements": 40, "order": 1}, "k": 1e5, "/critical_points/0/type": "limit_max", "/critical_points/0/load_factor": 4.0}
REFERENCE = {"key": "k", "value": "1e5", "what": "limit_max"}
# stable up to a maximum between the second and the third step, unstable from there on
PATH = {"branches": [{"arc_length": [0, 1, 2, 3], "load_factor": [0, 1, 1, 0], "negative_eigenvalues": [0, 0, 1, 1],
                      "monitors": {"m": [0, 1, 2, 3]}}],
        "critical_points": [{"branch": 0, "arc_length": 1.5, "load_factor": 1.2, "monitors": {"m": 1.5}, "negative_after": 1}]}


def near(ours, exact):
    return all(abs(a - b) < 1e-12 for a, b in zip(ours, exact, strict=True))


def self_test():
    """Names of what is wrong; empty when all is well."""
    committed = json.loads(POLYGON.read_text(encoding="utf-8"))
    fine_elements = COARSE | {"mesh": {"elements": 20, "order": 3, "foundation": "lumped"}}
    stable, unstable = path_pieces(PATH, lambda monitors: monitors["m"])
    checks = {
        "first maximum with its estimate": value_of(ROW, "limit_max") == (3.0, 1e-8),
        "second maximum": value_of(ROW, "limit_max 2")[0] == 2.0,
        "no third maximum": value_of(ROW, "limit_max 3") is None,
        "no minimum": value_of(ROW, "limit_min") is None,
        "converged row": pick([COARSE, ROW], REFERENCE, False) == (ROW, (3.0, 1e-8)),
        "row on the thesis' mesh": pick([COARSE, ROW], REFERENCE, True)[1][0] == 4.0,
        "elements of order 3 may be the thesis' mesh": pick([ROW, fine_elements], REFERENCE, True)[0] == fine_elements,
        "the committed polygon is the one that is refined": polygon(committed, 10) == committed,
        "a polygon of 20 has 19 springs": len(polygon(committed, 20)["model"]["springs"]) == 19,
        "load 4 of k^2": near(factor_giving([(1, 1.0), (4, 16.0)], 4.0), (2.0, 2.0)),
        "no row of another stiffness": pick([COARSE, ROW], REFERENCE | {"value": "1e6"}, False) == (None, None),
        "digits of the source are kept": (as_printed("80.904"), as_printed("93.1178142194")) == ("80.904", "93.117814"),
        "difference in per cent": (percent(101.0, "100"), percent(None, "100"), percent(1.0, "")) == ("+1.00", "", ""),
        "a path is cut at its maximum": stable == [[(0, 0), (1, 1), (1.5, 1.2)]],
        "it is unstable from there on": unstable == [[(1.5, 1.2), (2, 1), (3, 0)]],
    }
    return [name for name, right in checks.items() if not right]
