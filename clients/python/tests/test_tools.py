"""Type checker, installation, drawings, notebook, pages."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

from .support import (EXECUTABLE, LIBRARY, PACKAGE, ROOT, SWEEP, Case, Service, column, local, request, shared_table,
                      snapthrough)

WRONG = '''
import snapthrough as st

model = st.Model("x").node("a", 0, "zero").support("a", ["z"]).distributed_load("m", [0, 1], per="len")
result = st.Local().solve(model, st.Path(stop={"limit_pionts": 1}))
result.summary.critical_load_factor + 1
result.critical_points[0].tpye
'''


def run(arguments, **options):
    """Runs a program with the package and the library that are tested."""
    environment = {**os.environ, "PYTHONPATH": str(PACKAGE), "PYTHONSNAPTHROUGH_LIBRARY": LIBRARY}
    environment.pop("MPLBACKEND", None)
    return subprocess.run(arguments, capture_output=True, text=True, env=environment, check=False, **options)


def is_there(module):
    """Whether a module can be imported."""
    return run([sys.executable, "-c", f"import {module}"]).returncode == 0


@unittest.skipUnless(is_there("mypy"), "mypy is not there")
class Types(Case):
    def check(self, *paths):
        """What mypy says."""
        return run([sys.executable, "-m", "mypy", "--config-file", str(PACKAGE / "pyproject.toml"), *map(str, paths)],
                   cwd=PACKAGE)

    def test_the_package_and_its_example_are_typed_strictly(self):
        found = self.check(PACKAGE / "snapthrough", PACKAGE / "examples" / "design_chart.py")
        self.assertEqual(found.returncode, 0, found.stdout)

    def test_mistakes_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "wrong.py")
            path.write_text(WRONG, encoding="utf-8")
            found = self.check(path).stdout
        for words in ('Argument 3 to "node"', "'z'", "'len'", 'Argument "stop"', '"None" and "int"', '"tpye"'):
            self.assertIn(words, found)
        self.assertIn("Found 6 errors", found)


class Installation(Case):
    def test_pip_installs_it_without_a_network(self):
        with tempfile.TemporaryDirectory() as folder:
            source = shutil.copytree(PACKAGE, folder + "/source", ignore=shutil.ignore_patterns("__pycache__"))
            done = run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps",
                        "--no-build-isolation", "--target", folder + "/target", source])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(pathlib.Path(folder, "target", "snapthrough", "py.typed").is_file())
            program = (f"import sys; sys.path.insert(0, {folder + '/target'!r}); "
                       "import snapthrough; print(snapthrough.__file__)")
            told = subprocess.run([sys.executable, "-I", "-c", program], capture_output=True, text=True).stdout
            self.assertTrue(told.startswith(folder), told)

    def test_a_wheel_brings_the_library_and_says_where_it_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "PYTHONSNAPTHROUGH_LIBRARIES": f"any={LIBRARY};x86-64-v3={LIBRARY}",
                           "PYTHONSNAPTHROUGH_PLATFORM": "manylinux_2_17_x86_64"}
            source = shutil.copytree(PACKAGE, folder + "/source", ignore=shutil.ignore_patterns("__pycache__", "build"))
            done = subprocess.run([sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", folder, source],
                                  capture_output=True, text=True, env=environment, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            wheel, = pathlib.Path(folder).glob("*.whl")
            self.assertEqual(wheel.name, f"snapthrough-{snapthrough.__version__}-py3-none-manylinux_2_17_x86_64.whl")
            done = run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--target", folder + "/target",
                        str(wheel)])
            self.assertEqual(done.returncode, 0, done.stderr)
            program = (f"import sys; sys.path.insert(0, {folder + '/target'!r}); import snapthrough; "
                       "print(snapthrough.Local().library)")
            told = subprocess.run([sys.executable, "-I", "-c", program], capture_output=True, text=True, check=True).stdout
            flags = pathlib.Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace").split()
            # the level's instructions beyond x86-64-v2 by the psABI, by their names in Linux (abm: LZCNT)
            third = {"abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"}
            level = "x86-64-v3" if third <= set(flags) else "any"
            self.assertEqual(told.strip(), f"{folder}/target/snapthrough/native/{level}/libsnapthrough.so.1")

    def test_it_is_built_without_a_network(self):
        with tempfile.TemporaryDirectory() as folder:
            source = shutil.copytree(PACKAGE, folder + "/source", ignore=shutil.ignore_patterns("__pycache__"))
            done = run([sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", folder, source])
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual([path.suffix for path in pathlib.Path(folder).glob("*.whl")], [".whl"])


@unittest.skipUnless(is_there("matplotlib"), "matplotlib is not there")
class Drawings(Case):
    def test_every_kind_is_drawn(self):
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
        for name, kinds in {"arch": ["path", "shape"], "static": ["static", "shape"], "buckling": ["buckling"],
                            "frame": [None], "vibration": [None, "frequencies", "shape"]}.items():
            result = local().solve(request(name))
            for kind in kinds:
                axes = result.plot(kind)
                self.assertTrue(axes.lines)
                pyplot.close(axes.figure)
        with self.assertRaisesRegex(ValueError, "none of path"):
            result.plot("pie")

    def test_the_critical_points_are_where_they_are(self):
        import matplotlib
        matplotlib.use("Agg")
        result = local().solve(request("arch"))
        lines = [(line.get_xdata(), line.get_ydata()) for line in result.plot().lines]
        marks = [(x[0], y[0]) for x, y in lines if len(x) == 1]
        self.assertEqual(marks, [(point.monitors["crown"], point.load_factor) for point in result.critical_points])

    def test_the_library_draws_results_and_tables(self):
        result, model = local().solve(column(), snapthrough.Critical()), column()
        solved = {"model": model, "analysis": snapthrough.Critical()}
        for svg in (local().plot(result), local().plot(result, kind="mode", solved_request=solved),
                    local().plot(shared_table(), kind="sweep", where={"feet": "pinned", "EI": "1"}, x="K")):
            self.assertIn("</svg>", svg)
        with self.assertRaisesRegex(snapthrough.InvalidRequest, "choices:/kind"):
            local().plot(result, kind="pie")

    def test_notebooks_show_the_librarys_drawing(self):
        with mock.patch.dict(os.environ, {"PYTHONSNAPTHROUGH_LIBRARY": LIBRARY}):
            self.assertIn("</svg>", local().solve(request("arch"))._repr_svg_())


@unittest.skipUnless(is_there("nbconvert") and is_there("ipykernel") and is_there("pandas"), "nbconvert is not there")
class Notebook(Case):
    def test_it_runs_and_draws(self):
        path = PACKAGE / "examples" / "buried_pipe.ipynb"
        with tempfile.TemporaryDirectory() as folder:
            done = run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output",
                        folder + "/executed.ipynb", str(path)])
            self.assertEqual(done.returncode, 0, done.stderr)
            cells = json.loads(pathlib.Path(folder, "executed.ipynb").read_text(encoding="utf-8"))["cells"]
        outputs = [output for cell in cells for output in cell.get("outputs", [])]
        drawn = [output for output in outputs if "image/png" in output.get("data", {})]
        self.assertEqual(len(drawn), 3)
        self.assertTrue(any("image/svg+xml" in output.get("data", {}) for output in outputs))


@unittest.skipUnless(is_there("matplotlib"), "matplotlib is not there")
class NotebookOfAllProblems(Case):
    def test_it_solves_and_draws_each_problem_of_the_gallery(self):
        """Its code runs as a program: nbconvert takes seconds for each problem."""
        index = (ROOT / "docs" / "gallery" / "README.md").read_text(encoding="utf-8")
        pages = re.findall(r"\]\((\w+)\.md\)", index)
        others = re.findall(r'"page_(\w+)\.svg"', index)
        requests = {"pile": "pile_sand", "portal": "portal_footing"}
        problems = [f"gallery/{requests.get(page, page)}" for page in pages] + others
        self.assertGreaterEqual(len(problems), 22)
        cells = json.loads((PACKAGE / "examples" / "any_problem.ipynb").read_text(encoding="utf-8"))["cells"]
        code = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
        self.assertIn('PROBLEM = "gallery/liner"', code)
        code = re.sub(r"FACTORS = \[.*\]", "FACTORS = [1.0, 1.2]", code)
        program = "import matplotlib\nmatplotlib.use('Agg')\n" + "".join(
            code.replace('PROBLEM = "gallery/liner"', f"PROBLEM = {problem!r}") + "\nassert '</svg>' in result._repr_svg_()\n"
            "assert any(value for _, value in answers), PROBLEM\nplt.close('all')\n" for problem in problems)
        with tempfile.TemporaryDirectory() as folder:  # longer than an argument may be
            script = pathlib.Path(folder) / "problems.py"
            script.write_text(program, encoding="utf-8")
            done = run([sys.executable, str(script)], cwd=PACKAGE / "examples")
        self.assertEqual(done.returncode, 0, done.stderr)


class Pages(Case):
    def blocks(self, name):
        """The Python of a page, block by block."""
        text = (ROOT / "docs" / "howto" / name).read_text(encoding="utf-8")
        return re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)

    def test_what_the_page_shows_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            page = "\n".join(self.blocks("use-from-python.md"))
            service = Service()
            self.addCleanup(service.stop)
            done = run([sys.executable, "-c", page.replace("http://127.0.0.1:8080", service.url)], cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_the_page_of_engines_shows_runs(self):
        """Recipes whose engines are there; Dask's and MPI's have scripts/engines_test.sh."""
        begin, *recipes = self.blocks("engines.md")
        sweep = json.loads(SWEEP)
        sweep["parameters"][1]["range"]["count"] = 2
        there = {"distributed": False, "mpi4py": False, "joblib_workers": is_there("joblib")}
        ran = 0
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "sweep.json").write_text(json.dumps(sweep), encoding="utf-8")
            for recipe in recipes:
                if not all(found for word, found in there.items() if word in recipe):
                    continue
                program = pathlib.Path(folder, "recipe.py")
                program.write_text(begin + recipe + "\nif __name__ == '__main__':\n    print(len(table))\n",
                                   encoding="utf-8")
                done = run([sys.executable, str(program)], cwd=folder)
                self.assertEqual((done.stdout, done.returncode), ("40\n", 0), recipe + done.stderr)
                ran += 1
        self.assertGreaterEqual(ran, 3)

    def test_the_script_of_a_job_array_goes_on_with_a_part_that_died(self):
        script = str(ROOT / "clients" / "batch" / "sweep_array.sh")
        with tempfile.TemporaryDirectory() as folder:
            sweep = pathlib.Path(folder, "sweep.json")
            sweep.write_text(SWEEP, encoding="utf-8")
            environment = {"PATH": f"{os.path.dirname(EXECUTABLE)}:{os.environ['PATH']}"}
            rows = folder + "/rows"
            tasks = ({"SLURM_ARRAY_TASK_ID": "1"}, {"PBS_ARRAY_INDEX": "2"}, {"JOB_COMPLETION_INDEX": "2"})
            for task in tasks:
                done = subprocess.run([script, str(sweep), rows, "3"], env={**environment, **task}, capture_output=True)
                self.assertEqual(done.returncode, 0, done.stderr)
            part = pathlib.Path(rows + ".2")
            part.write_bytes(part.read_bytes()[:-500])
            merge = ["snapthrough", "merge", rows + ".1", rows + ".2", rows + ".3", "--csv"]
            told = subprocess.run(merge, env=environment, capture_output=True, text=True)
            self.assertEqual(told.returncode, 1)
            self.assertIn("--part 2/3", told.stderr)
            subprocess.run([script, str(sweep), rows, "3", "--loop"], env=environment, capture_output=True, check=True)
            merged = subprocess.run(merge, env=environment, capture_output=True, text=True)
            self.assertEqual(merged.stdout, shared_table().to_csv())

    def test_a_large_table_becomes_a_frame(self):
        if not is_there("pandas"):
            self.skipTest("pandas is not there")
        table = shared_table()
        large = snapthrough.Table(table.columns, 20000)
        for index in range(20000):
            large.append(index, table.rows[index % 500], table.text_of(index % 500))
        frame = large.to_pandas()
        self.assertEqual(frame.shape, (20000, len(table.columns)))
        self.assertEqual(frame["/summary/critical_load_factor"].dtype.kind, "f")


if __name__ == "__main__":
    unittest.main()
