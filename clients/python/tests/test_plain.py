"""The standard library is enough: everything but frames, arrays and drawings works where nothing else is."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

from .support import LIBRARY, PACKAGE, SHARED, Case, Service

PROGRAM = textwrap.dedent("""
    import sys

    class Blocked:
        def find_spec(self, name, path=None, target=None):
            if name.split(".")[0] in ("numpy", "pandas", "matplotlib", "tqdm", "joblib", "distributed", "mpi4py"):
                raise ImportError(name + " is not there")

    sys.meta_path.insert(0, Blocked())
    sys.path.insert(0, {package!r})
    import snapthrough
    request = open({shared!r} + "/requests/arch.json").read()
    sweep = open({shared!r} + "/sweep_500.json").read().replace('"count": 25', '"count": 2')
    found = []
    for solver in (snapthrough.Local({library!r}), snapthrough.Client({url!r})):
        result = solver.solve(request)
        table = solver.sweep(sweep, progress=True).table()
        found.append((result.branches[0].monitors["crown"], result.columns("critical_points"), table.to_csv()))
        for call in (result.to_pandas, result.to_numpy, result.plot, table.to_pandas, table.to_numpy, table.plot):
            try:
                call()
            except ImportError:
                continue
            raise SystemExit("an import was not missed")
    if found[0] != found[1]:
        raise SystemExit("the answers differ")
    print("ok")
""")


class Plain(Case):
    def test_a_checkout_in_which_nothing_was_built_says_what_to_run(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder, "clients", "python", "snapthrough")
            shutil.copytree(pathlib.Path(PACKAGE, "snapthrough"), copy, ignore=shutil.ignore_patterns("__pycache__"))
            for made in ("documents", "results", "_builders"):
                copy.joinpath(f"{made}.py").unlink()
            done = subprocess.run([sys.executable, "-c", "import snapthrough"], cwd=copy.parent, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertTrue(done.stderr.strip().endswith(f"Make them: python3 {copy.parent.resolve() / 'generate.py'}"), done.stderr)

    def test_nothing_but_the_standard_library(self):
        service = Service()
        self.addCleanup(service.stop)
        program = PROGRAM.format(package=str(PACKAGE), shared=str(SHARED), library=LIBRARY, url=service.url)
        run = subprocess.run([sys.executable, "-I", "-S", "-c", program], capture_output=True, text=True)
        self.assertEqual((run.stdout, run.returncode), ("ok\n", 0), run.stderr)
        self.assertIn("40/40", run.stderr)


if __name__ == "__main__":
    unittest.main()
