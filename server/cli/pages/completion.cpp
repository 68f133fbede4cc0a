#include <algorithm>
#include <sstream>
#include <string_view>

#include "server/cli/pages/description.h"

namespace snapthrough::server::cli {
namespace {

/// Returns the text with a backslash before each character of `special`.
std::string with_backslashes(std::string_view text, std::string_view special) {
  std::string escaped;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) {
      escaped += '\\';
    }
    escaped += c;
  }
  return escaped;
}

/// Returns the text in single quotes for bash and zsh.
std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    out += c == '\'' ? "'\\''" : std::string{c};
  }
  return out + "'";
}

/// Returns the text in single quotes for fish.
std::string fish_quoted(std::string_view text) { return "'" + with_backslashes(text, "\\'") + "'"; }

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    line += (line.empty() ? "" : " ") + word;
  }
  return line;
}

/// Returns the names of all options without positional arguments.
std::vector<std::string> option_names(const CommandPage& command) {
  std::vector<std::string> names;
  for (const OptionPage& option : command.options) {
    if (!option.is_positional) {
      names.insert(names.end(), option.names.begin(), option.names.end());
    }
  }
  return names;
}

/// Writes the bash cases for options whose values are choices or numbers, not file names.
void write_bash_values(const CommandPage& command, std::ostream& script) {
  for (const OptionPage& option : command.options) {
    if (option.is_positional || !option.takes_value || (option.choices.empty() && !option.is_number)) {
      continue;
    }
    std::string pattern;
    for (const std::string& name : option.names) {
      pattern += (pattern.empty() ? "" : " | ") + quoted(command.name + " " + name);
    }
    script << "    " << pattern << ")\n      words=" << quoted(joined(option.choices))
           << "\n      is_value=yes\n      ;;\n";
  }
}

std::string zsh_action(const OptionPage& option) {
  if (!option.choices.empty()) {
    return "(" + joined(option.choices) + ")";
  }
  return option.is_number ? " " : "_files";
}

void write_zsh_options(const CommandPage& command, std::ostream& script) {
  for (const OptionPage& option : command.options) {
    const std::string help = with_backslashes(option.help, "[]\\:");
    if (option.is_positional) {
      script << " \\\n        " << quoted("::" + option.names.front() + ":" + zsh_action(option));
      continue;
    }
    for (const std::string& name : option.names) {
      const std::string value = option.takes_value ? ":value:" + zsh_action(option) : "";
      script << " \\\n        " << quoted(name + "[" + help + "]" + value);
    }
  }
}

void write_fish_options(const CommandPage& command, std::string_view condition, std::ostream& script) {
  for (const OptionPage& option : command.options) {
    if (option.is_positional) {
      continue;
    }
    script << "complete -c snapthrough -n " << fish_quoted(condition);
    for (const std::string& name : option.names) {
      script << (name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1));
    }
    if (option.takes_value && (!option.choices.empty() || option.is_number)) {
      script << " -x" << (option.choices.empty() ? "" : " -a " + fish_quoted(joined(option.choices)));
    } else if (option.takes_value) {
      script << " -r -F";
    }
    script << " -d " << fish_quoted(option.help) << '\n';
  }
}

}  // namespace

std::string bash_completion(const ProgramPage& program) {
  std::ostringstream script;
  std::vector<std::string> first = option_names(program.program);
  for (const CommandPage& command : program.commands) {
    first.push_back(command.name);
  }
  script << "# Completion for bash, made from the description of the command line.\n"
            "_snapthrough() {\n"
            "  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command='' "
            "words='' is_value='' i\n"
            "  if [ \"$word\" = '=' ]; then\n"
            "    word=''\n"
            "  elif [ \"$previous\" = '=' ]; then\n"
            "    previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
            "  fi\n"
            "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
            "    if [[ ${COMP_WORDS[i]} != -* ]]; then\n"
            "      command=${COMP_WORDS[i]}\n"
            "      break\n"
            "    fi\n"
            "  done\n"
            "  COMPREPLY=()\n"
            "  case \"$command $previous\" in\n";
  for (const CommandPage& command : program.commands) {
    write_bash_values(command, script);
  }
  script << "  esac\n"
            "  if [ -z \"$is_value\" ]; then\n"
            "    case \"$command\" in\n"
            "      '')\n        words="
         << quoted(joined(first)) << "\n        ;;\n";
  for (const CommandPage& command : program.commands) {
    script << "      " << command.name << ")\n        words=" << quoted(joined(option_names(command)))
           << "\n        ;;\n";
  }
  // Without a reply bash completes file names, which arguments and other values may be.
  script << "    esac\n"
            "    if [ -n \"$command\" ] && [[ $word != -* ]]; then\n"
            "      return\n"
            "    fi\n"
            "  fi\n"
            "  compopt +o default +o bashdefault 2>/dev/null\n"
            "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
            "}\n"
            "complete -o bashdefault -o default -F _snapthrough snapthrough\n";
  return script.str();
}

std::string zsh_completion(const ProgramPage& program) {
  std::ostringstream script;
  script << "#compdef snapthrough\n"
            "# Completion for zsh, made from the description of the command line.\n"
            "_snapthrough() {\n"
            "  local state line\n"
            "  local -a commands\n"
            "  commands=(\n";
  for (const CommandPage& command : program.commands) {
    script << "    " << quoted(command.name + ":" + command.description) << '\n';
  }
  script << "  )\n  _arguments -C";
  write_zsh_options(program.program, script);
  script << " \\\n        '1:command:->command' '*::argument:->argument'\n"
            "  case $state in\n"
            "    command) _describe command commands ;;\n"
            "    argument)\n"
            "      case $words[1] in\n";
  for (const CommandPage& command : program.commands) {
    script << "      " << command.name << ") _arguments";
    write_zsh_options(command, script);
    script << " ;;\n";
  }
  script << "      esac\n"
            "      ;;\n"
            "  esac\n"
            "}\n"
            "_snapthrough \"$@\"\n";
  return script.str();
}

std::string fish_completion(const ProgramPage& program) {
  std::ostringstream script;
  script << "# Completion for fish, made from the description of the command line.\n";
  write_fish_options(program.program, "__fish_use_subcommand", script);
  for (const CommandPage& command : program.commands) {
    script << "complete -c snapthrough -n __fish_use_subcommand -f -a " << command.name << " -d "
           << fish_quoted(command.description) << '\n';
  }
  for (const CommandPage& command : program.commands) {
    write_fish_options(command, "__fish_seen_subcommand_from " + command.name, script);
  }
  return script.str();
}

}  // namespace snapthrough::server::cli
