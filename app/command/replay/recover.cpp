// hapticwall recover NAME.csv: a recording that was cut off gets its names.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "app/command/commands.h"
#include "app/command/terminal.h"
#include "app/file/recovery.h"
#include "app/file/text.h"

namespace hapticwall::command {
namespace {

int recover(const std::string& path) {
  const Result<file::Recovered> recovered = file::recover_recording(path);
  if (!recovered) return report(recovered.error());
  for (const std::string& note : recovered->notes) tell("note: " + file::shown(note, 200));
  std::string text = fmt::format("{}: {} rows", file::shown(recovered->csv_path), recovered->rows);
  if (recovered->missing_rows > 0) {
    text += fmt::format(", {} missing between them", recovered->missing_rows);
  }
  if (recovered->cut_bytes > 0) {
    text += fmt::format(", {} bytes of a broken line left out", recovered->cut_bytes);
  }
  const Failure failed = write_output(text + "\n");
  return failed ? report(*failed) : 0;
}

}  // namespace

Command add_recover(CLI::App& program) {
  const auto path = std::make_shared<std::string>();
  CLI::App* app = program.add_subcommand(
      "recover", "Finish a recording that was cut off: the program was killed, or the disk full");
  app->add_option("RECORDING", *path, "NAME.csv, or NAME.csv.partial")->required();
  return {app, [path] { return recover(*path); }};
}

}  // namespace hapticwall::command
