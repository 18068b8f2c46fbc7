/* A stabilising algorithm as a shared library: `hapticwall run tap --algorithm ./mine.so`.
 *
 * C99, no dependency, SI units. The library exports one constant:
 *
 *   const hw_plugin hapticwall_plugin = {HAPTICWALL_PLUGIN_ABI, sizeof(hw_plugin), ...};
 *
 * docs/plugins.md explains how to write, build and run one. */
#ifndef HAPTICWALL_PLUGIN_H
#define HAPTICWALL_PLUGIN_H

#include <stdint.h>

/* NOLINTBEGIN(readability-identifier-naming): names of C */
#ifdef __cplusplus
extern "C" {
#endif

#define HAPTICWALL_PLUGIN_ABI 1

/* A key of `[algorithm]`, set with --set algorithm.KEY=VALUE. A key that another algorithm has
 * already needs the same unit, minimum and maximum: one value then serves both. */
typedef struct hw_parameter {
  const char *key;         /* a-z, 0-9 and _ */
  const char *unit;        /* "N", "" for a pure number */
  double minimum, maximum; /* inclusive, finite */
  double fallback;         /* if nothing is set; NaN: configure() gets NaN and chooses */
  const char *meaning;
} hw_parameter;

/* A number of each tick that step() shows beside the force: a column of recordings, a line of
 * plots. Its name ends with the unit, which chooses the plot: "store_j". Laws may share a signal.
 */
typedef struct hw_signal {
  const char *name; /* a-z, 0-9 and _ */
  const char *meaning;
} hw_signal;

typedef struct hw_wall {
  double position_m, stiffness_n_per_m, damping_n_s_per_m;
} hw_wall;

/* The scene, for configure(). All pointers are valid during the call only. */
typedef struct hw_context {
  uint32_t size; /* bytes of this struct; a later host may append members */
  double period_s;
  double device_damping_n_s_per_m;
  double encoder_m;         /* a count; 0: none */
  double force_limit_n;     /* the host clamps to it; 1.8e308: none */
  const double *parameters; /* in the order of hw_plugin.parameters */
  const hw_wall *walls;
  uint32_t wall_count; /* 0 to 8 */
} hw_context;

/* Tick k of one axis. x grows into the wall; a positive force pushes out of it. */
typedef struct hw_input {
  uint32_t size;           /* bytes of this struct; a later host may append members */
  uint32_t in_contact;     /* 0 or 1 */
  uint64_t tick;           /* counted from the last reset() */
  double wall_force_n;     /* F_e(k) */
  double position_m;       /* x_k as measured */
  double displacement_m;   /* x_k - x_{k-1} as measured */
  double velocity_m_per_s; /* displacement / period */
  double penetration_m;    /* into the outermost wall; negative in front of it */
  double previous_force_n; /* F_d(k-1) as commanded, after the clamp */
} hw_input;

/* The host owns the state: one block of `state_bytes` bytes for each axis of each run, aligned for
 * any type, zero before the first configure(), at the same address until the run ends. Keep nothing
 * else between calls: axes and runs are called from several threads at once.
 *
 * A call of configure() or reset() may come between two ticks of the real-time loop, as step()
 * does: no allocation, no lock, no system call, and far less than a period of time.
 *
 * Every function returns, with the rounding mode and the denormals that it found. exit() is an
 * error of the plug-in, another rounding mode a fault like an exception. */
typedef struct hw_plugin {
  uint32_t abi;                   /* HAPTICWALL_PLUGIN_ABI */
  uint32_t size;                  /* sizeof(hw_plugin) */
  uint32_t state_bytes;           /* 0 to 262144 */
  uint32_t parameter_count;       /* 0 to 16 */
  uint32_t signal_count;          /* 0 to 8 */
  const hw_parameter *parameters; /* NULL if there are none */
  const hw_signal *signals;       /* the same */
  const char *name;     /* of menus and files: a-z, 0-9 and -; not that of another algorithm */
  const char *title;    /* for people */
  const char *idea;     /* one line */
  const char *equation; /* one line; "" for none */
  /* At the start, and again with every change of scene or parameters. */
  void (*configure)(void *state, const hw_context *context);
  /* After the first configure(), and for a new start: forget the past, keep the configuration. */
  void (*reset)(void *state);
  /* F_d(k) in newtons. NaN and infinity end the run with zero force. `signals`: signal_count
   * numbers to write, NaN before the call; one that is not finite is none. */
  double (*step)(void *state, const hw_input *input, double *signals);
} hw_plugin;

#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
extern const hw_plugin hapticwall_plugin;

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
