/* A haptic device behind a shared library:
 * `hapticwall run press --device plugin:./mine.so --allow-plugin`.
 *
 * C99, no dependency, SI units, one axis, one device a library. The library exports one constant:
 *
 *   const hw_device_plugin hapticwall_device = {
 *       HAPTICWALL_DEVICE_ABI, sizeof(hw_device_plugin), ...};
 *
 * Threads. The real-time loop calls nothing of the library. One thread calls open() and close(), a
 * second one read(), a third one write(). read() and write() run at the same time, and neither runs
 * during open() or close(). After a loss the host calls close() and open() again.
 *
 *   - A read() that waits does not hold the loop, and must not hold write(): if both take one
 * mutex, do not hold it while you wait. The zero force has to get through.
 *   - A position older than 20 ms, or a write() that does not return within 20 ms, ends the force.
 *     The zero goes out with the next write(), so a write() that hangs leaves the last force at the
 *     device: a device needs a watchdog of its own.
 *   - exit() is an error of the plug-in: the host ends with zero force. In write() it calls write()
 *     once more for that. A call that changes the rounding mode has failed.
 *   - A call that hangs cannot be ended. The host leaves its thread behind, and opens the device
 *     again once the call has returned.
 *
 * docs/plugins.md says how to build and run one, and what the host does not believe. */
#ifndef HAPTICWALL_DEVICE_PLUGIN_H
#define HAPTICWALL_DEVICE_PLUGIN_H

#include <stdint.h>

/* NOLINTBEGIN(readability-identifier-naming): names of C */
#ifdef __cplusplus
extern "C" {
#endif

#define HAPTICWALL_DEVICE_ABI 1

enum {
  /* Position 0 is a fixed place. Without it the handle is taken to be at the start of the scene
   * when the link comes up. */
  HW_DEVICE_CALIBRATED = 1,
  /* read() tells the command that the device obeys, and its force. Without it a command counts as
   * obeyed when write() has returned, and the delay is unknown. */
  HW_DEVICE_ANSWERS = 2
};

typedef struct hw_device_info {
  uint32_t size;                 /* bytes of this struct; a later host may append members */
  uint32_t flags;                /* HW_DEVICE_...; all members are 0 before info() */
  double encoder_m;              /* a count, or the resolution: 1e-9 to 0.01 */
  double force_limit_n;          /* more than 0, at most 32.767 */
  double min_m, max_m;           /* positions of the workspace: -10 to 0, 0 to 10 */
  double max_speed_m_per_s;      /* of the handle: more than 0, at most 100 */
  double max_force_rate_n_per_s; /* of the force: at most 1e6; 0: the host's default */
} hw_device_info;

enum { HW_READING_FAULT = 1, HW_READING_ENABLED = 2 };

typedef struct hw_device_reading {
  uint32_t size;     /* bytes of this struct; a later host may append members */
  uint32_t flags;    /* HW_READING_...; all members are 0 before read() */
  double position_m; /* grows into the wall; NaN and infinity are a fault */
  /* With HW_DEVICE_ANSWERS: the number of the newest command that the device obeys, 0 for none,
   * whether it gives a force (HW_READING_ENABLED), and which. */
  uint32_t command;
  double force_n; /* positive pushes out of the wall */
} hw_device_reading;

typedef struct hw_device_command {
  uint32_t size;   /* bytes of this struct; a later host may append members */
  uint32_t number; /* 1 to 65535, then 0 again */
  uint32_t enable; /* 0: no force, whatever the device did before */
  double force_n;  /* positive pushes out of the wall, to smaller positions; within the limit */
} hw_device_command;

/* Results of read(). */
enum { HW_READ_FAILED = -1, HW_READ_NOTHING = 0, HW_READ_POSITION = 1 };

typedef struct hw_device_plugin {
  uint32_t abi;      /* HAPTICWALL_DEVICE_ABI */
  uint32_t size;     /* sizeof(hw_device_plugin) */
  const char *title; /* for people, one line of at most 100 bytes of UTF-8 */
  /* Once, before open(): 0, or another number for a failure. */
  int (*info)(hw_device_info *info);
  /* 0, or another number for a failure. At most 3 s. The force is off. */
  int (*open)(void);
  /* A new position, measured now. It may wait for it, at most 5 ms; the host calls it at most 2000
   * times a second. HW_READ_NOTHING: none is new. HW_READ_FAILED: the device is gone. */
  int (*read)(hw_device_reading *reading);
  /* Every tick and at least every 10 ms; the first and the last one do not enable. 0, or another
   * number if the device did not take it. */
  int (*write)(const hw_device_command *command);
  void (*close)(void);
  /* Why the last call on this thread failed: one line, "" for nothing more to say. */
  const char *(*last_error)(void);
} hw_device_plugin;

#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
extern const hw_device_plugin hapticwall_device;

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
