"""Hosts that share one PostgreSQL, each a process of its own: started, harmed and asked, for tests and measurements."""

import collections
import hashlib
import http.client
import json
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
POSTGRESQL = max(pathlib.Path("/usr/lib/postgresql").glob("*/bin"), key=lambda path: int(path.parent.name))
PATIENCE = 300  # s, the longest wait for what must come: a busy machine takes its time
UNENDED = ("accepted", "running", "unknown")  # what Client.state() may say of what has not ended
OWNERS = {"ann": "key-of-ann-0123456789", "bob": "key-of-bob-0123456789"}


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def unprivileged(command):
    """PostgreSQL refuses to run as root."""
    if os.geteuid() == 0:
        return ["setpriv", "--reuid=nobody", "--regid=nogroup", "--clear-groups", *map(str, command)]
    return list(map(str, command))


class Database:
    """A server of PostgreSQL in a folder of its own. It syncs to disk, as it does in earnest."""

    def __init__(self, folder, settings=()):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True)
        if os.geteuid() == 0:
            shutil.chown(self.folder, "nobody", "nogroup")
        self.port = free_port()
        self.settings = list(settings)

    def initialise(self):
        self._run("initdb", "-D", self.folder / "data", "-U", "snapthrough", "-A", "trust", "-E", "UTF8", "--locale=C",
                  "--no-sync")
        with open(self.folder / "data" / "pg_hba.conf", "a", encoding="utf-8") as rules:
            rules.write(f"host all all {Network.INSIDE}/32 trust\n")
        self.start()
        self._run("createdb", "-h", self.folder, "-p", self.port, "-U", "snapthrough", "snapthrough")
        return self

    def replica_of(self, primary):
        """A standby that streams from another one."""
        self._run("pg_basebackup", "-h", primary.folder, "-p", primary.port, "-U", "snapthrough", "-D",
                  self.folder / "data", "-R", "-X", "stream", "-c", "fast")
        with open(self.folder / "data" / "postgresql.auto.conf", "a", encoding="utf-8") as conf:
            conf.write("primary_conninfo = 'host=%s port=%d user=snapthrough application_name=replica'\n"
                       % (primary.folder, primary.port))
        self.start()
        return self

    def start(self, wait=True):
        options = [f"-c port={self.port}", f"-c unix_socket_directories={self.folder}", "-c listen_addresses=*",
                   "-c max_connections=300", *(f"-c {setting}" for setting in self.settings)]
        self._run("pg_ctl", "-D", self.folder / "data", "-l", self.folder / "server.log", "-W" if not wait else "-w",
                  "-o", " ".join(options), "start")

    def promote(self):
        self._run("pg_ctl", "-D", self.folder / "data", "-w", "promote")

    def freeze(self):
        """All its processes stand still. They are returned, the server first, which starts no more of them."""
        server = int((self.folder / "data" / "postmaster.pid").read_text().split()[0])
        os.kill(server, signal.SIGSTOP)
        children = subprocess.run(["pgrep", "-P", str(server)], capture_output=True, text=True, check=False).stdout.split()
        processes = [server, *map(int, children)]
        for one in processes:
            os.kill(one, signal.SIGSTOP)
        return processes

    def kill(self):
        for one in self.freeze():
            os.kill(one, signal.SIGKILL)

    def start_again(self):
        """After a kill: its memory may be in use for a moment."""
        for _ in range(100):
            try:
                return self.start()
            except RuntimeError:
                time.sleep(0.1)
        return self.start()

    def stop(self):
        if (self.folder / "data" / "postmaster.pid").exists():
            self._run("pg_ctl", "-D", self.folder / "data", "-m", "immediate", "-w", "stop", check=False)

    def query(self, sql):
        """Rows as lists of texts. The statement goes through standard input: arguments are limited to 128 kB."""
        out = subprocess.run([POSTGRESQL / "psql", "-h", self.folder, "-p", str(self.port), "-U", "snapthrough", "-AtqF", "\t",
                              "-v", "ON_ERROR_STOP=1", "snapthrough"], input=sql, capture_output=True, text=True,
                             check=True).stdout
        return [line.split("\t") for line in out.splitlines()]

    def location(self, host="127.0.0.1"):
        return f"postgresql://snapthrough@{host}:{self.port}/snapthrough"

    def _run(self, program, *arguments, check=True):
        done = subprocess.run(unprivileged([POSTGRESQL / program, *arguments]), cwd=self.folder, capture_output=True, text=True,
                              check=False)
        if check and done.returncode != 0:
            raise RuntimeError(f"{program}: {done.stdout}{done.stderr}")


class Network:
    """A network namespace with one cable to this machine, which can be cut. Needs root."""

    OUTSIDE, INSIDE = "10.213.77.1", "10.213.77.2"

    def __init__(self):
        self.name = f"snapthrough{os.getpid() % 10000}"
        self.prefix = ["ip", "netns", "exec", self.name]
        self._ip("netns", "add", self.name)
        self._ip("link", "add", "st-out", "type", "veth", "peer", "name", "st-in", "netns", self.name)
        self._ip("addr", "add", f"{self.OUTSIDE}/30", "dev", "st-out")
        self._ip("link", "set", "st-out", "up")
        for words in (["addr", "add", f"{self.INSIDE}/30", "dev", "st-in"], ["link", "set", "st-in", "up"], ["link", "set", "lo", "up"]):
            subprocess.run([*self.prefix, "ip", *words], check=True)

    @staticmethod
    def possible():
        """Whether this machine lets us make one."""
        if os.geteuid() != 0 or not shutil.which("ip"):
            return False
        made = subprocess.run(["ip", "netns", "add", "snapthroughtry"], capture_output=True, check=False).returncode == 0
        subprocess.run(["ip", "netns", "delete", "snapthroughtry"], capture_output=True, check=False)
        return made

    def cut(self):
        self._ip("link", "set", "st-out", "down")

    def mend(self):
        self._ip("link", "set", "st-out", "up")

    def remove(self):
        subprocess.run(["ip", "link", "delete", "st-out"], capture_output=True, check=False)
        subprocess.run(["ip", "netns", "delete", self.name], capture_output=True, check=False)

    @staticmethod
    def _ip(*words):
        subprocess.run(["ip", *words], check=True)


class Host:
    """A process of the service: with a port it answers requests."""

    def __init__(self, program, folder, name, store, workers, front, options=(), prefix=()):
        self.name = name
        self.log = pathlib.Path(folder) / f"{name}.log"
        self.port = free_port() if front else None
        config = pathlib.Path(folder) / f"{name}.toml"
        keys = "".join(f'[[keys]]\nowner = "{owner}"\nsha256 = "{hashlib.sha256(key.encode()).hexdigest()}"\n'
                       for owner, key in OWNERS.items())
        config.write_text(f'store = "{store}"\nworkers = {workers}\nlisten = "127.0.0.1:{self.port or 0}"\n' + keys)
        self.command = [*prefix, str(program), "serve" if front else "work", "--config", str(config), *options]
        self.process = None
        self.start()

    def start(self):
        """Returns when it takes requests or work."""
        before = self._starts()  # the log has those of earlier processes, too
        self.process = subprocess.Popen(self.command, stdout=open(self.log, "a"), stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        deadline = time.time() + PATIENCE
        while time.time() < deadline:
            if self.process.poll() is not None:
                raise RuntimeError(f"{self.name} ended: {self.log.read_text()[-500:]}")
            if self._starts() > before:
                return
            time.sleep(0.02)
        raise RuntimeError(f"{self.name} did not start")

    def _starts(self):
        text = self.log.read_text() if self.log.exists() else ""
        return text.count('"event":"listening"') + text.count('"event":"working"')

    def signal(self, number):
        self.process.send_signal(number)

    def instance(self):
        """The name that its leases bear."""
        return (self.events("listening") + self.events("working"))[-1]["instance"]

    def kill(self):
        self.process.kill()
        self.process.wait()

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            self.process.terminate()
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.kill()
                raise RuntimeError(f"{self.name} did not stop")

    def events(self, name):
        """What it logged under that name."""
        found = []
        for line in self.log.read_text().splitlines():
            if f'"event":"{name}"' in line:
                try:
                    found.append(json.loads(line))
                except json.JSONDecodeError:
                    pass  # cut where it was killed
        return found


class Client:
    """Asks the fronts in turn, and the next one when one does not answer."""

    def __init__(self, hosts, owner="ann"):
        self.hosts = hosts
        self.owner = owner
        self.turn = random.randrange(len(hosts))

    def ask(self, method, path, body=None, headers=None, tries=1, timeout=120):
        """Status, body and headers; status 0 when nobody answered."""
        for attempt in range(tries):
            host = self.hosts[(self.turn + attempt) % len(self.hosts)]
            try:
                connection = http.client.HTTPConnection("127.0.0.1", host.port, timeout=timeout)
                key = {"Authorization": f"Bearer {OWNERS[self.owner]}"} if OWNERS else {}
                connection.request(method, path, body, {"Content-Type": "application/json", **key, **(headers or {})})
                response = connection.getresponse()
                text = response.read()
                connection.close()
                if response.status < 500:
                    self.turn += attempt
                    return response.status, text, response.headers
            except (OSError, http.client.HTTPException):
                pass
            time.sleep(0.05)
        return 0, b"", {}

    def state(self, path):
        """The status of a job or a sweep: "gone" where it is not there, "unknown" where no front answers."""
        status, body, _ = self.ask("GET", path, tries=4)
        return json.loads(body)["status"] if status == 200 else "gone" if status in (404, 410) else "unknown"


def column(stiffness, elements=4, analysis="critical"):
    """A request that takes some milliseconds; more with more elements."""
    return {"model": {"title": "column", "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 1, "y": 0}],
                      "sections": [{"id": "s", "EA": 1e6, "EI": stiffness}],
                      "members": [{"id": "m", "start": "a", "end": "b", "section": "s"}],
                      "supports": [{"node": "a", "fixed": ["x", "y", "rotation"]}],
                      "loads": [{"type": "point", "at": {"node": "b"}, "force": [-1, 0]}]},
            "analysis": {"type": analysis} if analysis == "buckling" else
                        {"type": analysis, "discretization": {"elements": elements, "order": 2}}}


def sweep(points, elements=4, analysis="critical"):
    """That column over as many stiffnesses."""
    return {**column(1, elements, analysis), "design": "grid", "outputs": ["/summary/critical_load_factor"],
            "parameters": [{"name": "EI", "targets": [{"pointer": "/model/sections/0/EI"}],
                            "range": {"from": 1, "to": 2, "count": points}}]}


class Load:
    """Clients that hand jobs in until they are stopped; what was acknowledged is kept. Each has at most OPEN jobs that have not
    ended, so that the queue stays as short on a slow machine as on a fast one."""

    OPEN = 16

    def __init__(self, hosts, clients=4, elements=24):
        self.hosts = hosts
        self.elements = elements
        self.lock = threading.Lock()
        self.acknowledged = []  # (when, owner, path)
        self.stopping = False
        self.threads = [threading.Thread(target=self._run, args=(number,), daemon=True) for number in range(clients)]
        for thread in self.threads:
            thread.start()

    def _run(self, number):
        client = Client(self.hosts, list(OWNERS)[number % 2])
        made = 0
        unended = collections.deque()
        while not self.stopping:
            made += 1
            path = self._hand_in(client, number, made)
            if path:
                unended.append(path)
            while len(unended) >= self.OPEN and not self.stopping:
                if client.state(unended[0]) not in UNENDED:  # a job may be gone with a database that was lost
                    unended.popleft()
                else:
                    time.sleep(0.1)
            time.sleep(0.1)

    def _hand_in(self, client, number, made):
        """The path of the new job; nothing where it is refused or the load is stopped."""
        key = f'"{os.getpid()}-{id(self)}-{number}-{made}"'
        # every fourth takes longer, so that whoever is harmed has something
        body = json.dumps(column(1 + number + made * 1e-4, 1200 if made % 4 == 0 else self.elements))
        status = 0
        while status == 0 and not self.stopping:  # the same again, with its key, until somebody answers
            status, _, headers = client.ask("POST", "/v1/jobs", body, {"Idempotency-Key": key, "Prefer": "respond-async"},
                                            tries=len(self.hosts))
        if status not in (200, 201):
            return None
        with self.lock:
            self.acknowledged.append((time.time(), client.owner, headers["Location"]))
        return headers["Location"]

    def stop(self):
        self.stopping = True
        for thread in self.threads:
            thread.join()
        return list(self.acknowledged)


def wait_for(condition, seconds, pause=0.05):
    """Seconds until it held, or None."""
    start = time.time()
    while time.time() - start < seconds:
        if condition():
            return time.time() - start
        time.sleep(pause)
    return None


class Cluster:
    """A database, fronts and workers."""

    def __init__(self, program, fronts=2, workers=4, options=(), settings=(), replica=False, synced=False, apart=False):
        self.folder = tempfile.mkdtemp(prefix="snapthrough-cluster-")
        os.chmod(self.folder, 0o755)
        self.database = Database(pathlib.Path(self.folder) / "database", settings).initialise()
        self.hosts = []
        self.replica = Database(pathlib.Path(self.folder) / "replica").replica_of(self.database) if replica else None
        if synced:
            self.database.query("ALTER SYSTEM SET synchronous_standby_names = 'replica'")
            self.database.query("SELECT pg_reload_conf()")
        self.network = Network() if apart else None
        store = self.database.location()
        if replica:  # hosts take whichever of the two can be written
            store = (f"postgresql://snapthrough@127.0.0.1:{self.database.port},127.0.0.1:{self.replica.port}/snapthrough"
                     "?target_session_attrs=read-write")
        self.fronts = [self._add(program, f"front{i}", store, 0, True, options) for i in range(fronts)]
        self.workers = [self._add(program, f"worker{i}", store, 1, False, options) for i in range(workers)]
        if self.network:
            self.workers[0].stop()
            self.workers[0] = Host(program, self.folder, "apart", self.database.location(Network.OUTSIDE), 1, False, options,
                                   self.network.prefix)
            self.hosts.append(self.workers[0])

    def _add(self, program, name, store, workers, front, options):
        host = Host(program, self.folder, name, store, workers, front, options)
        self.hosts.append(host)
        return host

    def stop(self):
        for host in self.hosts:
            host.stop()
        self.database.stop()
        if self.replica:
            self.replica.stop()
        if self.network:
            self.network.remove()
        shutil.rmtree(self.folder, ignore_errors=True)


if __name__ == "__main__":
    sys.exit("cluster.py is used by faults.py and rates.py")
