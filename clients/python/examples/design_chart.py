#!/usr/bin/env python3
"""A design chart of a buried pipe: the pressure at which it loses stability, by the soil and by the wall's thickness.

  design_chart.py [table.csv]

Prints the chart as a table of numbers; standard library only. buried_pipe.ipynb goes the same way with drawings.
"""
import sys
from typing import Dict, List

import snapthrough as st

YOUNG = 8e5  # kN/m2, polyethylene over a long time
RADIUS = 0.5  # m
PRESSURE = 10.0  # kN/m2 of load factor 1, from above


def pipe(thickness: float, soil: float) -> st.Model:
    """A pipe of 1 m length in soil that can only push; thickness in m, modulus of the soil in kN/m3."""
    model = (st.Model("Buried pipe", units={"length": "m", "force": "kN"})
             .node("invert", 0, -RADIUS).node("crown", 0, RADIUS)
             .section("wall", EA=YOUNG * thickness, EI=YOUNG * thickness ** 3 / 12)
             .arc_member("right", "invert", "crown", "wall", 180)
             .arc_member("left", "crown", "invert", "wall", 180)
             .support("invert", ["x"])
             .monitor("crown", "crown", "y"))
    for side in ("right", "left"):
        half = (0.5, 1.0) if side == "right" else (0.0, 0.5)
        model.foundation("soil " + side, side, soil, reaction="compression_only", side="right")
        model.distributed_load(side, [0, -PRESSURE], per="horizontal", range=half)
    return model


def chart(thicknesses: List[float], count: int) -> st.Sweep:
    """The critical pressure for each thickness, over moduli of the soil from 1 to 50 MN/m3."""
    sweep = st.Sweep(pipe(0.02, 20000), st.Critical(), "grid",
                     ["/summary/critical_load_factor", "/summary/critical_type"])
    sweep.parameter("thickness", [{"pointer": "/model/sections/0/EA", "scale": YOUNG},
                                  {"pointer": "/model/sections/0/EI", "scale": YOUNG / 12, "power": 3}],
                    values=thicknesses)
    sweep.parameter("soil", ["/model/foundations/0/stiffness", "/model/foundations/1/stiffness"],
                    range={"from": 1000, "to": 50000, "count": count, "spacing": "log"})
    return sweep


def main() -> int:
    """Computes the chart and prints it."""
    table = st.sweep(chart([0.015, 0.02, 0.025], 9)).table()
    if len(sys.argv) > 1:
        table.to_csv(sys.argv[1])
    pressures: Dict[float, List[str]] = {}
    for row in table:
        factor = row["/summary/critical_load_factor"]
        text = "-" if factor is None else f"{factor * PRESSURE:8.1f}"
        pressures.setdefault(row["soil"], []).append(text)
    print("soil kN/m3   critical pressure kN/m2 for walls of 15, 20 and 25 mm")
    for soil, texts in pressures.items():
        print(f"{soil:10.0f} ", " ".join(texts))
    return 3 if table.failed else 0


if __name__ == "__main__":
    sys.exit(main())
