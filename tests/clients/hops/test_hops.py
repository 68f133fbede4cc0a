#!/usr/bin/env python3
"""Grasshopper at the service, by a client that was written from the source of Hops.

  test_hops.py EXECUTABLE [TEST...]
"""
import copy
import hashlib
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import threading
import unittest
import urllib.error
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/clients"))
from hops.hops_client import Component  # noqa: E402
from support.service import Service  # noqa: E402

EXECUTABLE = ""
PIPE = json.loads((ROOT / "examples/components/buried_pipe.json").read_text())

# The places of the pipe's inputs, and what is written there; by hand, from the file.
PLACES = {
    "diameter": [("/model/nodes/0/y", lambda d: -0.5 * d), ("/model/nodes/1/y", lambda d: 0.5 * d),
                 ("/analysis/stop/monitor/range/0", lambda d: -0.3 * d), ("/analysis/stop/monitor/range/1", lambda d: 0.1 * d)],
    "wall": [("/model/sections/0/A", lambda t: t), ("/model/sections/0/I", lambda t: t**3 * 0.08333333333333333)],
    "modulus": [("/model/sections/0/E", lambda e: e)],
    "soil": [("/model/foundations/0/stiffness", lambda k: k), ("/model/foundations/1/stiffness", lambda k: k)],
    "pressure": [("/model/loads/0/force/1", lambda p: -p), ("/model/loads/1/force/1", lambda p: -p)],
}
FIVE = {"diameter": 1.2, "wall": 0.025, "modulus": 9e5, "soil": 15000.0, "pressure": 12.0}


def pipe_request(values):
    """The request of the pipe with these values."""
    request = copy.deepcopy({"model": PIPE["model"], "analysis": PIPE["analysis"]})
    for name, value in values.items():
        for pointer, made in PLACES[name]:
            *path, last = [int(token) if token.isdigit() else token for token in pointer[1:].split("/")]
            place = request
            for token in path:
                place = place[token]
            place[last] = made(value)
    return request


def on_command_line(request):
    """The result of a request, by the command line."""
    done = subprocess.run([EXECUTABLE, "solve", "-"], input=json.dumps(request), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def read(address, key=None):
    headers = {"Authorization": f"Bearer {key}"} if key else {}
    with urllib.request.urlopen(urllib.request.Request(address, headers=headers)) as response:
        return json.load(response)


class AtTheService(unittest.TestCase):
    """Tests of one service without keys."""

    @classmethod
    def setUpClass(cls):
        cls.service = Service(EXECUTABLE, "--max-body-bytes", "300000").__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.service.__exit__()

    def component(self, name):
        return Component(f"{self.service.address}/v1/hops/{name}")

    def test_a_component_with_five_inputs_draws_a_path(self):
        pipe = self.component("buried_pipe")
        self.assertEqual(list(pipe.inputs), ["diameter", "wall", "modulus", "soil", "pressure"])
        answer = pipe.solve(**FIVE)
        self.assertEqual((answer.status, answer.errors), (200, []))
        result = on_command_line(pipe_request(FIVE))
        branch = result["branches"][0]
        drawn = answer.outputs["path"][(0, 0)]
        self.assertGreater(len(drawn), 20)
        self.assertEqual(drawn, [(x, y, 0.0) for x, y in zip(branch["monitors"]["crown"], branch["load_factor"])])
        self.assertEqual(answer.one("critical_load_factor"), result["summary"]["critical_load_factor"])
        self.assertEqual(answer.one("critical_type"), "limit_max")
        self.assertEqual(answer.one("message"), result["summary"]["message"])
        self.assertEqual(answer.one("crown"), result["critical_points"][0]["monitors"]["crown"])
        state = result["states"][result["critical_points"][0]["state"]]
        for branch, member in zip([(0,), (1,)], ["left", "right"]):
            shape = state["members"][member]
            self.assertEqual(answer.outputs["shape"][branch], [(x, y, 0.0) for x, y in zip(shape["x"], shape["y"])])
        stored = read(self.service.address + answer.one("job") + "/result")
        self.assertEqual(stored["summary"], result["summary"])

    def test_what_is_connected_to_nothing_has_the_first_value(self):
        pipe = self.component("buried_pipe")
        self.assertEqual(pipe.defaults(), {"diameter": 1, "wall": 0.02, "modulus": 800000, "soil": 20000, "pressure": 10})
        answer = pipe.solve()
        self.assertEqual(answer.one("critical_load_factor"), on_command_line(pipe_request({}))["summary"]["critical_load_factor"])

    def test_the_same_values_are_not_computed_again(self):
        pipe = self.component("buried_pipe")
        self.assertEqual(pipe.solve(soil=12345.0).one("job"), pipe.solve(soil=12345.0).one("job"))

    def expect_error(self, answer, *parts):
        self.assertGreaterEqual(answer.status, 400)
        self.assertEqual(answer.values, [])
        text = "\n".join(answer.errors)
        for part in parts:
            self.assertIn(part, text)
        self.assertNotIn("null", text)

    def test_wrong_values_are_told_with_their_input_and_the_rule(self):
        pipe = self.component("buried_pipe")
        rest = {name: value for name, value in pipe.defaults().items() if name != "soil"}
        for wrong, parts in [
                ({}, ["/soil: has no value"]),
                ({"soil": None}, ["/soil: has no value"]),
                ({"soil": "stiff"}, ["/soil: expected a number", "stiff"]),
                ({"soil": True}, ["/soil: expected a number", "true"]),
                ({"soil": float("nan")}, ["/soil: expected a number", "NaN"]),
                ({"soil": 999.0}, ["/soil: must be 1000 to 2e+05, got 999"]),
                ({"soil": [1e4, 2e4]}, ["/soil: has 2 values: it takes one"]),
                ({"sail": 2e4}, ["/sail: the component has no such input; did you mean soil?", "/soil: has no value"]),
                ({"soil": 2e4, "depth": 3.0}, ["/depth: the component has no such input"])]:
            with self.subTest(wrong=wrong):
                self.expect_error(pipe.post(pipe.document({**rest, **wrong})), *parts)
        twice = pipe.document(pipe.defaults())
        twice["values"].append(twice["values"][0])
        self.expect_error(pipe.post(twice), "/diameter: has two lists of values")

    def test_hops_itself_refuses_what_is_beyond_the_bounds(self):
        pipe = self.component("buried_pipe")
        self.assertEqual(pipe.refused_here({"soil": 999.0, "wall": 0.02, "modulus": -1.0}), ["soil"])

    def test_mistakes_of_the_request_name_the_input_that_made_them(self):
        self.expect_error(self.component("buried_pipe").solve(modulus=-1.0), "/model/sections/0/E: ", "(input modulus)")

    def test_an_analysis_that_fails_tells_why(self):
        component = self.component("solve-request")
        request = json.loads((ROOT / "examples/arch_no_base.json").read_text())
        request["analysis"] = {"type": "static", "load_factors": [1e6]}
        answer = component.solve(request=json.dumps(request))
        self.expect_error(answer, "The analysis could not be completed: ", "(beyond_critical_point)")

    def test_warnings_of_the_result_are_shown(self):
        component = self.component("solve-request")
        request = (ROOT / "examples/frame_nearly_unstable.json").read_text()
        answer = component.solve(request=request)
        self.assertEqual(answer.errors, [])
        self.assertEqual(answer.warnings, [one["detail"] for one in on_command_line(json.loads(request))["warnings"]])
        self.assertTrue(answer.warnings)

    def test_any_request_can_be_solved(self):
        component = self.component("solve-request")
        answer = component.solve()
        self.assertEqual(list(answer.outputs), ["critical_load_factor", "critical_type", "message", "result", "job"])
        expected = on_command_line(json.loads((ROOT / "examples/arch_outside_base_k1e7.json").read_text()))["summary"]
        self.assertEqual(answer.one("critical_load_factor"), expected["critical_load_factor"])
        self.expect_error(component.solve(request="{"), "line 1")
        self.expect_error(component.solve(request='{"model": {}, "analysis": {"type": "critical"}}'), "/model/nodes: ",
                          "(input request)")
        self.expect_error(component.solve(request=""), "/request: is empty")
        self.expect_error(component.solve(request=3.0), "/request: expected a text")

    def test_a_result_without_a_value_is_no_value_and_a_warning(self):
        request = json.loads((ROOT / "examples/arch_no_base.json").read_text())
        request["analysis"] = {"type": "static", "load_factors": [0.1]}
        answer = self.component("solve-request").solve(request=json.dumps(request))
        self.assertIsNone(answer.one("critical_load_factor"))
        self.assertIn("critical_load_factor: 1 value of /summary/critical_load_factor of the result are null and left out",
                      answer.warnings)

    def test_any_branch_of_a_tree_may_hold_the_value(self):
        pipe = self.component("buried_pipe")
        answer = pipe.post(pipe.document(pipe.defaults(), path="{0;3}"))
        self.assertEqual(answer.errors, [])

    def test_other_addresses_of_the_protocol(self):
        pipe = self.component("buried_pipe")
        document = pipe.document(pipe.defaults())
        load = pipe.solve().one("critical_load_factor")
        for path in ["/v1/hops/solve", "/v1/hops/buried_pipe"]:
            self.assertEqual(pipe.post(document, path).one("critical_load_factor"), load)
        listed = read(self.service.address + "/v1/hops")
        self.assertEqual([one["Uri"] for one in listed], ["/buried_pipe", "/solve-request"])
        self.assertEqual(listed[0]["Inputs"][3]["Minimum"], 1000)

    def test_a_component_that_is_not_there(self):
        missing = self.component("tower")
        self.assertEqual(missing.inputs, {})
        self.assertIn('"tower"', missing.errors[0])
        self.assertIn("buried_pipe", missing.errors[0])
        self.expect_error(missing.post(missing.document({})), "No such component")

    def test_bodies_of_no_use_are_refused_in_the_words_of_the_protocol(self):
        pipe = self.component("buried_pipe")
        good = pipe.document(pipe.defaults())
        item = {"type": "System.Double", "data": "1"}
        values = [None, 3, "x", {}, [], [3], [{}], [None], [{"ParamName": "soil"}], [{"ParamName": 3, "InnerTree": {}}],
                  [{"ParamName": "soil", "InnerTree": []}], [{"ParamName": "soil", "InnerTree": {"{0}": 3}}],
                  [{"ParamName": "soil", "InnerTree": {"{0}": [3]}}], [{"ParamName": "soil", "InnerTree": {"{0}": [{}]}}],
                  [{"ParamName": "soil", "InnerTree": {"{0}": [{"type": "System.Double", "data": 1}]}}],
                  [{"ParamName": "soil", "InnerTree": {"{0}": [{"type": "System.Double", "data": "[" * 10000}]}}],
                  [{"ParamName": "soil", "InnerTree": {"{0}": [item] * 5000}}]]
        bodies = ["", "{", "[]", "3", "null", "[" * 100000, '{"a": 1, "a": 2}', b"\xff\xfe", "x" * 100]
        bodies += [{**good, "values": one} for one in values] + [{**good, "pointer": one} for one in (None, 3, "", "/", "x/y", {})]
        bodies += [{**good, "algo": "UEsDBBQ="}]
        for body in bodies:
            with self.subTest(body=str(body)[:80]):
                answer = pipe.post(body)
                self.assertIn(answer.status, (400, 404, 422))
                self.assertTrue(answer.errors)
        self.assertEqual(pipe.post(" " * 300001).status, 413)
        self.assertEqual(pipe.post("{}", headers={"Content-Type": "text/plain"}).status, 415)

    def test_documents_that_are_spoilt_at_random_are_answered_or_refused(self):
        seed = random.randrange(2**32)
        rng = random.Random(seed)
        pipe = self.component("buried_pipe")
        text = json.dumps(pipe.document(pipe.defaults()))
        statuses = {}
        for _ in range(1500):
            spoilt = list(text)
            for _ in range(rng.randint(1, 4)):
                place = rng.randrange(len(spoilt))
                choice = rng.random()
                if choice < 0.4:
                    spoilt[place] = rng.choice('{}[]",:0123456789.eE-truefalsn \\é\0')
                elif choice < 0.7:
                    del spoilt[place:place + rng.randint(1, 12)]
                else:
                    spoilt[place:place] = spoilt[rng.randrange(len(spoilt)):][:rng.randint(1, 30)]
                spoilt = spoilt or ["{"]
            answer = pipe.post("".join(spoilt))
            self.assertIn(answer.status, (200, 400, 404, 422), f"seed {seed}: {''.join(spoilt)}")
            self.assertEqual(answer.status == 200, not answer.errors)
            statuses[answer.status] = statuses.get(answer.status, 0) + 1
        self.assertGreater(statuses[400], 100, statuses)
        self.assertGreater(statuses[422], 50, statuses)
        self.assertFalse([line for line in self.service.log if '"event":"trouble"' in line])


ARCH = {
    "model": {
        "title": "arch through points",
        "nodes": [{"id": "a", "x": -5, "y": 0}, {"id": "b", "x": 5, "y": 0}],
        "sections": [{"id": "s", "EA": 1e6, "EI": 100}],
        "members": [{"id": "arch", "start": "a", "end": "b", "section": "s",
                     "curve": {"type": "points", "points": [[-2.5, 1], [0, 1.4], [2.5, 1]]}}],
        "supports": [{"node": "a", "fixed": ["x", "y"]}, {"node": "b", "fixed": ["x", "y"]}],
        "loads": [{"type": "point", "at": {"member": "arch", "fraction": 0.5}, "force": [0, -1]}],
        "monitors": [{"id": "crown", "at": {"member": "arch", "fraction": 0.5}, "component": "y"},
                     {"id": "sway", "at": {"member": "arch", "fraction": 0.5}, "component": "x"}]},
    "analysis": {"type": "static", "load_factors": [1, 2], "discretization": {"elements": 16, "order": 2},
                 "output": {"extremes": False}},
    "parameters": [
        {"name": "axis", "targets": [{"pointer": "/model/members/0/curve/points"}], "values": [[[-2.5, 1], [0, 1.4], [2.5, 1]]]},
        {"name": "feet", "targets": [{"pointer": "/model/supports"}], "label": ["pinned", "clamped"],
         "values": [[{"node": n, "fixed": ["x", "y"]} for n in "ab"],
                    [{"node": n, "fixed": ["x", "y", "rotation"]} for n in "ab"]]},
        {"name": "elements", "targets": [{"pointer": "/analysis/discretization/elements"}], "values": [16, 4, 64]},
        {"name": "factors", "targets": [{"pointer": "/analysis/load_factors"}], "values": [[1, 2]]},
        {"name": "extremes", "targets": [{"pointer": "/analysis/output/extremes"}], "values": [False, True]},
        {"name": "title", "targets": [{"pointer": "/model/title"}], "values": ["arch through points"]}],
    "design": "grid",
    "outputs": ["/static/load_factor", "/static/monitors/crown", "/static/negative_eigenvalues", "/discretization/elements",
                "/states/0/members/arch/x", "/summary", "/model/title", "/warnings"],
}


class ComponentsOfAFolder(unittest.TestCase):
    """Tests of components that somebody wrote."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.write("arch", ARCH)

    def write(self, name, document):
        text = document if isinstance(document, str) else json.dumps(document)
        (pathlib.Path(self.folder.name) / f"{name}.json").write_text(text)

    def service(self, *options):
        service = Service(EXECUTABLE, "--hops-folder", self.folder.name, *options)
        self.addCleanup(service.__exit__)
        return service.__enter__()

    def test_every_kind_of_input_and_output(self):
        service = self.service()
        arch = Component(service.address + "/v1/hops/arch")
        self.assertEqual({name: one["ParamType"] for name, one in arch.inputs.items()},
                         {"axis": "Point", "feet": "Text", "elements": "Integer", "factors": "Number", "extremes": "Boolean",
                          "title": "Text"})
        self.assertEqual(arch.defaults()["axis"], [(-2.5, 1, 0.0), (0, 1.4, 0.0), (2.5, 1, 0.0)])
        changed = {"axis": [(-2.0, 1.5, 0.0), (2.0, 1.5, 0.0)], "feet": "clamped", "elements": 24, "factors": [0.5, 1.0, 1.5],
                   "extremes": True, "title": 'a "quoted" title'}
        answer = arch.solve(**changed)
        self.assertEqual(answer.errors, [])
        request = {"model": copy.deepcopy(ARCH["model"]), "analysis": copy.deepcopy(ARCH["analysis"])}
        request["model"]["members"][0]["curve"]["points"] = [[-2.0, 1.5], [2.0, 1.5]]
        request["model"]["supports"] = ARCH["parameters"][1]["values"][1]
        request["analysis"]["discretization"]["elements"] = 24
        request["analysis"]["load_factors"] = [0.5, 1.0, 1.5]
        result = on_command_line(request)
        self.assertEqual(answer.outputs["load_factor"], {(0,): [0.5, 1.0, 1.5]})
        self.assertEqual(answer.outputs["crown"], {(0,): result["static"]["monitors"]["crown"]})
        self.assertEqual(answer.outputs["negative_eigenvalues"], {(0,): [0, 0, 0]})
        self.assertEqual(answer.outputs["path"][(0, 1)],
                         [(x, y, 0.0) for x, y in zip(result["static"]["monitors"]["sway"], result["static"]["load_factor"])])
        self.assertEqual(answer.outputs["x"], {(0,): result["states"][0]["members"]["arch"]["x"]})
        self.assertIn("termination", answer.one("summary"))

    def test_wrong_values_of_every_kind(self):
        service = self.service()
        arch = Component(service.address + "/v1/hops/arch")
        for wrong, part in [({"axis": [(0.0, 1.0, 0.5)]}, "/axis: structures are plane: points have Z = 0"),
                            ({"axis": []}, "/axis: has no value"),
                            ({"feet": "hinged"}, '/feet: expected one of pinned, clamped, got "hinged"'),
                            ({"elements": 8.5}, "/elements: expected a whole number"),
                            ({"elements": 65}, "/elements: must be 4 to 64, got 65"),
                            ({"extremes": 1}, "/extremes: expected true or false")]:
            with self.subTest(wrong=wrong):
                answer = arch.solve(**wrong)
                self.assertEqual(answer.status, 422)
                self.assertIn(part, "\n".join(answer.errors))
        two = arch.document(arch.defaults())
        tree = next(one for one in two["values"] if one["ParamName"] == "axis")["InnerTree"]
        tree["{1}"] = tree["{0}"]
        self.assertIn("/axis: has several lists: it takes one", arch.post(two).errors)

    def test_a_file_that_changes_is_read_again(self):
        service = self.service()
        self.assertEqual(len(Component(service.address + "/v1/hops/arch").inputs), 6)
        self.write("arch", {**ARCH, "parameters": ARCH["parameters"][:2]})
        self.assertEqual(list(Component(service.address + "/v1/hops/arch").inputs), ["axis", "feet"])

    def test_a_queue_that_is_full(self):
        service = self.service("--workers", "1", "--max-queue", "1")
        long = json.loads((ROOT / "tests/clients/requests/cancelled.json").read_text())
        accepted = 0
        while accepted < 2:  # one that runs and one that waits; the first may be counted as waiting for a moment more
            long["model"]["title"] = str(accepted)
            request = urllib.request.Request(service.address + "/v1/jobs", json.dumps(long).encode(),
                                             {"Content-Type": "application/json", "Prefer": "respond-async"})
            try:
                accepted += json.load(urllib.request.urlopen(request))["status"] in ("accepted", "running")
            except urllib.error.HTTPError as error:
                self.assertEqual((accepted, error.code), (1, 429))
                error.close()
        answer = Component(service.address + "/v1/hops/buried_pipe").solve()
        self.assertEqual(answer.status, 429)
        self.assertIn("Queue full: ", answer.errors[0])

    def test_large_files_and_large_calls_do_not_wait_for_each_other(self):
        service = self.service()
        done = []

        def read_changed_files():
            for i in range(30):
                self.write("arch", {**ARCH, "model": {**ARCH["model"], "title": f"{i} " + "x" * 300000}})
                done.append(Component(service.address + "/v1/hops/arch").errors)

        def call():
            for _ in range(10):
                arch = Component(service.address + "/v1/hops/arch")
                text = json.dumps(arch.document({**arch.defaults(), "title": "y" * 300000}))
                done.append(arch.post(text).errors)

        threads = [threading.Thread(target=one, daemon=True) for one in (read_changed_files, call, call, call)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(240)
        self.assertEqual(len(done), 60)

    def test_a_file_that_is_wrong_says_so_at_the_component(self):
        wrong = {**ARCH, "outputs": ["/summary/critical_load"]}
        for name, document, part in [("typo", wrong, "/outputs/0: "), ("text", "{", "line 1"), ("large", " " * 1100000, "1 MB"),
                                     ("object", {**ARCH, "parameters": [{**ARCH["parameters"][1], "label": None}]}, "label")]:
            if isinstance(document, dict) and document["parameters"][0].get("label", "") is None:
                document["parameters"][0].pop("label")
            self.write(name, document)
            service = self.service()
            component = Component(f"{service.address}/v1/hops/{name}")
            self.assertIn(part, "\n".join(component.errors))
            self.assertEqual(component.inputs, {})
            answer = component.post(component.document({}))
            self.assertEqual(answer.status, 500)
            self.assertIn("The file of this component is wrong", answer.errors[0])

    def test_names_do_not_lead_out_of_the_folder(self):
        service = self.service()
        (pathlib.Path(self.folder.name).parent / "outside.json").write_text(json.dumps(ARCH))
        for name in ["..%2Foutside", ".hidden", "", "%2e%2e", "arch.json", "x" * 5000]:
            component = Component(f"{service.address}/v1/hops/{name}") if name else None
            self.assertFalse(component and component.inputs)
        (pathlib.Path(self.folder.name).parent / "outside.json").unlink()

    def test_a_folder_that_is_not_there_is_told_at_the_start(self):
        done = subprocess.run([EXECUTABLE, "serve", "--listen", "127.0.0.1:0", "--store", f"{self.folder.name}/s.db",
                               "--hops-folder", "/nowhere"], capture_output=True, text=True, timeout=120, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("hops_folder", done.stderr)

    def test_an_analysis_that_takes_longer_than_the_wait(self):
        service = self.service("--default-wait-s", "0", "--longest-wait-s", "0")
        component = Component(service.address + "/v1/hops/solve-request")
        answer = component.solve(request=(ROOT / "tests/clients/requests/cancelled.json").read_text())
        self.assertEqual(answer.status, 503)
        self.assertIn("The same inputs are answered at once", answer.errors[0])
        self.assertIn("/v1/jobs/", answer.errors[0])


class ThePage(unittest.TestCase):
    """docs/howto/use-in-grasshopper.md."""

    def test_its_commands_and_messages(self):
        page = (ROOT / "docs/howto/use-in-grasshopper.md").read_text()
        described, wrong = [line for line in page.splitlines() if line.startswith("curl ")]
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "arch.json").write_text(json.dumps(ARCH))
            with Service(EXECUTABLE, "--hops-folder", folder) as service:
                def run(command):
                    there = command.replace("http://127.0.0.1:8080", service.address)
                    return json.loads(subprocess.run(there, shell=True, capture_output=True, check=True).stdout)
                self.assertEqual([one["Name"] for one in run(described)["Inputs"]], list(PLACES))
                self.assertEqual([error.split(":")[0] for error in run(wrong)["errors"]], ["/model", "/analysis"])
                for name in re.findall(r"http://127.0.0.1:8080/v1/hops/([\w-]+)`", page):
                    self.assertTrue(Component(f"{service.address}/v1/hops/{name}").inputs, name)
                pipe = Component(f"{service.address}/v1/hops/buried_pipe")
                messages = pipe.solve(soil=999.0).errors + pipe.solve(modulus=-1.0).errors
                self.assertIn("```\n" + "\n".join(messages) + "\n```", page)


class Keys(unittest.TestCase):
    """Tests of a service with keys."""

    def test_descriptions_need_no_key_and_calls_do(self):
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "keys.toml"
            config.write_text("".join(f'[[keys]]\nowner = "{owner}"\nsha256 = "{hashlib.sha256(owner.encode()).hexdigest()}"\n'
                                      for owner in ("ann", "bob")))
            with Service(EXECUTABLE, "--config", str(config)) as service:
                address = service.address + "/v1/hops/buried_pipe"
                for key in (None, "", "wrong"):
                    refused = Component(address, key=key).solve()
                    self.assertEqual(refused.status, 401)
                    self.assertIn("RhinoComputeKey", refused.errors[0])
                answer = Component(address, key="ann").solve()
                self.assertEqual(answer.status, 200)
                job = service.address + answer.one("job")
                self.assertEqual(read(job, "ann")["status"], "successful")
                with self.assertRaises(urllib.error.HTTPError):
                    read(job, "bob")
                bearer = Component(address)
                document = bearer.document(bearer.defaults())
                self.assertEqual(bearer.post(document, headers={"Authorization": "Bearer ann"}).status, 200)
                wrong = bearer.post(document, headers={"Authorization": "Bearer x", "RhinoComputeKey": "ann"})
                self.assertEqual(wrong.status, 401)


if __name__ == "__main__":
    EXECUTABLE = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
