#!/usr/bin/env python3
"""Guards the cost of solving by ratios that do not depend on the machine: instructions, counted by callgrind,
and memory by unknown.

  check_costs.py BENCH_PROBE              exit status 1 when a ratio is over its bound
"""
import math
import os
import re
import subprocess
import sys
import tempfile

# (case, most instructions at accuracy 1e-6 over those at 1e-3): smooth cases, then with contact
ACCURACY = [("shallow_arch", 4.0), ("deep_arch", 4.0), ("frame", 4.0), ("shallow_arch_k1e7", 8.0),
            ("ring_k1200", 8.0)]
# (case, other case, most instructions of the first over the second): what one-sided contact may cost, and a
# column that needs no mesh
RATIOS = [("shallow_arch_k1e7", "deep_arch", 2.0), ("column_with_spring", "deep_arch", 0.03)]
# (case, most instructions with three frequencies at each point of its path over those without)
FREQUENCIES = [("shallow_arch", 2.1), ("shallow_arch_k1e7", 2.1), ("ring_k1200", 2.1), ("frame", 3.7)]
# (what grows, two sizes, most power of the unknowns by which the instructions grow). A square frame has a front that
# grows.
GROWTH = [("elements", (100, 3000), 1.05), ("bays", (30, 300), 1.05), ("square", (30, 300), 1.4),
          ("bases", (30, 300), 1.05), ("springs", (30, 300), 1.05)]
MEMORY = (5000, 15000)  # elements
# (case, most bytes by unknown): grow:elements has three unknowns each element to share what an element costs
# order 1 has two soft motions of four numbers an unknown at both ends of a step; a path keeps displacements and tangents of up
# to 32 points, here of five
MOST_BYTES = [("grow:elements", 1700.0), ("grow:elements3", 1100.0), ("grow:elements5", 1000.0)]


def run(probe, case, argument, times, counted):
    """Output of the probe, and the instructions it took when they are counted."""
    command = [probe, case, str(argument), str(times)]
    if not counted:
        # large blocks are given back at once: else the peak has what the allocator kept of earlier ones, by chance
        environment = {**os.environ, "MALLOC_MMAP_THRESHOLD_": "131072"}
        return subprocess.run(command, capture_output=True, text=True, check=True, env=environment).stdout, 0
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "callgrind.out")
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}"] + command,
                              capture_output=True, text=True, check=True)
    return done.stdout, int(re.search(r"Collected : (\d+)", done.stderr).group(1))


def instructions(probe, case, argument):
    """Of one solve: the difference between two and one, so that starting the program does not count."""
    return run(probe, case, argument, 2, True)[1] - run(probe, case, argument, 1, True)[1]


def reported(text, name):
    return float(re.search(name + r" ([0-9.e+-]+)", text).group(1))


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    probe = sys.argv[1]
    failures = 0

    def judge(what, value, bound):
        nonlocal failures
        failures += value > bound
        print(f"{'ok  ' if value <= bound else 'OVER'} {what}: {value:.3g}, at most {bound:g}")

    at_default = {}
    for case, bound in ACCURACY:
        at_default[case] = instructions(probe, case, 1e-3)
        judge(f"{case}, accuracy 1e-6 over 1e-3", instructions(probe, case, 1e-6) / at_default[case], bound)
    for case, other, bound in RATIOS:
        for one in (case, other):
            if one not in at_default:
                at_default[one] = instructions(probe, one, 1e-3)
        judge(f"{case} over {other}", at_default[case] / at_default[other], bound)
    for case, bound in FREQUENCIES:
        with_them, without = [instructions(probe, f"{what}:{case}", 1e-3) for what in ("frequencies", "path")]
        judge(f"three frequencies along the path of {case}", with_them / without, bound)
    for part, sizes, bound in GROWTH:
        few, many = [instructions(probe, "grow:" + part, n) for n in sizes]
        less, more = [reported(run(probe, "grow:" + part, n, 1, False)[0], "unknowns") for n in sizes]
        judge(f"growth with {part}, power of the unknowns", math.log(many / few) / math.log(more / less), bound)
    for case, bound in MOST_BYTES:
        few, many = [run(probe, case, n, 1, False)[0] for n in MEMORY]
        kilobytes = reported(many, "peak_kb") - reported(few, "peak_kb")
        judge(f"{case}, bytes by unknown",
              1024.0 * kilobytes / (reported(many, "unknowns") - reported(few, "unknowns")), bound)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
