/// The tools with the schemas of their arguments, made from the published interface.

#include <array>
#include <nlohmann/json.hpp>

#include "api/names.h"
#include "api/openapi/schemas.h"
#include "api/plot/plot_request.h"
#include "server/mcp/tools.h"
#include "solver/model/limits.h"

namespace snapthrough::server::mcp {
namespace {

using nlohmann::json;

json text_field(const char* description) { return {{"type", "string"}, {"description", description}}; }
json flag_field(const char* description) { return {{"type", "boolean"}, {"description", description}}; }
json whole_field(const char* description) {
  return {{"type", "integer"}, {"minimum", 0}, {"description", description}};
}
json object_schema(const json& properties, const json& required) {
  return {{"type", "object"},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

/// Schema of a sweep whose model and analysis are as solve takes them, so that they are described once.
json sweep_schema() {
  json schema =
      api::standalone_schema("SweepDocument", {"Model", "Analysis", "ModelTemplate", "AnalysisTemplate"});
  for (const char* part : {"model", "analysis"}) {
    schema["properties"][part] = {
        {"type", "object"},
        {"description", std::string("As the tool solve takes it; what a parameter writes may be left out")}};
  }
  return schema;
}

json read_schema() {
  return object_schema({{"id", text_field("Of a result or table that an earlier call told")},
                        {"pointer", text_field("JSON Pointer to the part; \"\" for all")},
                        {"first", whole_field("List: number of the first item to return, from 0")},
                        {"count", whole_field("List: number of items to return, at most 200")}},
                       {"id", "pointer"});
}

json plot_schema() {
  json kinds = json::array();
  for (const auto& kind : api::kPlotKinds) {
    kinds.push_back(kind.name);
  }
  const json size = {{"type", "number"},
                     {"minimum", api::kLeastPlotSize},
                     {"maximum", api::kLargestPlotSize},
                     {"description", "Pixels"}};
  return object_schema(
      {{"id", text_field("Of a result or table that an earlier call told; or model is given")},
       {"model", {{"type", "object"}, {"description", "A model to draw as it stands, as solve takes it"}}},
       {"kind",
        {{"type", "string"}, {"enum", kinds}, {"description", "Default: what fits the document best"}}},
       {"state", whole_field("shape, sections: number of the state, from 0")},
       {"mode", whole_field("mode: number of the mode or of the critical point, from 0")},
       {"branch", whole_field("path: number of the only branch to draw, from 0")},
       {"monitor", text_field("path: id of the monitor on the horizontal axis")},
       {"arc_length", flag_field("path: arc length on the horizontal axis")},
       {"points", flag_field("path: mark the points at which an equilibrium was solved")},
       {"magnify", {{"type", "number"}, {"exclusiveMinimum", 0}, {"description", "Factor of displacements"}}},
       {"law", text_field("law, laws: id of a spring or foundation; default: the first with a law, or all")},
       {"output", text_field("sweep, heatmap: column of the table")},
       {"x", text_field("sweep, heatmap: parameter on the horizontal axis")},
       {"by", text_field("sweep: parameter with a curve for each value; heatmap: vertical axis")},
       {"width", size},
       {"height", size},
       {"dark", flag_field("Light lines on dark paper")},
       {"svg", flag_field("SVG instead of PNG")}},
      json::array());
}

json convert_schema() {
  const json soil = api::standalone_schema("SoilDocument");
  json schema = object_schema(
      {{"soil",
        {{"$ref", "#/$defs/SoilDocument"}, {"description", "Pile in layered soil: gives its foundations"}}},
       {"nodes", text_field("Table (CSV) with the columns id, x, y")},
       {"members",
        text_field("Table (CSV) with the columns id, start, end, section, and sweep_degrees if any")},
       {"sections",
        text_field("Table (CSV) with the column id, and any of EA, EI, GA, E, A, I, nu, shear_area")},
       {"drawing", text_field("Text of an ASCII drawing (DXF)")},
       {"layers",
        {{"type", "array"}, {"items", {{"type", "string"}}}, {"description", "drawing: only these layers"}}},
       {"tolerance",
        {{"type", "number"},
         {"exclusiveMinimum", 0},
         {"maximum", kMaxMagnitude},
         {"description", "drawing: distance within which ends join"}}},
       {"join_tees",
        flag_field("drawing: divide a line or arc where an end of another lies on it within the tolerance")}},
      json::array());
  schema["$defs"] = soil.at("$defs");
  schema["$defs"]["SoilDocument"] = soil;
  schema["$defs"]["SoilDocument"].erase("$defs");
  return schema;
}

json tool(const char* name, const char* title, const char* description, json schema) {
  return {{"name", name},
          {"title", title},
          {"description", description},
          {"inputSchema", std::move(schema)},
          {"annotations", {{"readOnlyHint", true}, {"openWorldHint", false}}}};
}

}  // namespace

json tool_list() {
  const json any = {{"type", "object"}, {"description", "As the tool solve, or sweep, takes it"}};
  return {
      tool(
          "check", "Check a request or a sweep",
          "Finds every mistake of a request, or of a sweep, without computing it, and gives its size and the "
          "expected processor time. Each mistake has the JSON Pointer of its place.",
          {{"type", "object"},
           {"properties", {{"model", any}, {"analysis", any}}},
           {"required", {"model", "analysis"}}}),
      tool("solve", "Analyse a structure",
           "Follows equilibrium paths and finds critical loads of a plane slender structure on elastic "
           "ground that is "
           "glued to it or can only push. Every number comes with what made it; critical loads have "
           "`error_estimate` and "
           "`confirmed`. Long lists are left out and named in `left_out`: the tool read has them. Give only "
           "values that the "
           "user or the problem gives; do not assume missing ones.",
           api::standalone_schema("Request")),
      tool("sweep", "Analyse many variants",
           "Solves a request for many values of its parameters and returns a table with one row for each "
           "point. A point "
           "that fails has the reason in its row. At most 10 000 points; the first 200 rows are shown, the "
           "tool read has "
           "all.",
           sweep_schema()),
      tool(
          "read", "Read a part of an earlier answer",
          "Returns a part of a result or table of this session by JSON Pointer, of a list at most 200 items.",
          read_schema()),
      tool("plot", "Draw a result, a table or a model",
           "Draws the equilibrium path, a deformed shape, section forces, a mode, a structure, the law of a "
           "support, frequencies or stiffness along a path, or the chart of a table.",
           plot_schema()),
      tool("convert", "Make parts of a model",
           "Makes the foundations of a pile from soil layers (API RP 2GEO), or nodes, members and sections "
           "from tables or "
           "a drawing, for the model of solve. A second text has `warnings` of a drawing: what is left out, "
           "what is joined at a distance, and what only looks joined.",
           convert_schema())};
}

}  // namespace snapthrough::server::mcp
