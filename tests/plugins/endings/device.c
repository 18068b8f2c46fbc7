/* The example of a device plug-in, one of whose functions ends the process, hangs, or changes the
 * rounding mode: ACT in FUNCTION. read(), write(), close() and last_error() act once a force was
 * commanded. Every command is a line of the file that HAPTICWALL_TEST_COMMANDS names. */
#define hapticwall_device sound_device
#include "assets/examples/devices/c/handle.c"
#undef hapticwall_device

#include <fcntl.h>
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define QUOTED(name) #name
#define TEXT(name) QUOTED(name)

static volatile int pushed;

static void act(const char *function) {
  static volatile int endless = 1;
  const char *const what = TEXT(ACT);
  if (strcmp(function, TEXT(FUNCTION)) != 0) return;
  if (strcmp(what, "exit") == 0) exit(0);
  if (strcmp(what, "rounding") == 0) fesetround(FE_UPWARD);
  while (strcmp(what, "endless") == 0 && endless) {
  }
}

static void act_if_pushed(const char *function) {
  if (pushed) act(function);
}

static int ending_info(hw_device_info *values) {
  act("info");
  return info(values);
}

static int ending_open(void) {
  act("open");
  return strcmp(TEXT(FUNCTION), "last_error") == 0 ? 1 : open_handle();
}

static int ending_read(hw_device_reading *reading) {
  act_if_pushed("read");
  return read_handle(reading);
}

static void note(const hw_device_command *command) {
  char line[64];
  const char *const name = getenv("HAPTICWALL_TEST_COMMANDS");
  const int file = name == 0 ? -1 : open(name, O_WRONLY | O_CREAT | O_APPEND, 0600);
  const int length =
      snprintf(line, sizeof line, "%u %.3f\n", (unsigned)command->enable, command->force_n);
  if (file < 0) return;
  if (write(file, line, (size_t)length) != length) abort();
  close(file);
}

static int ending_write(const hw_device_command *command) {
  note(command);
  if (command->enable && command->force_n > 1.0) pushed = 1;
  if (command->enable) act_if_pushed("write");
  return write_handle(command);
}

static void ending_close(void) {
  act("close");
  close_handle();
}

static const char *ending_words(void) {
  act("last_error");
  return "";
}

const hw_device_plugin hapticwall_device = {
    HAPTICWALL_DEVICE_ABI, sizeof(hw_device_plugin),
    "Ending handle",       ending_info,
    ending_open,           ending_read,
    ending_write,          ending_close,
    ending_words,
};
