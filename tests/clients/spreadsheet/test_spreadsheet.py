#!/usr/bin/env python3
"""Spreadsheets at the service: tables by their address, the workbook in LibreOffice, the text for Power Query.

  test_spreadsheet.py EXECUTABLE [TEST...]
"""
import csv
import hashlib
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/clients"))
from support.service import Service  # noqa: E402

EXECUTABLE = ""
PAGE = ROOT / "docs/howto/use-in-a-spreadsheet.md"
WORKBOOK = ROOT / "clients/spreadsheet/snapthrough.xlsx"
DEBIAN_PYTHON = "/usr/bin/python3"  # the one that has uno


def send(address, body=None, **headers):
    """Status, headers and text of the answer."""
    names = {name.replace("_", "-"): value for name, value in headers.items()}
    request = urllib.request.Request(address, data=body, headers=names)
    try:
        with urllib.request.urlopen(request) as response:
            return response.status, response.headers, response.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.headers, error.read().decode()


def submit(service, document, where="jobs", **headers):
    """The id of a new job or sweep."""
    body = document if isinstance(document, bytes) else json.dumps(document).encode()
    status, _, text = send(f"{service.address}/v1/{where}", body, Content_Type="application/json", Prefer="return=minimal", **headers)
    assert status in (200, 201), text
    return json.loads(text)["id"]


def result_of(service, job):
    while True:
        status = json.loads(send(f"{service.address}/v1/jobs/{job}", Prefer="wait=60")[2])["status"]
        if status not in ("accepted", "running"):
            return json.loads(send(f"{service.address}/v1/jobs/{job}/result")[2])


PATH = (ROOT / "examples/tunnel_arch.json").read_bytes()
SWEEP = (ROOT / "examples/sweeps/lining_thickness.json").read_bytes()


class Tables(unittest.TestCase):
    """Tables that an address alone gives."""

    @classmethod
    def setUpClass(cls):
        cls.service = Service(EXECUTABLE).__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.service.__exit__()

    def test_of_a_job_that_may_still_run(self):
        job = f"{self.service.address}/v1/jobs/{submit(self.service, PATH, Cache_Control='no-cache')}"
        status, headers, text = send(job + "/table.csv", Accept="application/json")
        self.assertEqual((status, headers["Content-Type"]), (200, "text/csv; charset=utf-8; header=present"))
        self.assertEqual(text, send(job + "/result?format=csv")[2])
        rows = list(csv.DictReader(io.StringIO(text)))
        branch = result_of(self.service, job.rsplit("/", 1)[1])["branches"][0]
        self.assertEqual([float(row["crown"]) for row in rows], branch["monitors"]["crown"])
        critical = send(job + "/table.csv?table=critical_points")
        self.assertEqual(critical[2], send(job + "/result?table=critical_points")[2])
        self.assertEqual(send(job + "/table.csv", If_None_Match=headers["ETag"])[0], 304)

    def test_of_a_sweep(self):
        sweep = f"{self.service.address}/v1/sweeps/{submit(self.service, SWEEP, 'sweeps')}"
        send(sweep, Prefer="wait=60")
        status, headers, text = send(sweep + "/table.csv", Accept="application/json")
        self.assertEqual((status, headers["X-Complete"]), (200, "true"))
        self.assertEqual(text, send(sweep + "/table?format=csv")[2])
        self.assertEqual(text, subprocess.run([EXECUTABLE, "sweep", "--csv", "-"], input=SWEEP, capture_output=True,
                                              check=True).stdout.decode())
        self.assertEqual(len(send(sweep + "/table.csv?first=1&count=2")[2].splitlines()), 3)

    def test_refusals(self):
        job = f"{self.service.address}/v1/jobs/{submit(self.service, PATH)}"
        for address, status in [(job + "/table.csv?format=json", 400), (job + "/table.csv?table=buckling", 400),
                                (self.service.address + "/v1/jobs/x/table.csv", 404),
                                (self.service.address + "/v1/sweeps/x/table.csv", 404),
                                (self.service.address + f"/v1/sweeps/{job[-36:]}/table.csv?format=csv", 400)]:
            self.assertEqual(send(address)[0], status, address)

    def test_a_key_comes_in_the_header(self):
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "keys.toml"
            config.write_text(f'[[keys]]\nowner = "ann"\nsha256 = "{hashlib.sha256(b"secret").hexdigest()}"\n')
            with Service(EXECUTABLE, "--config", str(config)) as service:
                job = submit(service, PATH, Authorization="Bearer secret")
                table = f"{service.address}/v1/jobs/{job}/table.csv"
                self.assertEqual(send(table)[0], 401)
                self.assertEqual(send(table, Authorization="Bearer secret")[0], 200)


class Workbook(unittest.TestCase):
    """The workbook in LibreOffice, against the service."""

    def test_it_is_what_the_program_writes(self):
        maker = ROOT / "clients/spreadsheet/make_workbook.py"
        subprocess.run([sys.executable, maker, "--check"], check=True)
        with tempfile.TemporaryDirectory() as folder:
            names = [f"{folder}/{i}.xlsx" for i in (1, 2)]
            for name in names:
                subprocess.run([sys.executable, maker, name], check=True)
            self.assertEqual(*(pathlib.Path(name).read_bytes() for name in names))
            with zipfile.ZipFile(names[0]) as archive:
                self.assertIsNone(archive.testzip())

    def office(self, steps, picture):
        done = subprocess.run([DEBIAN_PYTHON, ROOT / "tests/clients/spreadsheet/office.py", WORKBOOK, picture],
                              input=json.dumps(steps), capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    @unittest.skipUnless(shutil.which("soffice"), "needs libreoffice-calc-nogui and python3-uno")
    def test_its_numbers_are_those_of_the_service(self):
        inputs = [["set", "Pipe", f"B{row}", value] for row, value in [(6, 1.2), (7, 0.025), (8, 9e5), (9, 15000), (10, 12), (11, 3)]]
        with tempfile.TemporaryDirectory() as folder, Service(EXECUTABLE) as service:
            picture = pathlib.Path(folder) / "workbook.pdf"
            [[[request]]] = self.office([*inputs, ["recalculate"], ["get", "Pipe", "B14"]], picture)
            document = json.loads(request)
            self.assertEqual(document["model"]["sections"][0]["I"], float(f"{0.025**3 / 12:.15g}"))
            self.assertEqual(document["analysis"]["stop"]["monitor"]["range"], [-0.36, 0.12])
            job, sweep = submit(service, request.encode()), submit(service, SWEEP, "sweeps")
            send(f"{service.address}/v1/sweeps/{sweep}", Prefer="wait=60")
            result = result_of(service, job)
            steps = [*inputs, ["set", "Pipe", "B3", service.address], ["set", "Pipe", "B17", job], ["set", "Pipe", "B26", sweep],
                     ["recalculate"], ["get", "Pipe", "B20:B23"], ["get", "Path", "C4:D302"], ["get", "Sweep", "C3:G9"]]
            answers = self.office(steps, picture)
            self.check_pipe(answers[0], result)
            branch = result["branches"][0]
            points = [row for row in answers[1] if None not in row]
            self.assertEqual(points, [list(pair) for pair in zip(branch["monitors"]["crown"], branch["load_factor"])])
            _, _, text = send(f"{service.address}/v1/sweeps/{sweep}/table.csv")
            rows = list(csv.reader(io.StringIO(text)))
            self.assertEqual(answers[2][0], rows[0][:5])
            for shown, row in zip(answers[2][1:], rows[1:]):
                self.assertEqual([str(one) for one in shown], [one if not one or one[0].isalpha() else str(float(one)) for one in row[:5]])

    def check_pipe(self, cells, result):
        [[load], [kind], [pressure], [verdict]] = cells
        critical = result["summary"]["critical_load_factor"]
        self.assertEqual((load, kind), (critical, result["summary"]["critical_type"]))
        self.assertEqual(pressure, critical * 12)
        word = "enough" if critical >= 3 else "too little"
        self.assertEqual(verdict, f"{word}: {critical / 3:.2f} of what is required")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE.read_text(), re.DOTALL)


class M:
    """As much of Power Query's language as the page uses: definitions, texts, records, calls of the web."""

    def __init__(self, text, service, key, request):
        self.requests = []
        self.values = {"Service": service, "Key": key, "Request": request}
        body = text[text.index("let") + 3:text.rindex("\nin")]
        self.definitions = dict(re.findall(r"\n    (\w+) = (.*?)(?=,\n    \w+ =|\Z)", "\n" + body.strip("\n"), re.DOTALL))

    def text(self, expression):
        """The value of texts joined by &."""
        parts = []
        for term in (one.strip() for one in expression.split("&")):
            literal, field = re.fullmatch(r'"(.*)"', term), re.fullmatch(r"(\w+)\[(\w+)\]", term)
            parts.append(literal[1] if literal else self.values[field[1]][field[2]] if field else self.values[term])
        return "".join(parts)

    def web(self, name):
        """Does the request of a definition; its answer as a text."""
        call = re.search(r"Web\.Contents\(Service, \[(.*?)\]\)", self.definitions[name], re.DOTALL)[1]
        path = re.search(r"RelativePath = (.*?),\n", call)[1]
        listed = re.search(r"Headers = \[(.*?)\](?=,\n|$)", call, re.DOTALL)[1]
        headers = {(quoted or plain).replace("-", "_"): self.text(value) for quoted, plain, value in re.findall(
            r'(?:#"([\w-]+)"|(\w+)) = ((?:"[^"]*"|\w+)(?: & \w+)?)', listed)}
        content = re.search(r"Content = Text\.ToBinary\((\w+)\)", call)
        body = self.values[content[1]].encode() if content else None
        return send(f"{self.text('Service')}/{self.text(path)}", body, **headers)


class PowerQuery(unittest.TestCase):
    """The requests of the page's texts for Power Query, done as they say."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        config = pathlib.Path(folder.name) / "keys.toml"
        config.write_text(f'[[keys]]\nowner = "ann"\nsha256 = "{hashlib.sha256(b"secret").hexdigest()}"\n')
        self.service = Service(EXECUTABLE, "--config", str(config))
        self.service.__enter__()
        self.addCleanup(self.service.__exit__)
        self.request = PATH.decode()
        done = subprocess.run([EXECUTABLE, "solve", "-"], input=self.request, capture_output=True, text=True, check=True)
        self.result = json.loads(done.stdout)

    def query(self, text):
        self.assertIn('Service = "http://127.0.0.1:8080"', text)
        self.assertIn('Key = "KEY"', text)
        return M(text, self.service.address, "secret", self.request)

    def test_the_points_of_a_path(self):
        query = self.query(blocks("m")[0])
        self.assertEqual(list(query.definitions), ["Service", "Key", "Request", "Job", "Csv", "Points", "Names", "Filled",
                                                    "Typed"])
        status, _, text = query.web("Job")
        self.assertIn(status, (200, 201))
        query.values["Job"] = json.loads(text)
        status, headers, text = query.web("Csv")
        self.assertEqual((status, headers.get_content_type()), (200, "text/csv"))
        rows = list(csv.reader(io.StringIO(text)))
        numbers = [[float(one) if one else None for one in row] for row in rows[1:]]  # each column is of numbers
        branch = self.result["branches"][0]
        self.assertEqual([row[rows[0].index("load_factor")] for row in numbers], branch["load_factor"])
        self.assertEqual([row[rows[0].index("crown")] for row in numbers], branch["monitors"]["crown"])

    def test_the_summary_as_a_row(self):
        query = self.query(blocks("m")[1])
        status, _, text = query.web("Result")
        self.assertEqual(status, 200)
        names = re.findall(r'"(\w+)"', re.search(r"\{(.*?)\}", query.definitions["Summary"])[1])
        summary = json.loads(text)["summary"]
        self.assertEqual([summary[name] for name in names], [self.result["summary"][name] for name in names])
        self.assertIn("Result[summary]", query.definitions["Summary"])

    def test_a_wrong_request_is_422_and_a_wrong_key_401(self):
        self.request = "{}"
        query = self.query(blocks("m")[1])
        self.assertEqual(query.web("Result")[0], 422)
        query.values["Key"] = ""
        self.assertEqual(query.web("Result")[0], 401)


class ThePage(unittest.TestCase):
    """The commands of the page."""

    def test_curl_hands_the_request_in(self):
        [command] = re.findall(r"^ *(curl .*)$", PAGE.read_text(), re.MULTILINE)
        with tempfile.TemporaryDirectory() as folder, Service(EXECUTABLE) as service:
            (pathlib.Path(folder) / "request.json").write_bytes(PATH)
            done = subprocess.run(command.replace("http://127.0.0.1:8080", service.address), shell=True, cwd=folder,
                                  capture_output=True, text=True, check=True)
            self.assertIn("id", json.loads(done.stdout))

    def test_the_command_line_writes_the_same_tables(self):
        for command in re.findall(r"`(snapthrough (?:solve|sweep) --csv [^`]*)`", PAGE.read_text()):
            with tempfile.TemporaryDirectory() as folder:
                (pathlib.Path(folder) / "request.json").write_bytes(PATH)
                (pathlib.Path(folder) / "sweep.json").write_bytes(SWEEP)
                subprocess.run(command.replace("snapthrough", EXECUTABLE, 1), shell=True, cwd=folder, check=True)


if __name__ == "__main__":
    EXECUTABLE = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
