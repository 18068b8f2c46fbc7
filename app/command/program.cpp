#include "app/command/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/command/commands.h"
#include "app/command/completion.h"
#include "app/command/pages.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/command/usage.h"
#include "app/file/plugin/plugin_file.h"
#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "app/study/studies.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "core/environment/plugin/plugin_environment.h"
#include "core/result.h"
#include "device/port/plugin_port.h"
#include "hapticwall_version.h"

namespace hapticwall::command {
namespace {

constexpr std::size_t kHelpColumn = 34;
constexpr const char* kDescription =
    "A virtual wall for haptic devices, and the algorithms that keep it stable.\n"
    "Without a command: opens the window on SCENE.";

constexpr std::string_view kExamples = R"(
Examples:
  hapticwall                                      the window, on the scene 'tap'
  hapticwall run press --csv a.csv --plot a.png   recording (a.csv, a.toml) and figure
  hapticwall run tap --wav tap.wav                the handle's acceleration, to be heard
  hapticwall run a.toml --csv b.csv               the same session again, bit for bit
  hapticwall run tap --algorithm virtual-coupling --set hand.mass_kg=0.3
  hapticwall run press --expect verdict=settled --expect 'tail_peak_to_peak_m<1e-4'
  hapticwall compare tap --json -
  hapticwall map press --x wall.stiffness_n_per_m=1e3:1e5:50:log --y wall.damping_n_s_per_m=0:20:41 --plot a.png
  hapticwall accuracy golden-hard --plot a.png    cost and error of a tick
  hapticwall replay a.csv --algorithm none        the recorded hand under another algorithm
  hapticwall timing --seconds 60                  the timing of this machine
  hapticwall identify --device ie2000             mass, damping, friction and delay of a device
  hapticwall run press --device ie2000 --arm      the same on a haptic device ('devices' lists them)

Exit status:
  0  success                           4  a file could not be written
  1  an --expect does not hold         5  the display server died
  2  usage or scene error              130, 143  ended early by Ctrl-C, SIGTERM
  3  device                            141  the reader of --stream has left
)";

std::string footer() {
  return fmt::format(
      "{}\nAlgorithms: {}\n'hapticwall COMMAND --help' lists the options of a command.", kExamples,
      file::joined(file::names_of(algorithms(), &AlgorithmDescription::name)));
}

// Refuses a first word that is no option, command, scene or file.
Failure check_first_word(int argc, const char* const* argv, const CLI::App& program) {
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
  return usage_error(fmt::format("{} is no command, built-in scene or file{}",
                                 file::in_quotes(word),
                                 hint.empty() ? "; known: " + file::joined(views) : hint));
}

// Refuses options before the command: they would belong to the window.
Failure check_place(const CLI::App& program, const CLI::App& command) {
  for (const CLI::Option* option : program.get_options()) {
    if (option->count() == 0) continue;
    const std::string name =
        option->get_positional() ? option->results().front() : option->get_name();
    return usage_error(fmt::format("{}: it stands before '{}'; move it behind the command",
                                   file::shown(name), command.get_name()));
  }
  return std::nullopt;
}

std::string is_page(const std::string& text) {
  if (text == "man" || completion_writer(text) != nullptr) return "";
  return file::in_quotes(text) + " is no page; it takes man, bash, zsh or fish";
}

// Prints help or the version; anything else is an error.
Result<int> answer(const CLI::App& program, const CLI::ParseError& outcome) {
  std::optional<std::string> text;
  if (dynamic_cast<const CLI::CallForVersion*>(&outcome) != nullptr) {
    text = fmt::format("hapticwall {} ({})\n", kVersion, kBuild);
  } else if (outcome.get_exit_code() == 0) {
    text = program.help();
    for (const CLI::App* command : program.get_subcommands()) text = command->help("hapticwall");
  }
  if (!text) return usage_problem(program, outcome);
  return status_of(write_output(*text));
}

// A plug-in with a fault gave no force from then on.
Result<int> after(const Action& action) {
  Result<int> outcome = action();
  for (std::size_t i = first_plugin(); i < algorithms().size(); ++i) {
    const LibraryFault fault = plugin_fault(i);
    if (fault == LibraryFault::kNone) continue;
    tell(fmt::format("note: {}: the plug-in {} {}, and its force was zero from then on",
                     file::shown(file::plugin_file(i)->path), algorithms()[i].name,
                     library_fault_text(fault)));
  }
  for (std::size_t i = 0; i < environments().size(); ++i) {
    const LibraryFault fault = environment_fault(i);
    if (fault == LibraryFault::kNone) continue;
    const file::PluginFile* const plugin = file::environment_file(i);
    tell(fmt::format("note: {}: the environment {} {}, and the force was zero from then on",
                     plugin != nullptr ? file::shown(plugin->path) : "",
                     environments()[i].description.name, library_fault_text(fault)));
  }
  const std::string device_fault = device::device_plugin_fault();
  if (!device_fault.empty()) tell("note: the device plug-in: " + device_fault);
  return outcome;
}

// Adds the commands in the order of --help.
std::vector<Command> add_commands(CLI::App& program, const session::OpenWindow& open) {
  std::vector<Command> commands{add_run(program), add_compare(program), add_map(program)};
  for (const study::Study* study : study::studies()) {
    if (study->has_command) commands.push_back(add_study(program, *study));
  }
  commands.push_back(add_replay(program, open));
  for (const auto& add : {add_recover, add_timing, add_identify, add_devices, add_scenes}) {
    commands.push_back(add(program));
  }
  return commands;
}

Result<int> dispatch(int argc, const char* const* argv, const session::OpenWindow& open) {
  CLI::App program(kDescription, "hapticwall");
  program.set_version_flag("--version", std::string(kVersion), "Print the version and exit");
  std::string page;
  program
      .add_option("--generate", page,
                  "Print man, the manual page, or the completion of bash, zsh or fish")
      ->type_name("PAGE")
      ->check(is_page);
  program.get_formatter()->column_width(kHelpColumn);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.get_formatter()->label("REQUIRED", "(required)");
  program.footer(footer());
  const Action window = add_window(program, open);
  const std::vector<Command> commands = add_commands(program, open);
  check_values(program);
  for (const Command& command : commands) {
    command.app->group("Commands")->footer("");
    check_values(*command.app);
  }
  if (const auto error = check_first_word(argc, argv, program)) return *error;
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& outcome) {
    return answer(program, outcome);
  }
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    if (const auto error = check_place(program, *command.app)) return *error;
    return after(command.action);
  }
  if (!page.empty()) {
    const CompletionWriter complete = completion_writer(page);
    return status_of(write_output(complete == nullptr ? manual_page(program) : complete(program)));
  }
  return after(window);
}

}  // namespace

int run_program(int argc, const char* const* argv, const session::OpenWindow& open) {
  return run_guarded([&] { return dispatch(argc, argv, open); });
}

}  // namespace hapticwall::command
