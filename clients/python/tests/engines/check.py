#!/usr/bin/env python3
"""A sweep by every engine of docs/howto/engines.md: the same bytes from each, also where workers are killed on the way.

  check.py BUILD_FOLDER [POINTS] [--engine NAME]... [--without NAME]...

The default is 20 000 points of about 1 ms: buckling loads of columns drawn at random. Prints a table: wall time and the
speed-up over one process; processor time of all processes that take part, that of the library's calls alone, and the
difference for each point, which is what the engine costs. Measured from when the workers of an engine are there, and
with their start where a pool is replaced. What Dask's processes take without work, which is told, is left out of what
a point costs. For the executable the command line's sweep takes the place of the calls.
Engines that are not installed are named and fail the run. Exit status 1: rows differ, or an engine is missing.
"""
import argparse
import json
import multiprocessing
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from unittest import mock

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[3]
sys.path.insert(0, str(HERE.parents[1]))

import snapthrough  # noqa: E402
from snapthrough import _chunks, _engine, engines  # noqa: E402

TICK = os.sysconf("SC_CLK_TCK")


def processes_below(root):
    """Process ids of a process and of all that it started."""
    parents = {}
    for folder in pathlib.Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                fields = (folder / "stat").read_text().rsplit(")", 1)[1].split()
            except OSError:
                continue
            parents.setdefault(int(fields[1]), []).append(int(folder.name))
    found, waiting = [], [root]
    while waiting:
        found.append(waiting.pop())
        waiting += parents.get(found[-1], [])
    return found


def processor_seconds():
    """Of this process and its descendants, those that ended included."""
    total = 0
    for process in processes_below(os.getpid()):
        try:
            fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        total += sum(map(int, fields[11:15]))
    return total / TICK


class Killer:
    """Kills a process with signal 9 when some rows are there; a progress callback."""

    def __init__(self, rows, victim):
        self.rows, self.victim, self.killed = rows, victim, None

    def __call__(self, progress):
        if self.killed is None and progress.done >= self.rows:
            self.killed = self.victim()
            os.kill(self.killed, signal.SIGKILL)


class Engines:
    """Each method computes the sweep and gives its table as JSON text."""

    def __init__(self, build, points):
        self.build = build
        self.executable = str(build / "snapthrough")
        self.library = str(build / "libsnapthrough.so.1")
        document = json.loads((ROOT / "examples" / "sweeps" / "column_random.json").read_text(encoding="utf-8"))
        document["design"]["latin_hypercube"]["samples"] = points
        document["analysis"]["discretization"]["elements"] = 24
        self.points = points
        self.begun = self.ended = None
        self.calls = self.idle = 0.0
        self.text = json.dumps(document)
        self.local = snapthrough.Local(self.library)
        self.folder = tempfile.mkdtemp()
        self.environment = {**os.environ, "PYTHONPATH": str(HERE.parents[1]), "PYTHONSNAPTHROUGH_LIBRARY": self.library,
                            "PATH": f"{build}:{os.environ['PATH']}"}
        self.path = os.path.join(self.folder, "sweep.json")
        pathlib.Path(self.path).write_text(self.text, encoding="utf-8")

    def command_line(self, threads=2):
        return subprocess.run([self.executable, "sweep", self.path, "--threads", str(threads)], check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout

    def one_process(self):
        return self.sweep(workers=1)

    def threads(self):
        return self.sweep(workers=2)

    def begin(self, executor):
        """Has workers import what they need; what is measured begins here."""
        list(executor.map(time.sleep, [0.5] * 2))
        list(executor.map(_chunks.compute_chunk, [self.text.encode("utf-8")] * 8, [self.library] * 8, [0] * 8, [0] * 8))
        self.begun = (processor_seconds(), time.perf_counter())
        return executor

    def process_pool(self):
        with engines.processes(2)() as executor:
            return self.sweep(executor=self.begin(executor))

    def process_pool_with_one_killed(self):
        killer = Killer(self.points // 4, lambda: multiprocessing.active_children()[0].pid)
        text = self.sweep(executor=engines.processes(2), on_progress=killer)
        assert killer.killed, "no process was killed"
        return text

    def joblib(self):
        with engines.joblib_workers(2)() as executor:
            return self.sweep(executor=self.begin(executor), workers=2)

    def dask_with_one_killed(self):
        return self.dask(kill=True)

    def dask(self, kill=False):
        """A scheduler and two workers, as on a cluster; none of them is started again when it dies."""
        from distributed import Client
        contact = os.path.join(self.folder, f"scheduler{kill}.json")
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": self.environment,
                 "cwd": self.folder}
        started = [subprocess.Popen(["dask-scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", contact],
                                    **quiet)]
        started += [subprocess.Popen(["dask-worker", "--scheduler-file", contact, "--nthreads", "1", "--no-nanny",
                                      "--no-dashboard"], **quiet) for _ in range(2)]
        try:
            with Client(scheduler_file=contact, timeout=60) as client:
                client.wait_for_workers(2, timeout=60)
                killer = Killer(self.points // 4, lambda: started[-1].pid)
                executor = self.begin(client.get_executor())
                cpu = processor_seconds()
                time.sleep(5)
                self.idle = (processor_seconds() - cpu) / 5
                self.begun = (processor_seconds(), time.perf_counter())
                text = self.sweep(executor=executor, workers=2, on_progress=killer if kill else None)
                assert not kill or killer.killed, "no worker was killed"
                return text
        finally:
            for process in started:
                process.terminate()
            for process in started:
                process.wait()

    def mpi(self):
        out = os.path.join(self.folder, "mpi.json")
        as_root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        subprocess.run(["mpiexec", *as_root, "--oversubscribe", "-n", "3", sys.executable, "-m", "mpi4py.futures",
                        str(HERE / "with_mpi.py"), self.path, out], check=True, env=self.environment)
        self.begun = (0.0, time.perf_counter() - float(pathlib.Path(out + ".seconds").read_text()))
        return pathlib.Path(out).read_text(encoding="utf-8")

    def job_array(self):
        """The script of a job array, two tasks at a time with the variables set by hand."""
        rows = os.path.join(self.folder, "rows")
        script = str(ROOT / "clients" / "batch" / "sweep_array.sh")
        tasks = [subprocess.Popen([script, self.path, rows, "2"], stderr=subprocess.DEVNULL,
                                  env={**self.environment, "SLURM_ARRAY_TASK_ID": str(part)}) for part in (1, 2)]
        for task in tasks:
            assert task.wait() == 0, "a part failed"
        return self.merge(rows)

    def job_array_with_one_killed(self):
        """Merging names the part that died; the same command goes on with it."""
        rows = os.path.join(self.folder, "rows_killed")
        arguments = [self.executable, "sweep", self.path, "--threads", "1"]
        parts = [arguments + ["--part", f"{part}/2", "--out", f"{rows}.{part}"] for part in (1, 2)]
        tasks = [subprocess.Popen(part, stderr=subprocess.DEVNULL) for part in parts]
        while not os.path.exists(rows + ".2") or pathlib.Path(rows + ".2").stat().st_size < 20 * self.points:
            time.sleep(0.05)
            assert tasks[1].poll() is None, "the part ended before it could be killed"
        tasks[1].kill()
        for task in tasks:
            task.wait()
        told = subprocess.run([self.executable, "merge", rows + ".1", rows + ".2"], capture_output=True, text=True)
        assert told.returncode == 1 and "--part 2/2" in told.stderr, told.stderr
        subprocess.run(parts[1], stderr=subprocess.DEVNULL, check=True)
        return self.merge(rows)

    def slurm(self):
        """A job array of Slurm, whose configuration scripts/engines_test.sh names in SLURM_CONF."""
        rows = os.path.join(self.folder, "rows_slurm")
        script = str(ROOT / "clients" / "batch" / "sweep_array.sh")
        done = subprocess.run(["sbatch", "--wait", "--array=1-4", "-o", self.folder + "/slurm.%a", script, self.path,
                               rows, "4"], env=self.environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return self.merge(rows)

    def merge(self, rows):
        parts = sorted(str(path) for path in pathlib.Path(rows).parent.glob(os.path.basename(rows) + ".*"))
        return subprocess.run([self.executable, "merge", *parts], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True, check=False).stdout

    def sweep(self, **options):
        """The sweep by the package; adds up the processor time of the library's calls, which workers tell."""
        self.calls = 0.0
        learn = _engine.Engine._learn

        def add(engine, chunk, seconds):
            self.calls += seconds
            learn(engine, chunk, seconds)

        with mock.patch.object(_engine.Engine, "_learn", add):
            text = self.local.sweep(self.text, **options).table().to_json()
        self.ended = (processor_seconds(), time.perf_counter())
        return text


NAMES = ("command_line", "one_process", "threads", "process_pool", "process_pool_with_one_killed", "joblib", "dask",
         "dask_with_one_killed", "mpi", "job_array", "job_array_with_one_killed", "slurm")
# Their workers wait by asking again and again, or are no descendants of this process.
WITHOUT_PROCESSOR_TIME = ("mpi", "slurm")


def measure(computed, name):
    """What an engine gives, its wall time and the processor time that it took since begin()."""
    computed.begun = computed.ended = None
    computed.calls = computed.idle = 0.0
    now = (processor_seconds(), time.perf_counter())
    value = getattr(computed, name)()
    cpu, start = computed.begun or now
    last_cpu, last = computed.ended or (processor_seconds(), time.perf_counter())
    return value, last - start, last_cpu - cpu


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("points", type=int, nargs="?", default=20000)
    parser.add_argument("--engine", action="append", choices=NAMES)
    parser.add_argument("--without", action="append", choices=NAMES, default=[])
    options = parser.parse_args(arguments)
    computed = Engines(options.build.resolve(), options.points)
    expected, base_wall, base_cpu = measure(computed, "command_line")
    _, single_wall, _ = measure(computed, "one_process")
    print(f"| {options.points} points | s | speed-up over one process | processor s | of the calls | "
          "us a point that the engine costs |\n| --- | --- | --- | --- | --- | --- |")
    print(f"| command_line | {base_wall:.2f} | {single_wall / base_wall:.2f} | {base_cpu:.2f} | | |", flush=True)
    wrong = []
    for name in options.engine or [name for name in NAMES[1:] if name not in options.without]:
        try:
            text, wall, cpu = measure(computed, name)
        except (ImportError, FileNotFoundError) as error:
            print(f"| {name} | not there: {error} | | | | |")
            wrong.append(name)
            continue
        cost = "- | - | -"
        if name not in WITHOUT_PROCESSOR_TIME:
            calls = computed.calls or base_cpu
            own = cpu - calls - computed.idle * wall
            more = f"{1e6 * own / options.points:.0f} ({100 * own / calls:.1f} %)"
            more += f"; without work {100 * computed.idle:.0f} % of a core" if computed.idle else ""
            cost = f"{cpu:.2f} | {calls:.2f} | {more}"
        print(f"| {name} | {wall:.2f} | {single_wall / wall:.2f} | {cost} |", flush=True)
        if text != expected:
            wrong.append(name)
    shutil.rmtree(computed.folder)
    print("the rows of every engine are those of the command line, byte for byte" if not wrong else
          f"DIFFERENT OR MISSING: {', '.join(wrong)}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
