"""What the tests share: the documents that all clients share, the executable, a service."""
import functools
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

TESTS = pathlib.Path(__file__).resolve().parent
PACKAGE = TESTS.parent
ROOT = PACKAGE.parent.parent
SHARED = ROOT / "tests" / "clients"
sys.path.insert(0, str(PACKAGE))

import snapthrough  # noqa: E402

# Where a shell starts a job in the background it ignores SIGINT, and so would these tests.
signal.signal(signal.SIGINT, signal.default_int_handler)

BUILD = pathlib.Path(os.environ.get("BUILD_FOLDER", ROOT / "build" / "release")).resolve()
EXECUTABLE = str(BUILD / "snapthrough")
LIBRARY = str(BUILD / "libsnapthrough.so.1")
EXPECTED = json.loads((SHARED / "expected.json").read_text(encoding="utf-8"))
SWEEP = (SHARED / "sweep_500.json").read_text(encoding="utf-8")


def request(name):
    """A shared request as text."""
    return (SHARED / "requests" / f"{name}.json").read_text(encoding="utf-8")


def local():
    """The library of the build that is tested."""
    return snapthrough.Local(LIBRARY)


@functools.lru_cache(maxsize=None)
def shared_table():
    """The table of the shared sweep, computed once; not to be changed."""
    return local().sweep(SWEEP).table()


def column(**fields):
    """A small model."""
    return (snapthrough.Model(**fields).node("foot", 0, 0).node("head", 0, 5)
            .section("shaft", EA=1e6, EI=100).member("column", "foot", "head", "shaft")
            .support("foot", ["x", "y"]).support("head", ["x"])
            .foundation("base", "column", 10).point_load("head", [0, -1]))


def without_time(document):
    """A result's document without the time that it took, the only thing that may differ between two runs."""
    copy = json.loads(json.dumps(document))
    copy["diagnostics"].pop("wall_time_s")
    return copy


def command_line(*arguments, text=None):
    """Standard output of the executable."""
    run = subprocess.run([EXECUTABLE, *arguments], input=text, capture_output=True, text=True, check=False)
    return run.stdout


class Service:
    """A service of its own, with an empty store."""

    def __init__(self, configuration=""):
        self._folder = tempfile.TemporaryDirectory()
        arguments = ["serve", "--listen", "127.0.0.1:0", "--store", self._folder.name + "/store.db", "--workers", "2"]
        if configuration:
            path = pathlib.Path(self._folder.name) / "service.toml"
            path.write_text(configuration, encoding="utf-8")
            arguments += ["--config", str(path)]
        environment = {name: value for name, value in os.environ.items() if not name.startswith("SNAPTHROUGH_")}
        self._process = subprocess.Popen([EXECUTABLE, *arguments], stderr=subprocess.PIPE, text=True, env=environment,
                                         start_new_session=True)
        self.url = f"http://127.0.0.1:{self._port()}"
        threading.Thread(target=self._drain, daemon=True).start()

    def _port(self):
        for line in self._process.stderr:
            event = json.loads(line)
            if event.get("event") == "listening":
                return event["port"]
        raise RuntimeError("the service did not start")

    def _drain(self):
        for _ in self._process.stderr:
            pass

    def stop(self):
        """Ends it."""
        self._process.send_signal(signal.SIGTERM)
        self._process.wait(timeout=20)
        self._process.stderr.close()
        self._folder.cleanup()


class Case(unittest.TestCase):
    """A test that takes warnings of results for granted, and says which documents differ."""

    maxDiff = 2000

    def setUp(self):
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore", snapthrough.SnapthroughWarning)


def interrupt_after(seconds):
    """Presses Ctrl-C."""
    timer = threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer
