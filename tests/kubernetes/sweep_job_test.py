"""What the pods of docker/kubernetes/sweep run, run here: each part by the manifest's own line and variables, one of them killed on its way
and run again, then the merge.

  python3 tests/kubernetes/sweep_job_test.py BINARY
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "remote"))
from service import SOURCE, plain_environment  # noqa: E402

BINARY = ""
FOLDER = SOURCE / "docker" / "kubernetes"


def manifest(name):
    """The shell line of the container, its variables, and the text."""
    text = (FOLDER / "sweep" / name).read_text(encoding="utf-8")
    line = " ".join(re.search(r"args:\n\s+- >-\n((?:\s{14}.*\n)+)", text).group(1).split())
    variables = dict(re.findall(r'\{name: (\w+), value: "?([^"}]*)"?\}', text))
    return line, variables, text


class SweepJob(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        (self.path / "bin").mkdir()
        (self.path / "bin" / "snapthrough").symlink_to(pathlib.Path(BINARY).resolve())

    def environment(self, variables, **more):
        own = {"FOLDER": str(self.path), "THREADS": "1", "PATH": f"{self.path / 'bin'}:{os.environ['PATH']}", **more}
        return plain_environment(**{**variables, **own})

    def test_parts_and_merge_give_the_table_of_one_process(self):
        document = SOURCE / "examples" / "sweeps" / "columns_with_one_spring.json"
        line, variables, text = manifest("sweep.yaml")
        parts = int(variables["PARTS"])
        self.assertEqual(re.findall(r"(?:completions|parallelism): (\d+)", text), [variables["PARTS"]] * 2)
        for index in range(parts):
            env = self.environment(variables, SWEEP=str(document), JOB_COMPLETION_INDEX=str(index))
            if index == 3:
                self.kill_early(line, env)
            done = subprocess.run(["sh", "-c", line], env=env, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
        merge, variables, _ = manifest("merge.yaml")
        done = subprocess.run(["sh", "-c", merge], env=self.environment(variables), capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = subprocess.run([BINARY, "sweep", "--csv", document], capture_output=True, check=True).stdout
        self.assertEqual((self.path / "table.csv").read_bytes(), whole)
        (self.path / "part-7.ndjson").unlink()
        (self.path / "table.csv").unlink()
        done = subprocess.run(["sh", "-c", merge], env=self.environment(variables), capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0, "a part is missing")
        self.assertFalse((self.path / "table.csv").exists())

    def kill_early(self, line, env):
        pod = subprocess.Popen(["sh", "-c", line], env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               start_new_session=True)
        file = self.path / "part-4.ndjson"
        deadline = time.monotonic() + 100
        while time.monotonic() < deadline and not (file.exists() and file.stat().st_size > 4096) and pod.poll() is None:
            time.sleep(0.001)
        try:
            os.killpg(pod.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        pod.wait()

    def test_every_manifest_is_hardened_and_probed(self):
        for path in sorted(FOLDER.rglob("*.yaml")):
            text = path.read_text(encoding="utf-8")
            containers = text.count("image: snapthrough")
            for line in ("allowPrivilegeEscalation: false", "readOnlyRootFilesystem: true", "drop: [ALL]", "enableServiceLinks: false",
                         "runAsNonRoot: true", "limits: {"):
                self.assertGreaterEqual(text.count(line), containers, f"{path.name}: {line}")
            if "kind: Deployment" in text:
                self.assertIn("livenessProbe", text, path.name)
        api = (FOLDER / "30-api.yaml").read_text(encoding="utf-8")
        for probe in ("startupProbe", "readinessProbe", "livenessProbe"):
            self.assertIn(probe, api)


if __name__ == "__main__":
    BINARY = sys.argv.pop(1)
    unittest.main()
