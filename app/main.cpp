// Haptic Wall: see app/command/ for what it does.
#include "app/command/program.h"

int main(int argc, char** argv) { return hapticwall::command::run_program(argc, argv); }
