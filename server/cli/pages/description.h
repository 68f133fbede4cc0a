#pragma once
/// @file
/// Description of the command line for manual pages and shell completion, taken from the CLI11 app.

#include <optional>
#include <string>
#include <vector>

namespace snapthrough::server::cli {

/// An option or a positional argument.
struct OptionPage {
  std::vector<std::string> names;  ///< such as "-o", "--output"; positional argument: its name
  std::string help;
  std::vector<std::string> choices;  ///< the allowed values; empty: any
  std::string default_value;         ///< empty: no default
  std::string variable;              ///< environment variable of the option; empty: none
  bool is_positional = false;
  bool is_required = false;
  bool takes_value = false;
  bool is_number = false;
};

/// A command, or the program.
struct CommandPage {
  std::string name;  ///< name such as "solve"; program: "snapthrough"
  std::string description;
  std::vector<OptionPage> options;  ///< options in the order of --help, positional arguments last
};

struct ProgramPage {
  CommandPage program;
  std::vector<CommandPage> commands;  ///< commands in the order of --help
};

/// Returns all commands and options that run() parses.
[[nodiscard]] ProgramPage describe_program();

/// A manual page.
struct ManualPage {
  std::string file;  ///< file name, such as "snapthrough-solve.1"
  std::string text;  ///< roff text for man(7)
};

/// @brief Returns a page for the program and one for each command.
/// @param date date in the footer, yyyy-mm-dd
[[nodiscard]] std::vector<ManualPage> manual_pages(const ProgramPage& program, const std::string& date);

/// Return scripts that complete commands, options, values and file names.
[[nodiscard]] std::string bash_completion(const ProgramPage& program);
[[nodiscard]] std::string zsh_completion(const ProgramPage& program);
[[nodiscard]] std::string fish_completion(const ProgramPage& program);

}  // namespace snapthrough::server::cli
