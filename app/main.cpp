// Haptic Wall: the command line and its window.
#include "app/command/program.h"
#include "app/ui/window/window.h"

int main(int argc, char** argv) {
  return hapticwall::command::run_program(
      argc, argv, [](const auto& options) { return hapticwall::ui::run_window(options); });
}
