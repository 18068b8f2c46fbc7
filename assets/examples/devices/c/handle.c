/* A device plug-in in C: a simulated handle in real time, and a hand that presses it 45 mm forward
 * once the force was first enabled. It shows what a driver of a real device has to do. */
#define _POSIX_C_SOURCE 200809L
#include <hapticwall/device_plugin.h>
#include <pthread.h>
#include <time.h>

static const double mass_kg = 0.1, damping_n_s_per_m = 1.0, count_m = 2e-5;
static const double hand_stiffness_n_per_m = 250.0, hand_damping_n_s_per_m = 8.0;
static const double step_s = 1e-4, longest_s = 0.02;

/* read() and write() come from two threads. Nobody waits for anything under this mutex. */
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static struct {
  double time_s, position_m, velocity_m_per_s; /* of the handle */
  double hand_s;                               /* since the force was first enabled; < 0: never */
  hw_device_command command;                   /* the newest one */
  double command_s;                            /* its arrival */
} handle;

static double now_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int info(hw_device_info *info) {
  info->flags = HW_DEVICE_ANSWERS;
  info->encoder_m = count_m;
  info->force_limit_n = 8.0;
  info->min_m = -0.1;
  info->max_m = 0.2;
  info->max_speed_m_per_s = 5.0;
  return 0;
}

static int open_handle(void) {
  pthread_mutex_lock(&mutex);
  handle.time_s = now_s();
  handle.position_m = handle.velocity_m_per_s = 0.0;
  handle.hand_s = -1.0;
  handle.command = (hw_device_command){0};
  pthread_mutex_unlock(&mutex);
  return 0;
}

/* The watchdog of the device: a command acts for 100 ms. */
static double force_n(double at_s) {
  const int acts = handle.command.enable && at_s - handle.command_s < 0.1;
  return acts ? handle.command.force_n : 0.0;
}

static double hand_target_m(void) {
  const double way_s = handle.hand_s - 0.7;
  if (way_s <= 0.0) return 0.0;
  return way_s < 1.0 ? 0.045 * way_s : 0.045;
}

static void move(double dt_s) {
  if (handle.hand_s >= 0.0) handle.hand_s += dt_s;
  const double hand_n = hand_stiffness_n_per_m * (hand_target_m() - handle.position_m) -
                        hand_damping_n_s_per_m * handle.velocity_m_per_s;
  const double drag_n = damping_n_s_per_m * handle.velocity_m_per_s;
  handle.velocity_m_per_s += (hand_n - drag_n - force_n(handle.time_s)) / mass_kg * dt_s;
  handle.position_m += handle.velocity_m_per_s * dt_s;
  handle.time_s += dt_s;
}

/* The device measures at 1 kHz. */
static void wait_for_tick(void) {
  struct timespec tick;
  clock_gettime(CLOCK_MONOTONIC, &tick);
  tick.tv_nsec += 1000000 - tick.tv_nsec % 1000000;
  if (tick.tv_nsec == 1000000000) {
    tick.tv_nsec = 0;
    ++tick.tv_sec;
  }
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &tick, 0);
}

static int read_handle(hw_device_reading *reading) {
  wait_for_tick();
  pthread_mutex_lock(&mutex);
  const double end_s = now_s();
  if (end_s - handle.time_s > longest_s) handle.time_s = end_s - longest_s; /* it was stopped */
  while (handle.time_s + step_s <= end_s) move(step_s);
  const double counts = handle.position_m / count_m;
  reading->position_m = (double)(long)(counts < 0.0 ? counts - 0.5 : counts + 0.5) * count_m;
  reading->command = handle.command.number;
  reading->force_n = force_n(handle.time_s);
  if (handle.command.enable) reading->flags = HW_READING_ENABLED;
  pthread_mutex_unlock(&mutex);
  return HW_READ_POSITION;
}

static int write_handle(const hw_device_command *command) {
  pthread_mutex_lock(&mutex);
  handle.command = *command;
  handle.command_s = now_s();
  if (command->enable && handle.hand_s < 0.0) handle.hand_s = 0.0;
  pthread_mutex_unlock(&mutex);
  return 0;
}

static void close_handle(void) {}

static const char *last_error(void) { return ""; }

const hw_device_plugin hapticwall_device = {
    HAPTICWALL_DEVICE_ABI,
    sizeof(hw_device_plugin),
    "Simulated handle in C",
    info,
    open_handle,
    read_handle,
    write_handle,
    close_handle,
    last_error,
};
