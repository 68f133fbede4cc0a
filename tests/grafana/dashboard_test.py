"""The dashboard and the metrics of a service that runs: each name in a query is there, each metric is shown, and, where Prometheus is
installed, each query is one that it answers.

  python3 tests/grafana/dashboard_test.py BINARY
"""
import json
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.parse
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "remote"))
from service import SOURCE, Service  # noqa: E402

BINARY = ""
DASHBOARD = json.loads((SOURCE / "docker" / "grafana" / "snapthrough.json").read_text(encoding="utf-8"))


def queries():
    """Every PromQL expression, with the title of its panel."""
    return [(panel["title"], target["expr"]) for panel in DASHBOARD["panels"] for target in panel.get("targets", [])]


def get(url, body=None):
    headers = {"Content-Type": "application/json"} if body else {}
    with urllib.request.urlopen(urllib.request.Request(url, body, headers)) as response:
        return response.read().decode()


def free_port():
    """A port that nobody listens on: the system's choice, released again."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def has_ended(service):
    """A service that has answered requests, solved a job and a sweep."""
    get(service.url + "/v1/jobs", (SOURCE / "examples" / "arch_no_base.json").read_bytes())
    sweep = json.loads(get(service.url + "/v1/sweeps", (SOURCE / "examples" / "sweeps" / "lining_thickness.json").read_bytes()))
    while json.loads(get(f"{service.url}/v1/sweeps/{sweep['id']}"))["status"] in ("accepted", "running"):
        time.sleep(0.05)


class Dashboard(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.service = Service(BINARY)
        cls.service.start()
        has_ended(cls.service)
        cls.metrics = get(cls.service.url + "/metrics")

    @classmethod
    def tearDownClass(cls):
        cls.service.__exit__()

    def test_queries_and_metrics_have_the_same_names(self):
        families = dict(re.findall(r"^# TYPE (\S+) (\S+)$", self.metrics, re.MULTILINE))
        samples = set(re.findall(r"^(snapthrough_\w+)", self.metrics, re.MULTILINE))
        used = set()
        for title, expression in queries():
            for name in re.findall(r"snapthrough_\w+", expression):
                used.add(re.sub(r"_bucket$", "", name))
                base = re.sub(r"_bucket$", "", name)
                self.assertIn(base, families, f"{title}: {name}")
                self.assertEqual(name != base, families[base] == "histogram", f"{title}: {name}")
                if families[base] != "counter":  # a counter has no sample before it counts
                    self.assertIn(name, samples, f"{title}: {name}")
        self.assertEqual(used, set(families), "a metric that no panel shows")

    def test_labels_are_those_of_the_metrics(self):
        labels = {"le", "instance"}
        for line in self.metrics.splitlines():
            labels |= set(re.findall(r'[{,](\w+)="', line))
        for title, expression in queries():
            named = re.findall(r"by \(([^)]*)\)", expression) + re.findall(r'[{ ](\w+)=~"', expression)
            for name in ", ".join(named).split(", "):
                self.assertIn(name, labels | {""}, f"{title}: {expression}")

    def test_panels_have_ids_of_their_own_and_do_not_overlap(self):
        cells = set()
        self.assertEqual(len({panel["id"] for panel in DASHBOARD["panels"]}), len(DASHBOARD["panels"]))
        for panel in DASHBOARD["panels"]:
            place = panel["gridPos"]
            self.assertLessEqual(place["x"] + place["w"], 24)
            own = {(x, y) for x in range(place["x"], place["x"] + place["w"]) for y in range(place["y"], place["y"] + place["h"])}
            self.assertFalse(own & cells, panel["title"])
            cells |= own

    @unittest.skipUnless(shutil.which("prometheus"), "no prometheus is installed")
    def test_prometheus_answers_every_query(self):
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "prometheus.yml"
            config.write_text("global: {scrape_interval: 1s, scrape_timeout: 1s}\nscrape_configs:\n"
                              f"  - job_name: snapthrough\n    static_configs: [{{targets: ['127.0.0.1:{self.service.port}']}}]\n",
                              encoding="utf-8")
            port = free_port()
            url = f"http://127.0.0.1:{port}"
            server = subprocess.Popen(["prometheus", f"--config.file={config}", f"--storage.tsdb.path={folder}/data",
                                       f"--web.listen-address=127.0.0.1:{port}"], stderr=subprocess.DEVNULL)
            try:
                self.wait_for_scrapes(server, url)
                for title, expression in queries():
                    query = expression.replace("$__rate_interval", "1m").replace("$instance", ".*")
                    answer = json.loads(get(f"{url}/api/v1/query?" + urllib.parse.urlencode({"query": query})))
                    self.assertEqual(answer["status"], "success", f"{title}: {expression}")
                    quiet = 'status=~"4..|5.."' in expression
                    self.assertTrue(answer["data"]["result"] or quiet, f"{title}: no data for {query}")
            finally:
                server.terminate()
                server.wait(timeout=100)

    def wait_for_scrapes(self, server, url):
        count = f"{url}/api/v1/query?" + urllib.parse.urlencode({"query": "min(count_over_time(snapthrough_connections[1m]))"})
        deadline = time.monotonic() + 100
        while time.monotonic() < deadline and server.poll() is None:
            try:
                result = json.loads(get(count))["data"]["result"]
                if result and float(result[0]["value"][1]) >= 4:
                    return
            except OSError:
                pass
            time.sleep(0.2)
        self.fail("Prometheus does not read the service; " +
                  ("it runs" if server.poll() is None else f"it ended with {server.returncode}"))


if __name__ == "__main__":
    BINARY = sys.argv.pop(1)
    unittest.main()
