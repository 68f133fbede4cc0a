#!/usr/bin/env python3
"""Runs the recipes of docs/howto/engines.md that need an engine: Dask, MPI, Slurm.

  page.py BUILD_FOLDER [--without-slurm]

Exit status 1 names the recipe that failed. tests/test_tools.py runs the others.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[3]
PAGE = (ROOT / "docs" / "howto" / "engines.md").read_text(encoding="utf-8")
SWEEP = ROOT / "tests" / "clients" / "sweep_500.json"
SECONDS = 120


def block(language, word):
    """The block of the page that has a word."""
    found = [text for text in re.findall(rf"^```{language}\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE) if word in text]
    assert len(found) == 1, f"{len(found)} blocks of the page have {word!r}"
    return found[0]


def program(folder, word, changed=lambda text: text):
    """A recipe as a program that writes its table."""
    text = block("python", "read_text") + changed(block("python", word))
    text += "\nif __name__ == '__main__':\n    table.to_csv('table.csv')\n"
    (folder / "program.py").write_text(text, encoding="utf-8")


def dask(folder, environment):
    contact = folder / "scheduler.json"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": environment, "cwd": folder}
    commands = (["dask-scheduler", "--port", "0", "--no-dashboard"],
                ["dask-worker", "--nthreads", "2", "--no-dashboard"])
    started = [subprocess.Popen([*command, "--scheduler-file", contact], **quiet) for command in commands]
    try:
        deadline = time.monotonic() + SECONDS
        while not contact.exists() or not contact.stat().st_size:
            assert time.monotonic() < deadline, "the scheduler did not start"
            time.sleep(0.1)
        address = json.loads(contact.read_text())["address"]
        program(folder, "distributed", lambda text: text.replace("tcp://scheduler:8786", address).replace(
            "as dask:\n", "as dask:\n    dask.wait_for_workers(1)\n"))
        subprocess.run([sys.executable, "program.py"], check=True, timeout=SECONDS, env=environment, cwd=folder)
    finally:
        for process in started:
            process.terminate()
        for process in started:
            process.wait()


def mpi(folder, environment):
    program(folder, "mpi4py")
    words = block("sh", "mpiexec").split()
    more = ["--oversubscribe"] + ["--allow-run-as-root"] * (os.geteuid() == 0)
    subprocess.run([words[0], *more, *words[1:3], sys.executable, *words[4:]], check=True, timeout=SECONDS, cwd=folder,
                   env=environment)


def slurm(folder, environment):
    (folder / "clients").symlink_to(ROOT / "clients")
    text = block("sh", "sbatch").replace("table.json", "table.csv").replace("rows.* >", "rows.* --csv >")
    subprocess.run(["bash", "-ec", text], check=True, timeout=SECONDS, cwd=folder, env=environment)
    deadline = time.monotonic() + SECONDS
    while subprocess.run(["squeue", "-h"], capture_output=True, check=True, env=environment).stdout.strip():
        assert time.monotonic() < deadline, "the jobs did not end"
        time.sleep(0.5)


def main(build, without_slurm=False):
    build = pathlib.Path(build).resolve()
    environment = {**os.environ, "PYTHONPATH": str(HERE.parents[1]), "PATH": f"{build}:{os.environ['PATH']}",
                   "PYTHONSNAPTHROUGH_LIBRARY": str(build / "libsnapthrough.so.1")}
    expected = subprocess.run([build / "snapthrough", "sweep", "--csv", SWEEP], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, check=False).stdout
    for recipe in [dask, mpi] + [slurm] * (not without_slurm):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "sweep.json").write_bytes(SWEEP.read_bytes())
            recipe(folder, environment)
            if (folder / "table.csv").read_bytes() != expected:
                print(f"the recipe of {recipe.__name__} gives other rows", file=sys.stderr)
                return 1
        print(f"recipe of the page: {recipe.__name__}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:] == ["--without-slurm"]))
