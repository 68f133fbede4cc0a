#include <cctype>
#include <sstream>
#include <string_view>

#include "server/cli/pages/description.h"
#include "server/cli/remote_arguments.h"
#include "server/cli/streams.h"
#include "server/settings.h"

namespace snapthrough::server::cli {
namespace {

struct ExitStatus {
  std::string number;
  const char* meaning;
};

std::vector<ExitStatus> exit_statuses() {
  return {{std::to_string(kDone), "Done."},
          {std::to_string(kOther), "Anything else: usage, files, connections."},
          {std::to_string(kWrongRequest),
           "The document is wrong: each mistake is on a line of standard error, JSON Pointer first."},
          {std::to_string(kNotCompleted),
           "The analysis, or a row of the sweep, could not be completed; standard error says why."},
          {std::to_string(kUnfinished), "What a service was asked for has not ended yet."},
          {"128 + N", "Ended by signal N; what was reached is written."}};
}

/// Returns roff text that prints `text` literally; hyphens become the ASCII character.
std::string literal(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '\'':
        escaped += "\\(aq";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      case '`':
        escaped += "\\(ga";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// Breaks words into lines of at most 78 characters. A zero-width character precedes a leading full stop,
/// which roff would take for a command.
std::string filled(std::string_view text) {
  constexpr std::size_t kWidth = 78;
  std::istringstream words{std::string(text)};
  std::string lines;
  std::size_t column = 0;
  for (std::string word; words >> word;) {
    std::string escaped = literal(word);
    if (escaped.starts_with('.')) {
      escaped.insert(0, "\\&");
    }
    if (column > 0) {
      const bool fits = column + 1 + escaped.size() <= kWidth;
      lines += fits ? ' ' : '\n';
      column = fits ? column + 1 : 0;
    }
    lines += escaped;
    column += escaped.size();
  }
  return lines + "\n";
}

std::string upper_case(std::string text) {
  for (char& c : text) {
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return text;
}

std::string head(const std::string& title, const std::string& date) {
  return ".TH " + upper_case(literal(title)) + " 1 " + date +
         " \"snapthrough " SNAPTHROUGH_VERSION "\" \"snapthrough manual\"\n";
}

/// Returns the placeholder for an option's value.
std::string value_name(const OptionPage& option) { return option.is_number ? "NUMBER" : "VALUE"; }

void write_option(const OptionPage& option, std::ostream& page) {
  page << ".TP\n";
  std::string names;
  for (const std::string& name : option.names) {
    names += (names.empty() ? "\\fB" : ", \\fB") + literal(name) + "\\fR";
  }
  if (option.is_positional) {
    names = "\\fI" + literal(option.names.front()) + "\\fR";
  } else if (option.takes_value) {
    names += " \\fI" + value_name(option) + "\\fR";
  }
  page << names << '\n' << filled(option.help + (option.help.ends_with('.') ? "" : "."));
  if (!option.choices.empty()) {
    std::string list;
    for (const std::string& choice : option.choices) {
      list += (list.empty() ? "One of " : ", ") + choice;
    }
    page << filled(list + ".");
  }
  if (!option.default_value.empty()) {
    page << filled("Default: " + option.default_value + ".");
  }
  if (!option.variable.empty()) {
    page << filled("Environment: " + option.variable + ".");
  }
}

void write_options(const CommandPage& command, std::ostream& page) {
  for (const bool positional : {true, false}) {
    bool is_first = true;
    for (const OptionPage& option : command.options) {
      if (option.is_positional == positional) {
        page << (is_first ? (positional ? ".SH ARGUMENTS\n" : ".SH OPTIONS\n") : "");
        write_option(option, page);
        is_first = false;
      }
    }
  }
}

void write_exit_statuses(std::ostream& page) {
  page << ".SH EXIT STATUS\n";
  for (const ExitStatus& status : exit_statuses()) {
    page << ".TP\n\\fB" << status.number << "\\fR\n" << filled(status.meaning);
  }
}

std::string reference(const std::string& page) { return ".BR " + literal(page) + " (1)"; }

std::string command_text(const CommandPage& command, const std::string& date) {
  const std::string title = "snapthrough-" + command.name;
  std::ostringstream page;
  page << head(title, date) << ".SH NAME\n"
       << literal(title) << " \\- " << filled(command.description) << ".SH SYNOPSIS\n.B snapthrough "
       << literal(command.name) << "\n[\\fIOPTION\\fR]...";
  for (const OptionPage& option : command.options) {
    if (option.is_positional) {
      const std::string name = "\\fI" + literal(option.names.front()) + "\\fR";
      page << ' ' << (option.is_required ? name : "[" + name + "]");
    }
  }
  page << '\n';
  write_options(command, page);
  write_exit_statuses(page);
  page << ".SH SEE ALSO\n" << reference("snapthrough") << '\n';
  return page.str();
}

std::string program_text(const ProgramPage& program, const std::string& date) {
  std::ostringstream page;
  page << head("snapthrough", date) << ".SH NAME\nsnapthrough \\- " << filled(program.program.description)
       << ".SH SYNOPSIS\n.B snapthrough\n\\fICOMMAND\\fR [\\fIOPTION\\fR]...\n.SH DESCRIPTION\n"
       << filled(
              "Requests, results and sweeps are JSON documents. Their fields, and the HTTP interface of the "
              "service, are explained in /usr/share/doc/snapthrough, with examples, and at the address of a "
              "service that runs.")
       << ".SH COMMANDS\n";
  for (const CommandPage& command : program.commands) {
    page << ".TP\n\\fB" << literal(command.name) << "\\fR\n"
         << filled(command.description + ".") << "See\n"
         << reference("snapthrough-" + command.name) << " .\n";
  }
  write_options(program.program, page);
  write_exit_statuses(page);
  page << ".SH ENVIRONMENT\n.TP\n\\fB" << kServiceVariable << "\\fR, \\fB" << kKeyFileVariable << "\\fR\n"
       << filled("Stand for --service and --key-file of submit, wait and fetch.") << ".TP\n\\fB"
       << kConfigVariable << "\\fR\n"
       << filled("Stands for --config of serve, work and migrate.") << ".TP\n\\fB" << kVariablePrefix
       << "\\fINAME\\fR\n"
       << filled("Any other is a setting of serve, work and migrate: the option in upper case, with _ for -.")
       << ".SH SEE ALSO\n";
  for (const CommandPage& command : program.commands) {
    page << reference("snapthrough-" + command.name) << (&command == &program.commands.back() ? "" : " ,")
         << '\n';
  }
  return page.str();
}

}  // namespace

std::vector<ManualPage> manual_pages(const ProgramPage& program, const std::string& date) {
  std::vector<ManualPage> pages{{"snapthrough.1", program_text(program, date)}};
  for (const CommandPage& command : program.commands) {
    pages.push_back({"snapthrough-" + command.name + ".1", command_text(command, date)});
  }
  return pages;
}

}  // namespace snapthrough::server::cli
