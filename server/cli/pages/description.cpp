#include "server/cli/pages/description.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "server/cli/commands.h"

namespace snapthrough::server::cli {
namespace {

/// Returns the values of CLI::IsMember, which the name of the option's type contains as "TEXT:{a,b}".
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  std::vector<std::string> choices;
  if (begin == std::string::npos || end == std::string::npos) {
    return choices;
  }
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string choice; std::getline(list, choice, ',');) {
    choices.push_back(choice);
  }
  return choices;
}

OptionPage option_page(const CLI::Option& option) {
  OptionPage page;
  for (const std::string& name : option.get_snames()) {
    page.names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames()) {
    page.names.push_back("--" + name);
  }
  page.is_positional = page.names.empty();
  if (page.is_positional) {
    page.names.push_back(option.get_name(true));
  }
  const std::string type = option.get_type_name();
  page.help = option.get_description();
  page.choices = choices_of(type);
  page.default_value = option.get_default_str();
  page.variable = option.get_envname();
  page.is_required = option.get_required();
  page.takes_value = page.is_positional || option.get_items_expected_max() > 0;
  page.is_number = type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
  return page;
}

CommandPage command_page(const CLI::App& command) {
  CommandPage page{command.get_name(), command.get_description(), {}};
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) {  // options without a group are hidden
      page.options.push_back(option_page(*option));
    }
  }
  std::stable_partition(page.options.begin(), page.options.end(),
                        [](const OptionPage& option) { return !option.is_positional; });
  return page;
}

}  // namespace

ProgramPage describe_program() {
  const auto app = described_app();
  ProgramPage page{command_page(*app), {}};
  for (const CLI::App* command : app->get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) {
      page.commands.push_back(command_page(*command));
    }
  }
  return page;
}

}  // namespace snapthrough::server::cli
