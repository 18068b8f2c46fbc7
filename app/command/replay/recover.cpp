// hapticwall recover NAME.csv: finishes a recording that was cut off.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/report/terminal.h"
#include "app/file/recording/recovery.h"
#include "app/file/text/text.h"

namespace hapticwall::command {
namespace {

Result<int> recover(const std::string& path) {
  const Result<file::Recovered> recovered = file::recover_recording(path);
  if (!recovered) return recovered.error();
  for (const std::string& note : recovered->notes) tell("note: " + file::shown(note, 200));
  std::string text = fmt::format("{}: {} rows", file::shown(recovered->csv_path), recovered->rows);
  if (recovered->missing_rows > 0) {
    text += fmt::format(", {} missing between them", recovered->missing_rows);
  }
  if (recovered->cut_bytes > 0) {
    text += fmt::format(", {} bytes of a broken line removed", recovered->cut_bytes);
  }
  return status_of(write_output(text + "\n"));
}

}  // namespace

Command add_recover(CLI::App& program) {
  const auto path = std::make_shared<std::string>();
  CLI::App* app = program.add_subcommand(
      "recover", "Finish a recording that was cut off by a crash or a full disk");
  app->add_option("RECORDING", *path, "NAME.csv, or NAME.csv.partial")->required();
  const auto plugin = std::make_shared<std::string>();  // is in the list of algorithms
  app->add_option("--algorithm", *plugin, "The plug-in of the recording, ./MINE.so")
      ->type_name("FILE")
      ->transform(loads_plugin());
  return {app, [path, plugin] { return recover(*path); }};
}

}  // namespace hapticwall::command
