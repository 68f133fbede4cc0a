#!/usr/bin/env python3
"""Counts the floating-point work that a program really executes, by function: callgrind says how often each
instruction ran, the disassembly what it does.

  count_arithmetic.py CASE [TIMES]     of build/release/bench/bench_probe CASE 1e-3

Prints, for each function: instructions, floating-point operations (a fused multiply-add on four numbers counts eight,
padding included), vector instructions that do them, bytes read and written by all instructions with 8 bytes or
more.
"""
import collections
import re
import subprocess
import sys
import tempfile

PROBE = "build/release/bench/bench_probe"
ARITHMETIC = re.compile(r"^v?(f(?:n)?m(?:add|sub)(?:\d+)?|add|sub|mul|div|sqrt|min|max)([ps])d$")
MOVES = re.compile(r"^v?(mov[au]pd|mov[au]ps|movdq[au]|movsd|movhpd|movlpd|broadcastsd|mov|movq|maskmovpd)$")


def disassembly():
    """Address: (function, operations, read bytes, written bytes)."""
    text = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", "-M", "intel", PROBE],
                          capture_output=True, text=True, check=True).stdout
    out, function = {}, ""
    for line in text.splitlines():
        if head := re.match(r"^[0-9a-f]+ <(.*)>:$", line):
            function = head.group(1)
        elif found := re.match(r"^\s+([0-9a-f]+):\s+(\S+)\s*(.*)$", line):
            out[int(found.group(1), 16)] = (function,) + work_of(found.group(2), found.group(3))
    return out


def work_of(name, operands):
    size = next((n for word, n in (("YMMWORD", 32), ("XMMWORD", 16), ("QWORD", 8)) if word in operands), 0)
    store = size and "PTR" in operands.split(",")[0] and bool(MOVES.match(name))
    read, written = (0, size) if store else (size, 0)
    found = ARITHMETIC.match(name)
    if not found:
        return 0, read, written
    lanes = 1 if found.group(2) == "s" else 4 if "ymm" in operands else 2
    return lanes * (2 if found.group(1).startswith(("fm", "fnm")) else 1), read, written


def counts(case, times):
    """Executions by address of the program's own instructions."""
    with tempfile.NamedTemporaryFile() as out:
        subprocess.run(["valgrind", "--tool=callgrind", "--dump-instr=yes", "--compress-pos=no", "--compress-strings=no",
                        f"--callgrind-out-file={out.name}", PROBE, case, "1e-3", str(times)], capture_output=True, check=True)
        runs, mine, skip = collections.Counter(), False, False
        for line in open(out.name, encoding="utf-8", errors="replace"):
            if line.startswith("ob="):
                mine = line.rstrip().endswith("bench_probe")
            elif line.startswith("calls="):
                skip = True
            elif line.startswith("0x"):
                parts = line.split()
                if mine and not skip:
                    runs[int(parts[0], 16)] += int(parts[-1])
                skip = False
    return runs


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    times = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    code = disassembly()
    total = collections.defaultdict(lambda: [0, 0, 0, 0, 0])
    for address, n in counts(sys.argv[1], times).items():
        function, operations, read, written = code.get(address, ("?", 0, 0, 0))
        for key in (re.sub(r"\(.*", "", function.replace("(anonymous namespace)::", "")), "all"):
            for i, value in enumerate((n, n * operations, n * (operations > 0), n * read, n * written)):
                total[key][i] += value
    print(f"| function | instructions | operations | instructions that do them | read, bytes | written, bytes |\n|{' --- |' * 6}")
    for name, row in sorted(total.items(), key=lambda item: -item[1][1])[:18]:
        print(f"| {name.replace('snapthrough::', '')} | " + " | ".join(f"{value / times:.4g}" for value in row) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
