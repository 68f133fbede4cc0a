"""A service for a test: the executable on a free port, with a store in a temporary folder."""
import json
import os
import pathlib
import subprocess
import tempfile
import threading


class Service:
    """Runs while its `with` block does."""

    def __init__(self, executable, *options):
        self.executable = executable
        self.options = options
        self.log = []

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        store = pathlib.Path(self.folder.name) / "store.db"
        self.process = subprocess.Popen(
            [self.executable, "serve", "--listen", "127.0.0.1:0", "--store", str(store), *self.options],
            stderr=subprocess.PIPE, text=True,
            env={**os.environ, "SNAPTHROUGH_DEFAULT_WAIT_S": "60"})  # answers do not depend on how fast they come
        for line in self.process.stderr:
            self.log.append(line)
            if '"event":"listening"' in line:
                self.port = json.loads(line)["port"]
                break
        else:
            raise RuntimeError("the service did not start: " + "".join(self.log))
        self.address = f"http://127.0.0.1:{self.port}"
        self.reader = threading.Thread(target=lambda: self.log.extend(self.process.stderr), daemon=True)
        self.reader.start()
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(timeout=100)
        self.reader.join(timeout=100)
        self.process.stderr.close()
        self.folder.cleanup()
