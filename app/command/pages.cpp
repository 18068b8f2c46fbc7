#include "app/command/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "app/file/scene/scene_file.h"
#include "hapticwall_version.h"

namespace hapticwall::command {
namespace {

// Text that troff shows as it is.
std::string as_troff(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    if (c == '.' && (shown.empty() || shown.back() == '\n')) shown += "\\&";
    if (c == '\\')
      shown += "\\e";
    else if (c == '-')
      shown += "\\-";
    else if (c == '\'')
      shown += "\\(aq";
    else
      shown += c;
  }
  return shown;
}

std::string as_entry(const std::string& term, const std::string& meaning) {
  return fmt::format(".TP\n\\fB{}\\fR\n{}\n", as_troff(term), as_troff(meaning));
}

std::string as_heading(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return ".SH " + text + "\n";
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::string options_of(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    const std::string type = takes_value(*option) ? option->get_type_name() : "";
    const std::string term = option->get_name(false, true) + (type.empty() ? "" : " " + type);
    text += as_entry(term, option->get_description());
  }
  return text;
}

std::string commands_of(const CLI::App& program) {
  std::string text;
  for (const CLI::App* command : program.get_subcommands(nullptr)) {
    text += fmt::format(".SS hapticwall {}\n{}.\n{}", as_troff(command->get_name()),
                        as_troff(command->get_description()), options_of(*command));
  }
  return text;
}

// The end of the help: "Examples:" and other headings, each with indented lines.
std::string footer_of(const CLI::App& program) {
  std::string text;
  std::istringstream lines(program.get_footer());
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    const bool indented = line.front() == ' ';
    const bool heading = !indented && line.back() == ':';
    if (heading) line.pop_back();
    text += heading    ? as_heading(line)
            : indented ? ".nf\n" + as_troff(line) + "\n.fi\n"
                       : ".PP\n" + as_troff(line) + "\n";
  }
  return text;
}

std::string scenes() {
  std::string text;
  for (const file::BuiltinScene& scene : file::builtin_scenes())
    text += as_entry(scene.name, scene.description);
  return text;
}

}  // namespace

std::string manual_page(const CLI::App& program) {
  const std::string description = program.get_description();
  const std::size_t end = description.find('\n');
  return fmt::format(
      ".TH HAPTICWALL 1 \"\" \"hapticwall {}\" \"User Commands\"\n"
      ".SH NAME\nhapticwall \\- {}\n"
      ".SH SYNOPSIS\n.B hapticwall\n[OPTIONS] [SCENE]\n.br\n.B hapticwall\nCOMMAND [OPTIONS]\n"
      ".SH DESCRIPTION\n{}\n.SH OPTIONS\n{}.SH COMMANDS\n{}{}.SH SCENES\n{}",
      kVersion, as_troff(description.substr(0, end)), as_troff(description.substr(end + 1)),
      options_of(program), commands_of(program), footer_of(program), scenes());
}

}  // namespace hapticwall::command
