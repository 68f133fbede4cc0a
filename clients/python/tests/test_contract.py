"""The package follows the contract: generated files, builders, attributes, documentation."""
import dataclasses
import inspect
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from .support import EXPECTED, PACKAGE, ROOT, Case, column, local, request, snapthrough

CONTRACT = json.loads((ROOT / "api" / "openapi" / "openapi.json").read_text(encoding="utf-8"))
SCHEMAS = CONTRACT["components"]["schemas"]


class Generated(Case):
    def test_a_new_field_of_the_contract_appears_by_itself(self):
        sys.path.insert(0, str(PACKAGE))
        self.addCleanup(sys.path.remove, str(PACKAGE))
        import generate
        document = json.loads(json.dumps(CONTRACT))
        schemas = document["components"]["schemas"]
        colour = {"type": "string", "description": "Colour of it", "x-unit": "nanometre"}
        for name in ("Node", "Summary"):
            schemas[name]["properties"]["colour"] = colour
        schemas["Analysis"]["properties"]["colour"] = {**colour, "description": "path: colour of the path"}
        schemas["Load"]["oneOf"].append({"type": "object", "description": "A wind", "properties": {
            "type": {"const": "wind", "description": "A wind"}, "from": colour}, "required": ["type", "from"]})
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "openapi.json")
            path.write_text(json.dumps(document), encoding="utf-8")
            contract = generate.Contract(path)
        builders = generate.Builders(contract).text()
        self.assertIn("def node(self: _Self, id: documents.Id, x: float, y: float, *, colour: Optional[str] = None)",
                      builders)
        self.assertIn("colour: Colour of it [nanometre].", builders)
        self.assertIn("def wind_load(self: _Self, from_: str) -> _Self:", builders)
        self.assertIn('{"type": "wind", "from": from_}', builders)
        self.assertEqual(builders.count("    colour: colour of the path"), 1)  # of Path, and of no other analysis
        self.assertIn("def colour(self)", generate.Received(contract).text())
        self.assertIn("    colour: str", generate.Documents(contract).text())

    def test_every_field_of_an_analysis_is_that_of_a_builder(self):
        builders = (snapthrough.Buckling, snapthrough.Critical, snapthrough.Path, snapthrough.Static,
                    snapthrough.Vibration)
        fields = {field.name for builder in builders for field in dataclasses.fields(builder)}
        self.assertEqual(fields | {"type"}, set(SCHEMAS["Analysis"]["properties"]))

    def test_every_list_of_a_model_has_a_builder(self):
        model = snapthrough.Model()
        self.assertEqual({field.name for field in dataclasses.fields(model)}, set(SCHEMAS["Model"]["properties"]))
        for load in SCHEMAS["Load"]["oneOf"]:
            self.assertTrue(callable(getattr(model, load["properties"]["type"]["const"] + "_load")))


class Builders(Case):
    def test_a_model_is_exactly_the_document(self):
        model = (snapthrough.Model("All of it", units={"length": "m"})
                 .node("a", 0, 0).node("b", 4, 0).node("c", 8, 0)
                 .section("s", EA=1e6, EI=100).section("t", E=2.1e8, A=5e-3, I=3e-5, nu=0.3, shear_area=4e-3)
                 .member("m", "a", "b", "s", release={"end": ["rotation"]}).arc_member("n", "b", "c", "t", -20)
                 .sine_member("o", "a", "c", "s", 0.1, half_waves=3)
                 .support("a", ["x", "y"], angle_degrees=30).support("c", ["y"], displacement={"y": 0.01})
                 .spring("k", ("m", 0.5), [0, -1], 50, reaction="compression_only", gap=0.01)
                 .spring("r", "b", "rotation", 5)
                 .foundation("f", "m", 10, shear_stiffness=2).foundation("g", "n", 20, direction=[0, -1])
                 .point_load("b", [0, -1], moment=2).distributed_load("m", [0, -3], per="horizontal", range=[0, 0.5])
                 .pressure_load("n", 4, side="right").initial_strain_load("m", axial=1e-4, pattern="constant")
                 .sine_imperfection("m", 1, 1e-3).mode_imperfection(1, 2e-3)
                 .points_imperfection("n", [[0, 0], [1, 1e-3]])
                 .monitor("d", {"member": "m", "fraction": 0.25}, "normal"))
        self.assertEqual(json.loads(json.dumps(model.document)), {
            "title": "All of it", "units": {"length": "m"},
            "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 4, "y": 0}, {"id": "c", "x": 8, "y": 0}],
            "sections": [{"id": "s", "EA": 1e6, "EI": 100},
                         {"id": "t", "E": 2.1e8, "A": 5e-3, "I": 3e-5, "nu": 0.3, "shear_area": 4e-3}],
            "members": [
                {"id": "m", "start": "a", "end": "b", "section": "s", "release": {"end": ["rotation"]}},
                {"id": "n", "start": "b", "end": "c", "section": "t", "curve": {"type": "arc", "sweep_degrees": -20}},
                {"id": "o", "start": "a", "end": "c", "section": "s",
                 "curve": {"type": "sine", "rise": 0.1, "half_waves": 3}}],
            "supports": [{"node": "a", "fixed": ["x", "y"], "angle_degrees": 30},
                         {"node": "c", "fixed": ["y"], "displacement": {"y": 0.01}}],
            "springs": [{"id": "k", "at": {"member": "m", "fraction": 0.5}, "direction": [0, -1], "stiffness": 50,
                         "reaction": "compression_only", "gap": 0.01},
                        {"id": "r", "at": {"node": "b"}, "direction": "rotation", "stiffness": 5}],
            "foundations": [{"id": "f", "member": "m", "stiffness": 10, "shear_stiffness": 2},
                            {"id": "g", "member": "n", "stiffness": 20, "direction": [0, -1]}],
            "loads": [{"type": "point", "at": {"node": "b"}, "force": [0, -1], "moment": 2},
                      {"type": "distributed", "member": "m", "force": [0, -3], "per": "horizontal", "range": [0, 0.5]},
                      {"type": "pressure", "member": "n", "value": 4, "side": "right"},
                      {"type": "initial_strain", "member": "m", "axial": 1e-4, "pattern": "constant"}],
            "imperfections": [{"type": "sine", "member": "m", "half_waves": 1, "amplitude": 1e-3},
                              {"type": "mode", "number": 1, "amplitude": 2e-3},
                              {"type": "points", "member": "n", "offsets": [[0, 0], [1, 1e-3]]}],
            "monitors": [{"id": "d", "at": {"member": "m", "fraction": 0.25}, "component": "normal"}]})
        check = local().check(model, snapthrough.Path())
        self.assertTrue(check.valid, check.errors)

    def test_an_arch_by_its_rise_has_that_rise(self):
        model = (snapthrough.Model().node("a", 1, 2).node("b", 5, 2).section("s", EA=1e6, EI=100)
                 .arch("arch", "a", "b", "s", 0.5).support("a", ["x", "y"]).support("b", ["x", "y"])
                 .point_load(("arch", 0.5), [0, -1]))
        state = local().solve(model, snapthrough.Static(load_factors=[0.01])).states[0]
        self.assertAlmostEqual(max(state.members["arch"].y0), 2.5, places=9)

    def test_an_arch_needs_its_nodes_and_a_rise(self):
        with self.assertRaisesRegex(ValueError, "no node 'b'"):
            snapthrough.Model().node("a", 0, 0).arch("arch", "a", "b", "s", 1)
        with self.assertRaisesRegex(ValueError, "rise"):
            snapthrough.Model().node("a", 0, 0).node("b", 1, 0).arch("arch", "a", "b", "s", 0)

    def test_analyses_leave_out_what_is_none(self):
        self.assertEqual(snapthrough.Critical().document, {"type": "critical"})
        self.assertEqual(snapthrough.Path(stop={"limit_points": 2}, control="load").document,
                         {"type": "path", "stop": {"limit_points": 2}, "control": "load"})
        self.assertEqual(snapthrough.Buckling(modes=3, reversed=True).document,
                         {"type": "buckling", "modes": 3, "reversed": True})

    def test_a_vibration_is_exactly_the_document(self):
        model = snapthrough.Model(damping={"stiffness": 1e-3}).mass("tip", mass=2).mass(("m", 0.5), inertia=0.1)
        model.point_load("tip", [-1, 0], follows=True)
        self.assertEqual(model.document["masses"], [{"at": {"node": "tip"}, "mass": 2},
                                                    {"at": {"member": "m", "fraction": 0.5}, "inertia": 0.1}])
        self.assertEqual(model.document["damping"], {"stiffness": 1e-3})
        self.assertTrue(model.document["loads"][0]["follows"])
        self.assertEqual(snapthrough.Vibration(modes=3, load_factors=[0, 1]).document,
                         {"type": "vibration", "modes": 3, "load_factors": [0, 1]})

    def test_a_sweep_is_exactly_the_document(self):
        sweep = snapthrough.Sweep(column(), snapthrough.Critical(), "grid", ["/summary/critical_load_factor"])
        sweep.parameter("K", "/model/foundations/0/stiffness", range={"from": 1, "to": 10, "count": 3})
        sweep.parameter("EI", [{"pointer": "/model/sections/0/EI", "scale": 2.0}, "/model/sections/0/EA"],
                        values=[1, 2])
        self.assertEqual(sweep.document["parameters"], [
            {"name": "K", "targets": [{"pointer": "/model/foundations/0/stiffness"}],
             "range": {"from": 1, "to": 10, "count": 3}},
            {"name": "EI", "targets": [{"pointer": "/model/sections/0/EI", "scale": 2.0},
                                       {"pointer": "/model/sections/0/EA"}], "values": [1, 2]}])
        self.assertEqual(sweep.document["model"], column().document)
        self.assertEqual(len(local().sweep(sweep).table()), 6)

    def test_numbers_that_are_not_finite_are_refused(self):
        with self.assertRaises(ValueError):
            local().solve(column().point_load("head", [0, float("nan")]), snapthrough.Critical())

    def test_a_model_without_an_analysis_is_told(self):
        with self.assertRaisesRegex(TypeError, "analysis"):
            local().solve(column())


class Attributes(Case):
    def compare(self, part, document, path):
        """Every field of the document is an attribute with its value, all the way down."""
        if isinstance(document, dict) and isinstance(part, snapthrough.results.Part):
            for name, value in document.items():
                attribute = name + "_" if name == "from" else name
                self.compare(getattr(part, attribute), value, f"{path}/{name}")
        elif isinstance(document, dict):
            self.assertEqual(list(part), list(document), path)
            for name, value in document.items():
                self.compare(part[name], value, f"{path}/{name}")
        elif isinstance(document, list):
            self.assertEqual(len(part), len(document), path)
            for index, value in enumerate(document):
                self.compare(part[index], value, f"{path}/{index}")
        else:
            self.assertEqual(part, document, path)

    def test_every_field_of_results_is_an_attribute(self):
        for name, expected in EXPECTED.items():
            if expected["outcome"] == "done":
                result = local().solve(request(name))
                self.compare(result, json.loads(result.json), name)

    def test_every_field_of_the_contract_is_an_attribute(self):
        for name, schema in SCHEMAS.items():
            made = getattr(snapthrough.results, "ResultFields" if name == "Result" else name, None)
            if made is None or "properties" not in schema:
                continue
            for field in schema["properties"]:
                self.assertIsInstance(inspect.getattr_static(made, field + "_" * (field == "from")), property,
                                      f"{name}.{field}")

    def test_a_field_that_is_absent_is_none_and_a_wrong_name_an_error(self):
        result = local().solve(column(), snapthrough.Critical())
        self.assertIsNone(result.static)
        self.assertIsNone(result.failure)
        with self.assertRaisesRegex(AttributeError, "sumary"):
            result.sumary


class Documentation(Case):
    def test_every_public_name_has_a_docstring(self):
        missing = []
        modules = [("snapthrough", snapthrough, snapthrough.__all__)]
        modules += [(f"snapthrough.{module.__name__}", module, module.__all__)
                    for module in (snapthrough.documents, snapthrough.results)]
        for prefix, module, names in modules:
            self.assertTrue(module.__doc__)
            for name in names:
                value = getattr(module, name)
                if inspect.isclass(value) or inspect.isfunction(value):
                    missing += [f"{prefix}.{name}"] * (not value.__doc__)
                if inspect.isclass(value) and module is not snapthrough.documents:
                    missing += [f"{prefix}.{name}.{member}" for member, own in vars(value).items()
                                if not member.startswith("_") and (callable(own) or isinstance(own, property))
                                and not inspect.getdoc(own)]
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()
