/* The example of a device plug-in with one fault each, which FAULT names. It begins 1.5 s after the
 * force was first enabled, when the hand presses into a wall, unless it is one of the start. */
#define hapticwall_device sound_device
#include "assets/examples/devices/c/handle.c"
#undef hapticwall_device

#include <math.h>

enum { nan_position, jump, slow_read, slow_write, refuses, gone, not_enabled, other_force, fails_to_open, wrong_info, abi, null };

static int is_due(void) {
  pthread_mutex_lock(&mutex);
  const int due = handle.hand_s > 1.5;
  pthread_mutex_unlock(&mutex);
  return due;
}

static void wait_50_ms(void) {
  const struct timespec wait = {0, 50000000};
  nanosleep(&wait, 0);
}

static int faulty_info(hw_device_info *values) {
  const int result = info(values);
  if (FAULT == wrong_info) values->force_limit_n = 50.0;
  if (FAULT == jump) values->flags = 0;
  return result;
}

static int faulty_open(void) { return FAULT == fails_to_open ? 7 : open_handle(); }

static int faulty_read(hw_device_reading *reading) {
  const int result = read_handle(reading);
  if (!is_due()) return result;
  if (FAULT == nan_position) reading->position_m = NAN;
  if (FAULT == jump) reading->position_m += 0.08;
  if (FAULT == slow_read) wait_50_ms();
  if (FAULT == gone) return HW_READ_FAILED;
  if (FAULT == not_enabled) reading->flags = 0;
  if (FAULT == other_force) reading->force_n = 0.5 * reading->force_n + 0.2;
  return result;
}

static int faulty_write(const hw_device_command *command) {
  if (is_due() && FAULT == slow_write) wait_50_ms();
  if (is_due() && FAULT == refuses) return 1;
  return write_handle(command);
}

static const char *faulty_words(void) {
  return FAULT == fails_to_open ? "no handle\nis \033[1mconnected" : "";
}

const hw_device_plugin hapticwall_device = {
    FAULT == abi ? 9 : HAPTICWALL_DEVICE_ABI,
    sizeof(hw_device_plugin),
    "Faulty handle",
    faulty_info,
    faulty_open,
    faulty_read,
    FAULT == null ? 0 : faulty_write,
    close_handle,
    faulty_words,
};
