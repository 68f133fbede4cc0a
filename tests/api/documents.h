#pragma once
/// @file
/// Request documents for the tests of reading.

#include <string>

namespace snapthrough::testing {

/// A small request that every version of the solver supports.
inline const char* sound_document() {
  return R"({
    "model": {
      "title": "beam",
      "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 2, "y": 0}],
      "sections": [{"id": "steel", "EA": 1e4, "EI": 10}],
      "members": [{"id": "ab", "start": "a", "end": "b", "section": "steel"}],
      "supports": [{"node": "a", "fixed": ["x", "y"]}, {"node": "b", "fixed": ["y"]}],
      "springs": [{"id": "s1", "at": {"node": "b"}, "direction": [0, 1], "stiffness": 5}],
      "foundations": [{"id": "soil", "member": "ab", "stiffness": 3}],
      "loads": [{"type": "point", "at": {"node": "b"}, "force": [-1, 0]}],
      "imperfections": [{"type": "sine", "member": "ab", "half_waves": 1, "amplitude": 1e-4}],
      "monitors": [{"id": "mid", "at": {"member": "ab", "fraction": 0.5}, "component": "normal"}]
    },
    "analysis": {
      "type": "path",
      "discretization": {"elements": 8, "order": 2},
      "stop": {"steps": 10},
      "output": {"states": "none"}
    }
  })";
}

/// Every field of the contract's model, nothing at its default.
inline const char* full_model() {
  return R"({
    "title": "everything", "units": {"length": "m", "force": "kN"},
    "nodes": [{"id": "a", "x": -1.5, "y": 2}, {"id": "b", "x": 3, "y": 4.25}],
    "sections": [{"id": "s", "EA": 100, "EI": 2, "GA": 30},
                 {"id": "t", "E": 200, "A": 0.5, "I": 0.25, "nu": 0.25, "shear_area": 0.4},
                 {"id": "u", "E": 200, "A": 0.5, "I": 0.25}],
    "members": [{"id": "m0", "start": "a", "end": "b", "section": "s", "curve": {"type": "line"},
                 "release": {"start": ["rotation"], "end": []}},
                {"id": "m1", "start": "a", "end": "b", "section": "t",
                 "curve": {"type": "arc", "sweep_degrees": -20}, "release": {"end": ["rotation"]}},
                {"id": "m2", "start": "a", "end": "b", "section": "s", "curve": {"type": "parabola", "rise": 0.5},
                 "reaction": "compression_only"},
                {"id": "m3", "start": "a", "end": "b", "section": "s",
                 "curve": {"type": "sine", "rise": 0.25, "half_waves": 3}},
                {"id": "m4", "start": "a", "end": "b", "section": "s",
                 "curve": {"type": "points", "points": [[0, 3], [1, 3.5]]}}],
    "supports": [{"node": "a", "fixed": ["x", "rotation"], "angle_degrees": 30,
                  "displacement": {"x": 0.1, "y": 0.2, "rotation": 0.3, "pattern": "constant"}},
                 {"node": "b", "fixed": ["y"], "displacement": {"y": 0.5}, "pattern": "constant"}],
    "springs": [{"id": "k0", "at": {"member": "m0", "fraction": 0.25}, "direction": [0, -2], "stiffness": 5,
                 "reaction": "tension_only", "gap": 0.125},
                {"id": "k1", "at": {"node": "b"}, "to": {"node": "a"}, "direction": "rotation", "stiffness": 6}],
    "foundations": [{"id": "f0", "member": "m0", "stiffness": 7, "shear_stiffness": 8, "reaction": "compression_only",
                     "side": "right", "range": [0.1, 0.9], "gap": 0.01, "direction": "normal"},
                    {"id": "f1", "member": "m1", "stiffness": 9, "direction": [1, 2]}],
    "loads": [{"type": "point", "at": {"node": "b"}, "force": [1, 2], "moment": 3, "pattern": "constant"},
              {"type": "distributed", "member": "m0", "force": [4, 5], "range": [0.2, 0.8], "per": "horizontal",
               "pattern": "constant"},
              {"type": "pressure", "member": "m1", "value": 6, "side": "right", "pattern": "constant"},
              {"type": "initial_strain", "member": "m0", "axial": 0.001, "curvature": 0.002, "pattern": "constant"}],
    "imperfections": [{"type": "sine", "member": "m0", "half_waves": 2, "amplitude": 0.1},
                      {"type": "mode", "number": 3, "amplitude": 0.2},
                      {"type": "points", "member": "m1", "offsets": [[0, 0.5], [1, 0.25]]},
                      {"type": "worst", "norm": "max", "amplitude": 0.3}],
    "monitors": [{"id": "d0", "at": {"member": "m0", "fraction": 0.75}, "component": "normal"},
                 {"id": "d1", "at": {"node": "a"}, "component": "rotation"}]
  })";
}

}  // namespace snapthrough::testing
