/* An environment, the force of what the handle touches, as a shared library:
 * `hapticwall run press --environment ./mine.so`.
 *
 * C99, no dependency, SI units. The library exports one constant:
 *
 *   const hw_environment hapticwall_environment = {HAPTICWALL_ENVIRONMENT_ABI,
 *                                                  sizeof(hw_environment), ...};
 *
 * docs/environments.md explains how to write, build and run one. */
#ifndef HAPTICWALL_ENVIRONMENT_H
#define HAPTICWALL_ENVIRONMENT_H

#include <stdint.h>

#include "plugin.h"

/* NOLINTBEGIN(readability-identifier-naming): names of C */
#ifdef __cplusplus
extern "C" {
#endif

#define HAPTICWALL_ENVIRONMENT_ABI 1

/* The scene, for configure(). All pointers are valid during the call only. */
typedef struct hw_environment_context {
  uint32_t size; /* bytes of this struct; a later host may append members */
  uint32_t axis; /* 0: x, 1: y */
  double period_s;
  const double *parameters; /* in the order of hw_environment.parameters */
} hw_environment_context;

/* The handle at a tick, as one axis knows it: positions as measured, velocities as estimated. x
 * grows into the wall. */
typedef struct hw_motion {
  uint32_t size; /* bytes of this struct; a later host may append members */
  uint32_t axis; /* of the force that is asked for: 0 is x, 1 is y */
  uint32_t axes; /* 1 or 2 */
  uint32_t reserved;
  double time_s;
  double position_m;
  double velocity_m_per_s;
  double other_position_m; /* of the other axis; 0 without one */
  double other_velocity_m_per_s;
} hw_motion;

/* State and calls as in hw_plugin (hapticwall/plugin.h): one block of `state_bytes` zero bytes for
 * each axis of each run, and no allocation, no lock, no system call in any function. */
typedef struct hw_environment {
  uint32_t abi;                   /* HAPTICWALL_ENVIRONMENT_ABI */
  uint32_t size;                  /* sizeof(hw_environment) */
  uint32_t state_bytes;           /* 0 to 262144 */
  uint32_t parameter_count;       /* 0 to 16 */
  const hw_parameter *parameters; /* keys of [environment]; NULL if there are none */
  const char *name;     /* of menus and files: a-z, 0-9 and -; not that of another environment */
  const char *title;    /* for people */
  const char *idea;     /* one line */
  const char *equation; /* one line; "" for none */
  /* At the start, and again with every change of scene or parameters. NULL: nothing to do. */
  void (*configure)(void *state, const hw_environment_context *context);
  /* After the first configure(), and for a new start: forget the past. NULL: nothing to do. */
  void (*reset)(void *state);
  /* F_e in newtons; a positive force pushes out of the wall. It changes nothing: it may be asked
   * several times in a tick, for several places. NaN and infinity end the run with zero force. */
  double (*force)(const void *state, const hw_motion *motion);
  /* Once per computation, after the force F_d was commanded. NULL: it has no motion of its own. */
  void (*advance)(void *state, const hw_motion *motion, double applied_force_n);
  /* The depth in metres, above 0 in contact. NULL: a contact is where the force is not 0, and its
   * depth is 0. */
  double (*depth)(const void *state, const hw_motion *motion);
  /* The spring that stands for the environment at this place, N/m, above 0. NULL: the algorithms
   * virtual-coupling and energy-limited-spring, which need one, are refused. */
  double (*stiffness_hint)(const void *state, const hw_motion *motion);
} hw_environment;

#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
extern const hw_environment hapticwall_environment;

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
