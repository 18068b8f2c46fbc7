#include "app/command/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
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

// Long names of the options; if `with_value`, only of options that take a value.
std::vector<std::string> words_of(const CLI::App& app, bool with_value) {
  std::vector<std::string> words;
  for (const CLI::Option* option : app.get_options()) {
    if (with_value && !takes_value(*option)) continue;
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  }
  return words;
}

// SCENE takes the names of the built-in scenes.
bool takes_scene(const CLI::App& app) { return app.get_option_no_throw("SCENE") != nullptr; }

std::string completion_case(const std::string& pattern, const CLI::App& app) {
  return fmt::format("    {}) options='{}' words=\"{}\" ;;\n", pattern,
                     fmt::join(words_of(app, false), " "), takes_scene(app) ? "$scenes" : "");
}

constexpr std::string_view kCompletionEnd = R"sh(  esac
  if [[ $previous == '=' ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi
  if [[ $word == '=' ]]; then previous=${COMP_WORDS[COMP_CWORD - 1]} word=''; fi
  if ((COMP_CWORD == 1)); then words="$commands $words"; fi
  case " $valued " in
    *" $previous "*) options='' words='' ;;
  esac
  case $previous in
    --algorithm | --algorithms) words=$algorithms ;;
  esac
  if [[ $word == -* ]]; then words=$options; fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _hapticwall hapticwall
)sh";

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

std::string bash_completion(const CLI::App& program) {
  std::vector<std::string> commands;
  std::set<std::string> valued;
  std::string cases;
  const auto add = [&](const std::string& pattern, const CLI::App& app) {
    cases += completion_case(pattern, app);
    for (std::string& word : words_of(app, true)) valued.insert(std::move(word));
  };
  for (const CLI::App* command : program.get_subcommands(nullptr)) {
    commands.push_back(command->get_name());
    add(command->get_name(), *command);
  }
  add("*", program);
  return fmt::format(
      "# Completion of hapticwall {} for bash.\n_hapticwall() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}\n"
      "  local options words commands='{}'\n  local algorithms='{}'\n  local scenes='{}'\n"
      "  local valued='{}'\n  case ${{COMP_WORDS[1]}} in\n{}{}",
      kVersion, fmt::join(commands, " "),
      fmt::join(file::names_of(algorithms(), &AlgorithmDescription::name), " "),
      fmt::join(file::names_of(file::builtin_scenes(), &file::BuiltinScene::name), " "),
      fmt::join(valued, " "), cases, kCompletionEnd);
}

}  // namespace hapticwall::command
