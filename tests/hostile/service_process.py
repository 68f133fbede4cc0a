"""A service under test as a process on a folder of its own, and what the system tells of it."""
import hashlib
import http.client
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOST = "127.0.0.1"
MB = 1 << 20


class ServiceProcess:
    """Runs `snapthrough serve`; it keeps its port and its store when it is killed and started again."""

    def __init__(self, program, folder, store=None, owners=(), **settings):
        """`store`: a location; None: jobs.db in `folder`. `owners`: each gets a key, its SHA-256 goes into the configuration."""
        self.program = str(pathlib.Path(program).resolve())
        self.folder = pathlib.Path(folder)
        self.store = str(store or self.folder / "jobs.db")
        self.keys = {owner: f"key of {owner}".replace(" ", "-") for owner in owners}
        self.port = free_port()
        self.log = self.folder / "service.log"
        self.process = None
        self.configuration = self.folder / "service.toml"
        settings = {"listen": f"{HOST}:{self.port}", "store": self.store, "log_level": "warning", **settings}
        lines = [f"{name} = {json.dumps(value)}" for name, value in settings.items()]
        for owner, key in self.keys.items():
            lines += ["[[keys]]", f'owner = "{owner}"', f'sha256 = "{hashlib.sha256(key.encode()).hexdigest()}"']
        self.configuration.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def start(self, longest=60.0):
        """Starts the process, which must not run already, and waits until it answers /livez."""
        assert self.process is None or self.process.poll() is not None
        with open(self.log, "ab") as log:
            self.process = subprocess.Popen([self.program, "serve", "--config", self.configuration],
                                            stdout=subprocess.DEVNULL, stderr=log, env=plain_environment())
        late = time.monotonic() + longest
        while time.monotonic() < late and self.process.poll() is None:
            if self.status("/livez") == 200:
                return
            time.sleep(0.02)
        self.kill()
        raise SystemExit("the service does not start: " + self.log.read_text(errors="replace")[-2000:])

    def status(self, path, longest=5.0):
        """Status of a GET; 0 when there is no answer within `longest` seconds."""
        try:
            with socket.create_connection((HOST, self.port), timeout=longest) as client:
                client.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
                line = client.recv(64).split(b" ")
                return int(line[1]) if len(line) > 1 else 0
        except (OSError, ValueError):
            return 0

    def json(self, path, owner=None):
        """The JSON document that a GET by an owner is answered with."""
        headers = {"Authorization": f"Bearer {self.keys[owner]}"} if owner else {}
        connection = http.client.HTTPConnection(HOST, self.port, timeout=60)
        try:
            connection.request("GET", path, headers=headers)
            return json.loads(connection.getresponse().read())
        finally:
            connection.close()

    def wait_until_ready(self, longest):
        """Seconds until /readyz is 200; None when it is not within `longest` seconds."""
        begin = time.monotonic()
        while time.monotonic() - begin < longest:
            if self.status("/readyz") == 200:
                return time.monotonic() - begin
            time.sleep(0.05)
        return None

    def kill(self):
        """kill -9, which leaves no time for anything; a no-operation when the process has ended."""
        if self.process and self.process.poll() is None:
            self.process.kill()
        if self.process:
            self.process.wait()

    def terminate(self, longest=60.0):
        """(seconds from SIGTERM to the exit, exit status); the status is None when it had to be killed after `longest`."""
        begin = time.monotonic()
        self.process.send_signal(signal.SIGTERM)
        try:
            status = self.process.wait(longest)
        except subprocess.TimeoutExpired:
            status = None
            self.kill()
        return time.monotonic() - begin, status

    def runners(self):
        """Ids of the processes that compute."""
        tasks = pathlib.Path(f"/proc/{self.process.pid}/task").glob("*/children")
        return [int(pid) for file in tasks for pid in read_text(file).split()]

    def processor_seconds(self):
        """User and system time of the process and of its runners, ended ones too."""
        return sum(map(processor_seconds, [self.process.pid, *self.runners()]))

    def errors_logged(self):
        """Log lines of the level error, without those of requests, which clients judge; the last line may be cut by a kill."""
        found = []
        for line in self.log.read_text(errors="replace").splitlines():
            try:
                entry = json.loads(line)
            except ValueError:
                continue
            if entry.get("level") == "error" and entry.get("event") != "request":
                found.append(entry)
        return found


def free_port():
    with socket.socket() as taken:
        taken.bind((HOST, 0))
        return taken.getsockname()[1]


def plain_environment():
    """The environment without variables of snapthrough, which are settings."""
    return {name: value for name, value in os.environ.items() if not name.startswith("SNAPTHROUGH")}


def read_text(path):
    """Content of a file of /proc; empty when the process is gone."""
    try:
        return pathlib.Path(path).read_text()
    except (FileNotFoundError, ProcessLookupError):
        return ""


def resident_mb(pid):
    found = re.search(r"^VmRSS:\s+(\d+)", read_text(f"/proc/{pid}/status"), re.MULTILINE)
    return int(found[1]) / 1024 if found else 0.0


def processor_seconds(pid):
    """User and system time of a process and of its children that have ended; zero when the process is gone."""
    fields = read_text(f"/proc/{pid}/stat").rpartition(")")[2].split()
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK") if fields else 0.0


def processor_seconds_of_all():
    """Time that the processors of the machine have worked for anybody, in s."""
    fields = [int(field) for field in read_text("/proc/stat").split("\n", 1)[0].split()[1:9]]
    return (sum(fields) - fields[3] - fields[4]) / os.sysconf("SC_CLK_TCK")  # without idle and waiting for disks


def leave_by_exception():
    """SIGTERM and SIGHUP end this program as SIGINT does: what it started and mounted is taken away."""
    def leave(number, _):
        raise SystemExit(f"stopped by signal {number}")
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, leave)


def open_files_as_many_as_allowed():
    """Raises the soft bound of descriptors of this process to its hard bound."""
    import resource
    hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))


def quantile(values, share):
    """The value that `share` of the values do not exceed; not a number for no values."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))] if ordered else float("nan")


class Verdict:
    """The lines that are asked: what, the bound, the measured value, and whether it is met."""

    def __init__(self):
        self.rows = []

    def ask(self, what, bound, measured, met):
        self.rows.append((what, bound, measured, met))

    @property
    def missed(self):
        return [row for row in self.rows if not row[3]]

    def table(self):
        lines = ["| asked | bound | measured | |", "| --- | --- | --- | --- |"]
        return "\n".join(lines + [f"| {what} | {bound} | {measured} | {'met' if met else '**missed**'} |"
                                  for what, bound, measured, met in self.rows])


def example(name):
    return json.loads((ROOT / "examples" / name).read_text(encoding="utf-8"))
