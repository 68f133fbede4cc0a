#include "server/cli/convert.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "api/convert/convert.h"
#include "server/cli/input.h"
#include "solver/model/limits.h"

namespace snapthrough::server::cli {

/// Values of the arguments of convert.
struct ConvertArguments {
  std::string form;
  std::string file;
  std::string nodes;
  std::string members;
  std::string sections;
  std::vector<std::string> layers;
  std::optional<double> tolerance;
  bool join_tees = false;
};

namespace {

/// Returns the error in a combination of arguments; "" for valid ones.
std::string mistake_in(const ConvertArguments& arguments) {
  const bool is_csv = arguments.form == "csv";
  const bool has_table =
      !arguments.nodes.empty() || !arguments.members.empty() || !arguments.sections.empty();
  if (is_csv && (arguments.nodes.empty() || arguments.members.empty() || !arguments.file.empty())) {
    return "csv needs --nodes and --members, and no other file";
  }
  if (!is_csv && has_table) {
    return "--nodes, --members and --sections are for csv";
  }
  if (arguments.form != "dxf" && (!arguments.layers.empty() || arguments.tolerance || arguments.join_tees)) {
    return "--layer, --tolerance and --join-tees are for dxf";
  }
  if (arguments.tolerance && !(*arguments.tolerance > 0.0 && *arguments.tolerance <= kMaxMagnitude)) {
    return "--tolerance must be a number above 0, at most 1e150";
  }
  const int inputs = (arguments.nodes == "-" ? 1 : 0) + (arguments.members == "-" ? 1 : 0) +
                     (arguments.sections == "-" ? 1 : 0);
  return inputs > 1 ? "standard input can be one table only" : "";
}

/// Returns a table; nullopt after a message on `err` that it cannot be read.
std::optional<api::CsvFile> read_table(const std::string& path, const Streams& streams) {
  std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    return std::nullopt;
  }
  return api::CsvFile{path == "-" ? "standard input" : path, std::move(*text)};
}

std::optional<api::Conversion> convert_tables(const ConvertArguments& arguments, const Streams& streams) {
  std::optional<api::CsvFile> nodes = read_table(arguments.nodes, streams);
  std::optional<api::CsvFile> members = read_table(arguments.members, streams);
  std::optional<api::CsvFile> sections;
  if (!arguments.sections.empty()) {
    sections = read_table(arguments.sections, streams);
  }
  if (!nodes || !members || sections.has_value() == arguments.sections.empty()) {
    return std::nullopt;
  }
  return api::convert_csv({std::move(*nodes), std::move(*members), std::move(sections)});
}

/// Returns the outcome of a conversion; nullopt after a message on `err` that a file cannot be read.
std::optional<api::Conversion> convert(const ConvertArguments& arguments, const Streams& streams) {
  if (arguments.form == "csv") {
    return convert_tables(arguments, streams);
  }
  const std::optional<std::string> text = read_all(arguments.file.empty() ? "-" : arguments.file, streams);
  if (!text) {
    return std::nullopt;
  }
  return arguments.form == "soil"
             ? api::convert_soil(*text)
             : api::convert_dxf(*text, {arguments.layers, arguments.tolerance, arguments.join_tees});
}

}  // namespace

std::shared_ptr<ConvertArguments> add_convert_command(CLI::App& app) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand("convert", "Make parts of a model from soil, tables or drawings");
  command->add_option("form", arguments->form, "What to convert")
      ->required()
      ->check(CLI::IsMember({"soil", "csv", "dxf"}));
  command->add_option("file", arguments->file,
                      "soil: soil document (JSON); dxf: drawing; - reads standard input, as without a file");
  command->add_option("--nodes", arguments->nodes, "csv: table of nodes; - reads standard input");
  command->add_option("--members", arguments->members, "csv: table of members");
  command->add_option("--sections", arguments->sections, "csv: table of sections");
  command->add_option("--layer", arguments->layers, "dxf: read this layer, not all layers; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--tolerance", arguments->tolerance,
                      "dxf: distance within which end points are one node [1e-6 of the drawing's size]");
  command->add_flag("--join-tees", arguments->join_tees,
                    "dxf: divide a line or arc where an end of another lies on it within the tolerance");
  return arguments;
}

int convert_command(const ConvertArguments& arguments, const Streams& streams) {
  if (const std::string mistake = mistake_in(arguments); !mistake.empty()) {
    streams.err << "snapthrough: " << mistake << '\n';
    return kOther;
  }
  const std::optional<api::Conversion> conversion = convert(arguments, streams);
  if (!conversion) {
    return kOther;
  }
  for (const Warning& warning : conversion->warnings) {
    streams.err << "Warning: " << warning.detail << " [" << warning.code << "]\n";
  }
  print_findings(conversion->findings, streams);
  if (conversion->document == nullptr) {
    return kWrongRequest;
  }
  streams.out << api::write_parts(*conversion->document) << std::flush;
  if (!streams.out) {
    streams.err << "snapthrough: cannot write the parts of the model\n";
    return kOther;
  }
  return kDone;
}

}  // namespace snapthrough::server::cli
