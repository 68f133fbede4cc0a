"""A service of this build in a folder of its own, and the program asking it."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
PATIENCE = 100.0  # s, the longest wait for what must come; how fast it comes is no test's business


def eventually(condition):
    """Waits until a condition holds; whether it did so within PATIENCE."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


class Service:
    """Runs `snapthrough serve` on a free port; use it in a with statement."""

    def __init__(self, binary, settings="", arguments=()):
        self.binary = str(pathlib.Path(binary).resolve())
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        (self.path / "config.toml").write_text(settings, encoding="utf-8")
        self.arguments = list(arguments)
        self.process = None
        self.port = 0

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *unused):
        self.stop()
        self.folder.cleanup()

    def start(self):
        """Starts it, at the port that it had before if it was started before."""
        log = self.path / "log"
        with open(log, "wb") as file:
            self.process = subprocess.Popen(
                [self.binary, "serve", "--config", self.path / "config.toml", "--listen", f"127.0.0.1:{self.port}",
                 "--store", self.path / "jobs.db", "--workers", "2", *self.arguments],
                stderr=file, env=plain_environment())
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline and self.process.poll() is None:
            for line in log.read_text(encoding="utf-8").splitlines():
                if '"event":"listening"' in line:
                    self.port = json.loads(line)["port"]
                    return
            time.sleep(0.02)
        raise RuntimeError("the service does not start: " + log.read_text(encoding="utf-8"))

    def stop(self):
        if self.process and self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            self.process.wait(timeout=PATIENCE)

    @property
    def url(self):
        return f"http://127.0.0.1:{self.port}"


def plain_environment(**more):
    """The environment without variables of snapthrough."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("SNAPTHROUGH")}
    return {**kept, **more}
