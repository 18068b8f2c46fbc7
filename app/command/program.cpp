#include "app/command/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "app/command/commands.h"
#include "app/command/signals.h"
#include "app/command/terminal.h"
#include "app/command/usage.h"
#include "app/file/scene_file.h"
#include "app/file/text.h"
#include "core/stabiliser/stabiliser.h"
#include "hapticwall_version.h"

namespace hapticwall::command {
namespace {

constexpr std::size_t kHelpColumn = 34;
constexpr const char* kDescription =
    "A virtual wall for haptic devices, and the algorithms that keep it stable.\n"
    "Without a command: opens the window on SCENE.";

constexpr std::string_view kExamples = R"(
Examples:
  hapticwall                                      the window, on the scene 'press'
  hapticwall run press --csv a.csv --plot a.png   recording (a.csv, a.toml) and figure
  hapticwall run a.toml --csv b.csv               the same session again, bit for bit
  hapticwall run tap --algorithm virtual-coupling --set hand.mass_kg=0.3
  hapticwall run press --expect verdict=settled --expect 'tail_peak_to_peak_m<1e-4'
  hapticwall compare tap --json -
  hapticwall map press --x wall.stiffness_n_per_m=1e3:1e5:50:log --y wall.damping_n_s_per_m=0:20:41 --plot a.png
  hapticwall accuracy golden-hard --plot a.png    what a tick costs, and what it is off by
  hapticwall replay a.csv --algorithm none        the recorded hand under another algorithm
  hapticwall timing --seconds 60                  how well this machine keeps time
  hapticwall run press --device ie2000 --arm      the same on a haptic device ('devices' lists them)

Exit status:
  0  fine                              3  device
  1  an --expect did not hold          4  a file could not be written whole
  2  usage or scene error              130, 143  ended early by Ctrl-C, SIGTERM
)";

std::string footer() {
  std::vector<std::string_view> names;
  for (const AlgorithmDescription& algorithm : algorithms()) names.push_back(algorithm.name);
  return fmt::format(
      "{}\nAlgorithms: {}\n'hapticwall COMMAND --help' tells the options of a command.", kExamples,
      file::joined(names));
}

// The first word is neither an option, a command, a scene nor a file.
std::optional<Error> check_first_word(int argc, const char* const* argv, const CLI::App& program) {
  if (argc < 2) return std::nullopt;
  const std::string word = argv[1];
  std::error_code ignored;
  if (word.empty() || word.front() == '-' || std::filesystem::exists(word, ignored)) {
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands(nullptr)) {
    names.push_back(command->get_name());
  }
  for (const file::BuiltinScene& scene : file::builtin_scenes()) names.push_back(scene.name);
  std::vector<std::string_view> views(names.begin(), names.end());
  if (std::find(views.begin(), views.end(), word) != views.end()) return std::nullopt;
  const std::string hint = file::suggestion(word, views);
  return Error{
      ErrorKind::kUsage,
      fmt::format("{} is neither a command, a built-in scene nor a file{}", file::in_quotes(word),
                  hint.empty() ? "; known: " + file::joined(views) : hint)};
}

// What stands before a command would be the window's, and is nothing for the command.
std::optional<Error> check_place(const CLI::App& program, const CLI::App& command) {
  for (const CLI::Option* option : program.get_options()) {
    if (option->count() == 0) continue;
    const std::string name =
        option->get_positional() ? option->results().front() : option->get_name();
    return Error{ErrorKind::kUsage,
                 fmt::format("{} stands before '{}' and would not reach it: what belongs to a "
                             "command comes after it",
                             file::shown(name), command.get_name())};
  }
  return std::nullopt;
}

// Help and version are answers, everything else one line.
int answer(const CLI::App& program, const CLI::ParseError& outcome) {
  std::optional<std::string> text;
  if (dynamic_cast<const CLI::CallForVersion*>(&outcome) != nullptr) {
    text = fmt::format("hapticwall {} ({})\n", kVersion, kBuild);
  } else if (outcome.get_exit_code() == 0) {
    text = program.help();
    for (const CLI::App* command : program.get_subcommands()) text = command->help("hapticwall");
  }
  if (!text) return report(usage_problem(program, outcome));
  const Failure failed = write_output(*text);
  return failed ? report(*failed) : 0;
}

int dispatch(int argc, const char* const* argv) {
  CLI::App program(kDescription, "hapticwall");
  program.set_version_flag("--version", std::string(kVersion), "Print the version and exit");
  program.get_formatter()->column_width(kHelpColumn);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.get_formatter()->label("REQUIRED", "(required)");
  program.footer(footer());
  const Action window = add_window(program);
  const std::vector<Command> commands{
      add_run(program),      add_compare(program), add_map(program),
      add_accuracy(program), add_replay(program),  add_recover(program),
      add_timing(program),   add_devices(program), add_scenes(program)};
  refuse_empty_values(program);
  for (const Command& command : commands) {
    command.app->group("Commands")->footer("");
    refuse_empty_values(*command.app);
  }
  if (const auto error = check_first_word(argc, argv, program)) return report(*error);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& outcome) {
    return answer(program, outcome);
  }
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    const auto error = check_place(program, *command.app);
    return error ? report(*error) : command.action();
  }
  return window();
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  ignore_write_signals();
  try {
    return dispatch(argc, argv);
  } catch (const std::bad_alloc&) {
    return report({ErrorKind::kUsage, "this needs more memory than there is"});
  } catch (const std::exception& error) {
    return report({ErrorKind::kUsage, fmt::format("internal error: {}", error.what())});
  }
}

}  // namespace hapticwall::command
