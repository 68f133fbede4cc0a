#pragma once
/// @file
/// What manual pages and shell completion say of the command line, taken from its description in CLI11.

#include <optional>
#include <string>
#include <vector>

namespace snapthrough::server::cli {

/// An option or a positional argument.
struct OptionPage {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional argument its name alone
  std::string help;
  std::vector<std::string> choices;  ///< the only values; empty: others
  std::string default_value;         ///< empty: none
  std::string variable;              ///< of the environment, that stands for it; empty: none
  bool is_positional = false;
  bool is_required = false;
  bool takes_value = false;
  bool is_number = false;
};

/// A command, or the program itself.
struct CommandPage {
  std::string name;  ///< "solve"; of the program "snapthrough"
  std::string description;
  std::vector<OptionPage> options;  ///< in the order of --help, positional arguments last
};

struct ProgramPage {
  CommandPage program;
  std::vector<CommandPage> commands;  ///< in the order of --help
};

/// All commands and options that run() parses.
[[nodiscard]] ProgramPage describe_program();

/// A manual page.
struct ManualPage {
  std::string file;  ///< "snapthrough-solve.1"
  std::string text;  ///< in roff, for man(7)
};

/// @brief One page for the program and one for each command.
/// @param date yyyy-mm-dd, at the foot of the pages
[[nodiscard]] std::vector<ManualPage> manual_pages(const ProgramPage& program, const std::string& date);

/// Completion of commands, options, values and files.
[[nodiscard]] std::string bash_completion(const ProgramPage& program);
[[nodiscard]] std::string zsh_completion(const ProgramPage& program);
[[nodiscard]] std::string fish_completion(const ProgramPage& program);

}  // namespace snapthrough::server::cli
