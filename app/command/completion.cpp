#include "app/command/completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "hapticwall_version.h"

namespace hapticwall::command {
namespace {

struct OptionWord {
  std::string name;  // with its dashes
  std::string meaning;
  bool takes_value;
};

struct CommandWords {
  std::string name;  // empty: the window, which has no command
  std::string meaning;
  std::vector<OptionWord> options;
  bool takes_scene;
};

// Everything that the scripts offer.
struct Words {
  std::vector<CommandWords> commands;
  CommandWords window;
  std::vector<std::string_view> algorithms;
};

CommandWords words_of(const CLI::App& app) {
  CommandWords words{
      app.get_name(), app.get_description(), {}, app.get_option_no_throw("SCENE") != nullptr};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden: it only says what to use instead
    for (const std::string& name : option->get_lnames()) {
      words.options.push_back(
          {"--" + name, option->get_description(), option->get_items_expected_max() > 0});
    }
  }
  return words;
}

Words all_words(const CLI::App& program) {
  Words words{{}, words_of(program), file::names_of(algorithms(), &AlgorithmDescription::name)};
  words.window.name.clear();
  for (const CLI::App* command : program.get_subcommands(nullptr))
    words.commands.push_back(words_of(*command));
  return words;
}

std::vector<std::string> names_of(const std::vector<OptionWord>& options) {
  std::vector<std::string> names;
  for (const OptionWord& option : options) names.push_back(option.name);
  return names;
}

// The commands with a scene, if `with_scene`, or all.
std::vector<std::string> names_of(const std::vector<CommandWords>& commands, bool with_scene) {
  std::vector<std::string> names;
  for (const CommandWords& command : commands)
    if (!with_scene || command.takes_scene) names.push_back(command.name);
  return names;
}

// Names of all options that take a value.
std::set<std::string> valued_options(const Words& words) {
  std::set<std::string> names;
  const auto add = [&](const CommandWords& command) {
    for (const OptionWord& option : command.options)
      if (option.takes_value) names.insert(option.name);
  };
  std::for_each(words.commands.begin(), words.commands.end(), add);
  add(words.window);
  return names;
}

// `text` inside of single quotes: `quote` and `backslash` are how the shell writes these two there.
std::string quoted(std::string_view text, std::string_view quote, std::string_view backslash) {
  std::string shown = "'";
  for (const char c : text) {
    if (c == '\'')
      shown += quote;
    else if (c == '\\')
      shown += backslash;
    else
      shown += c == '\n' ? ' ' : c;
  }
  return shown + "'";
}

// ---------------------------------------------------------------------------------------- bash

std::string bash_case(const CommandWords& command) {
  return fmt::format(
      "    {}) options='{}' words=\"{}\" ;;\n", command.name.empty() ? "*" : command.name,
      fmt::join(names_of(command.options), " "), command.takes_scene ? "$scenes" : "");
}

constexpr std::string_view kBashEnd = R"sh(  esac
  if [[ $previous == '=' ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi
  if [[ $word == '=' ]]; then previous=${COMP_WORDS[COMP_CWORD - 1]} word=''; fi
  if ((COMP_CWORD == 1)); then words="$commands $words"; fi
  case " $valued " in
    *" $previous "*) options='' words='' ;;
  esac
  case $previous in
    --algorithm | --algorithms | --beside) words=$algorithms ;;
  esac
  if [[ $word == -* ]]; then words=$options; fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _hapticwall hapticwall
)sh";

std::string bash_completion(const CLI::App& program) {
  const Words words = all_words(program);
  std::string cases;
  for (const CommandWords& command : words.commands) cases += bash_case(command);
  cases += bash_case(words.window);
  return fmt::format(
      "# Completion of hapticwall {} for bash.\n_hapticwall() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}\n"
      "  local options words commands='{}'\n  local algorithms='{}'\n  local scenes='{}'\n"
      "  local valued='{}'\n  case ${{COMP_WORDS[1]}} in\n{}{}",
      kVersion, fmt::join(names_of(words.commands, false), " "), fmt::join(words.algorithms, " "),
      fmt::join(file::names_of(file::builtin_scenes(), &file::BuiltinScene::name), " "),
      fmt::join(valued_options(words), " "), cases, kBashEnd);
}

// ----------------------------------------------------------------------------------------- zsh

// A word of `_describe`, which shows the meaning beside the name.
std::string zsh_word(std::string_view name, std::string_view meaning) {
  return "\n    " + quoted(fmt::format("{}:{}", name, meaning), "'\\''", "\\");
}

std::string zsh_case(const CommandWords& command) {
  std::string options;
  for (const OptionWord& option : command.options) options += zsh_word(option.name, option.meaning);
  return fmt::format("  {}) options=({}\n    ) offered=({}) ;;\n",
                     command.name.empty() ? "*" : command.name, options,
                     command.takes_scene ? "\"${scenes[@]}\"" : "");
}

constexpr std::string_view kZshEnd = R"sh(  esac
  if [[ $PREFIX == --*=* ]]; then
    previous=${PREFIX%%=*}
    compset -P '*='
  fi
  if ((CURRENT == 2)); then offered=("${commands[@]}" "${offered[@]}"); fi
  if [[ $previous == --(algorithm(s|)|beside) ]]; then
    _describe algorithm algorithms
    _files
  elif [[ $valued == *" $previous "* ]]; then
    _files
  elif [[ $PREFIX == -* ]]; then
    _describe -o option options
  else
    _describe word offered
    _files
  fi
}
if [[ ${funcstack[1]} == _hapticwall ]]; then
  _hapticwall "$@"
else
  compdef _hapticwall hapticwall
fi
)sh";

std::string zsh_completion(const CLI::App& program) {
  const Words words = all_words(program);
  std::string commands;
  std::string cases;
  std::string scenes;
  for (const CommandWords& command : words.commands) {
    commands += zsh_word(command.name, command.meaning);
    cases += zsh_case(command);
  }
  cases += zsh_case(words.window);
  for (const file::BuiltinScene& scene : file::builtin_scenes())
    scenes += zsh_word(scene.name, scene.description);
  return fmt::format(
      "#compdef hapticwall\n# Completion of hapticwall {} for zsh.\n_hapticwall() {{\n"
      "  local previous=${{words[CURRENT - 1]}}\n  local -a options offered commands algorithms "
      "scenes\n"
      "  commands=({}\n  )\n  algorithms=({})\n  scenes=({}\n  )\n  local valued=' {} '\n"
      "  case ${{words[2]}} in\n{}{}",
      kVersion, commands, fmt::join(words.algorithms, " "), scenes,
      fmt::join(valued_options(words), " "), cases, kZshEnd);
}

// ---------------------------------------------------------------------------------------- fish

// A line of the script. `condition`: when the shell offers the word.
std::string fish_line(std::string_view condition, const std::string& what,
                      std::string_view meaning) {
  return fmt::format("complete -c hapticwall -n \"{}\" {} -d {}\n", condition, what,
                     quoted(meaning, "\\'", "\\\\"));
}

std::string fish_options(const CommandWords& command) {
  const std::string condition = command.name.empty()
                                    ? "not __fish_seen_subcommand_from $commands"
                                    : "__fish_seen_subcommand_from " + command.name;
  std::string lines;
  for (const OptionWord& option : command.options) {
    const bool algorithm =
        option.name == "--algorithm" || option.name == "--algorithms" || option.name == "--beside";
    const std::string value = algorithm            ? " -r -a \"$algorithms\""
                              : option.takes_value ? " -r"
                                                   : "";
    lines += fish_line(condition, "-l " + option.name.substr(2) + value, option.meaning);
  }
  return lines;
}

std::string fish_completion(const CLI::App& program) {
  const Words words = all_words(program);
  std::string lines = fmt::format(
      "# Completion of hapticwall {} for fish.\nset -l commands {}\nset -l algorithms {}\n",
      kVersion, fmt::join(names_of(words.commands, false), " "), fmt::join(words.algorithms, " "));
  for (const CommandWords& command : words.commands) {
    lines += fish_line("__fish_use_subcommand", "-a " + command.name, command.meaning);
    lines += fish_options(command);
  }
  lines += fish_options(words.window);
  const std::string takes_scene =
      fmt::format("__fish_use_subcommand; or __fish_seen_subcommand_from {}",
                  fmt::join(names_of(words.commands, true), " "));
  for (const file::BuiltinScene& scene : file::builtin_scenes())
    lines += fish_line(takes_scene, "-a " + scene.name, scene.description);
  return lines;
}

}  // namespace

CompletionWriter completion_writer(std::string_view shell) {
  if (shell == "bash") return bash_completion;
  if (shell == "zsh") return zsh_completion;
  if (shell == "fish") return fish_completion;
  return nullptr;
}

}  // namespace hapticwall::command
