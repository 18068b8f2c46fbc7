#include "app/command/usage.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <vector>

#include "app/file/text/text.h"

namespace hapticwall::command {
namespace {

std::string not_a_number(const std::string& text) {
  return file::in_quotes(text) + " is not a finite number";
}

// The named command, or the program itself.
const CLI::App& parsed_app(const CLI::App& program) {
  const auto commands = program.get_subcommands();
  return commands.empty() ? program : *commands.front();
}

std::string help_of(const CLI::App& program, const CLI::App& app) {
  return &app == &program ? "'hapticwall --help'"
                          : fmt::format("'hapticwall {} --help'", app.get_name());
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string unexpected(const CLI::App& program, const CLI::App& app, const std::string& word) {
  if (!word.starts_with('-') || word == "-") {
    return fmt::format("{}: unexpected argument; {} shows the usage", file::in_quotes(word),
                       help_of(program, app));
  }
  const std::string option = word.substr(0, word.find('='));
  const std::vector<std::string> names = option_names(app);
  const std::vector<std::string_view> views(names.begin(), names.end());
  return fmt::format("{}: unknown option{}; {} lists the options", file::shown(option),
                     file::suggestion(option, views), help_of(program, app));
}

// The option that was given more often than it takes values, or null.
const CLI::Option* repeated_option(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const int max = option->get_items_expected_max();
    if (max > 0 && option->count() > static_cast<std::size_t>(max)) return option;
  }
  return nullptr;
}

}  // namespace

ValueCheck is_number() {
  return
      [](const std::string& text) { return file::parsed<double>(text) ? "" : not_a_number(text); };
}

ValueCheck is_number_within(double min, double max) {
  return [min, max](const std::string& text) -> std::string {
    const std::optional<double> value = file::parsed<double>(text);
    if (!value) return not_a_number(text);
    if (*value >= min && *value <= max) return "";
    return fmt::format("{} is out of range; it takes {:g} to {:g}", file::in_quotes(text), min,
                       max);
  };
}

void check_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) {
      option->check(
          [](const std::string& text) { return text == "true" ? "" : "it takes no value"; });
      continue;
    }
    const std::string type = option->get_type_name();
    option->check([type](const std::string& text) -> std::string {
      if (!text.empty()) return "";
      return "its value is empty" + (type.empty() ? "" : "; it takes " + type);
    });
  }
}

Error usage_problem(const CLI::App& program, const CLI::ParseError& problem) {
  const CLI::App& app = parsed_app(program);
  const std::vector<std::string> left_over = program.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&problem) != nullptr && !left_over.empty()) {
    return usage_error(unexpected(program, app, left_over.front()));
  }
  // The text of a ValueCheck names the values that the option takes.
  if (dynamic_cast<const CLI::ValidationError*>(&problem) != nullptr) {
    return usage_error(problem.what());
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&problem) != nullptr) {
    if (const CLI::Option* repeated = repeated_option(app)) {
      return usage_error(repeated->get_name() + ": it is given more than once; give it once");
    }
  }
  return usage_error(fmt::format("{}; {} shows the usage", problem.what(), help_of(program, app)));
}

}  // namespace hapticwall::command
