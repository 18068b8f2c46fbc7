// An emulated haptic device for every program of this machine: see program/.
#include "tests/emulator/program/emulator_program.h"

int main(int argc, char** argv) { return hapticwall::emulator::run_program(argc, argv); }
