#include "server/cli/plot.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "api/json_text.h"
#include "api/plot/plot.h"
#include "api/plot/plot_error.h"
#include "api/plot/plot_request.h"
#include "server/cli/input.h"
#include "server/cli/plot_file.h"

namespace snapthrough::server::cli {

/// Values of the arguments of `plot`.
struct PlotArguments {
  std::string document;
  std::string request;  ///< file of the solved request; empty: none
  std::string file;     ///< file to write; empty: standard output
  std::string kind;
  std::vector<std::string> where;  ///< conditions NAME=VALUE
  std::optional<double> scale;
  api::PlotRequest figure;
};

namespace {

constexpr double kPngScale = 2;

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const auto& kind : api::kPlotKinds) {
    names.emplace_back(kind.name);
  }
  return names;
}

void add_choices(CLI::App& command, PlotArguments& arguments) {
  api::PlotRequest& figure = arguments.figure;
  command.add_option("--kind", arguments.kind, "What to draw; by default what fits the document best")
      ->check(CLI::IsMember(kinds()));
  command.add_option("--state", figure.state,
                     "shape, sections: number of the state, from 0 [first critical point, or last]");
  command.add_option("--mode", figure.mode, "mode: number of the mode or of the critical point, from 0");
  command.add_option("--branch", figure.branch, "path: number of the only branch to draw, from 0");
  CLI::Option* monitor =
      command.add_option("--monitor", figure.monitor, "path: id of the monitor on the horizontal axis");
  command.add_flag("--arc-length", figure.over_arc_length, "path: arc length on the horizontal axis")
      ->excludes(monitor);
  command.add_flag("--points", figure.points, "path: mark the points at which an equilibrium was solved");
  command.add_option("--magnify", figure.magnify, "shape: factor of displacements; mode: factor of its size")
      ->check(CLI::PositiveNumber);
  command.add_option("--law", figure.law,
                     "law, laws: id of the spring or foundation [law: first with a law; laws: all]");
  command.add_option("--output", figure.output,
                     "sweep, heatmap: JSON Pointer of the output, as in the table's columns");
  command.add_option("--x", figure.x, "sweep, heatmap: parameter on the horizontal axis");
  command.add_option("--by", figure.by,
                     "sweep: parameter with a curve for each value; heatmap: vertical axis");
  command
      .add_option("--where", arguments.where,
                  "sweep, heatmap: NAME=VALUE, only rows with this value; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_looks(CLI::App& command, PlotArguments& arguments) {
  const CLI::Range sizes(api::kLeastPlotSize, api::kLargestPlotSize);
  command.add_option("--width", arguments.figure.width, "Width in pixels [720]")->check(sizes);
  command
      .add_option("--height", arguments.figure.height,
                  "Height in pixels [480, sections 600; less for flat structures, more for many laws]")
      ->check(sizes);
  command.add_option("--scale", arguments.scale, "PNG: its pixels for each of these [2]")
      ->check(CLI::Range(0.1, 10.0));
  command.add_flag("--dark", arguments.figure.dark, "Light lines on dark paper");
}

/// Returns the document of a file; null with the exit status in `status` when it is invalid.
std::shared_ptr<nlohmann::json> read_document(const std::string& path, const Streams& streams, int& status) {
  const std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    status = kOther;
    return nullptr;
  }
  const api::ParsedText parsed = api::parse_json(*text, api::kFigureLimits);
  print_findings(parsed.findings, streams);
  status = parsed.document == nullptr ? kWrongRequest : kDone;
  return parsed.document;
}

bool ends_with(std::string text, std::string_view ending) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text.ends_with(ending);
}

/// Returns the error in a combination of arguments; "" for valid ones.
std::string mistake_in(const PlotArguments& arguments) {
  const bool png = ends_with(arguments.file, ".png");
  if (!arguments.file.empty() && !png && !ends_with(arguments.file, ".svg")) {
    return "the name of the file must end in .svg or .png, got " + arguments.file;
  }
  if (arguments.scale && !png) {
    return "--scale is for a file that ends in .png";
  }
  if (arguments.document == "-" && arguments.request == "-") {
    return "standard input can be the result or the request, not both";
  }
  api::PlotRequest conditions;
  for (const std::string& condition : arguments.where) {
    if (!api::add_condition(condition, conditions)) {
      return "--where must be NAME=VALUE, once for each NAME, got " + condition;
    }
  }
  return "";
}

api::PlotRequest request_of(const PlotArguments& arguments, const nlohmann::json* solved) {
  api::PlotRequest request = arguments.figure;
  if (!arguments.kind.empty()) {
    request.kind = api::value_of(api::kPlotKinds, arguments.kind);
  }
  for (const std::string& condition : arguments.where) {
    (void)api::add_condition(condition, request);  // checked by mistake_in()
  }
  request.solved_request = solved;
  return request;
}

int write_figure(const std::string& svg, const PlotArguments& arguments, const Streams& streams) {
  if (arguments.file.empty()) {
    streams.out << svg << std::flush;
    if (!streams.out) {
      streams.err << "snapthrough: cannot write the figure\n";
      return kOther;
    }
    return kDone;
  }
  const std::string problem = ends_with(arguments.file, ".png")
                                  ? write_png(svg, arguments.file, arguments.scale.value_or(kPngScale))
                                  : write_whole(svg, arguments.file);
  if (!problem.empty()) {
    streams.err << "snapthrough: " << problem << '\n';
    return kOther;
  }
  return kDone;
}

}  // namespace

std::shared_ptr<PlotArguments> add_plot_command(CLI::App& app) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* command =
      app.add_subcommand("plot", "Draw a result, a model or the table of a sweep as SVG or PNG");
  command
      ->add_option("result", arguments->document,
                   "What solve, sweep or convert printed, or a request (JSON); - reads standard input")
      ->required();
  command->add_option("-o", arguments->file,
                      "File to write, .svg or .png; SVG on standard output without it");
  command->add_option("--request", arguments->request,
                      "The request that was solved: shows supports, springs, ground and loads");
  add_choices(*command, *arguments);
  add_looks(*command, *arguments);
  return arguments;
}

int plot_command(const PlotArguments& arguments, const Streams& streams) {
  if (const std::string mistake = mistake_in(arguments); !mistake.empty()) {
    streams.err << "snapthrough: " << mistake << '\n';
    return kOther;
  }
  int status = kDone;
  const std::shared_ptr<nlohmann::json> document = read_document(arguments.document, streams, status);
  std::shared_ptr<nlohmann::json> solved;
  if (document != nullptr && !arguments.request.empty()) {
    solved = read_document(arguments.request, streams, status);
  }
  if (status != kDone) {
    return status;
  }
  try {
    return write_figure(api::svg_of(*document, request_of(arguments, solved.get())), arguments, streams);
  } catch (const api::PlotError& error) {
    streams.err << error.what() << " [no_figure]\n";
    return kWrongRequest;
  }
}

}  // namespace snapthrough::server::cli
