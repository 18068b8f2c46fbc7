/* A plug-in one of whose functions ends the process, hangs, or changes the rounding mode: ACT in
 * FUNCTION. step() acts once a force was commanded. */
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif
#include <fenv.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/algorithm/plugin/include/hapticwall/plugin.h"

#define QUOTED(name) #name
#define TEXT(name) QUOTED(name)

static void act(const char *function) {
  static volatile int endless = 1;
  const char *const what = TEXT(ACT);
  if (strcmp(function, TEXT(FUNCTION)) != 0) return;
  if (strcmp(what, "exit") == 0) exit(0);
  if (strcmp(what, "quick") == 0) quick_exit(0);
  if (strcmp(what, "abort") == 0) abort();
  if (strcmp(what, "rounding") == 0) fesetround(FE_UPWARD);
#if defined(__x86_64__)
  if (strcmp(what, "denormals") == 0) _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
  while (strcmp(what, "endless") == 0 && endless) {
  }
}

__attribute__((constructor)) static void start(void) { act("constructor"); }

static void configure(void *state, const hw_context *context) {
  (void)state;
  (void)context;
  act("configure");
}

static void reset(void *state) {
  (void)state;
  act("reset");
}

static double step(void *state, const hw_input *in, double *signals) {
  (void)state;
  (void)signals;
  if (in->previous_force_n > 1.0) act("step");
  return in->wall_force_n;
}

const hw_plugin hapticwall_plugin = {
    HAPTICWALL_PLUGIN_ABI,
    sizeof(hw_plugin),
    8,
    0,
    0,
    0,
    0,
    "test-" TEXT(ACT) "-" TEXT(FUNCTION),
    "Ending",
    "for tests",
    "",
    configure,
    reset,
    step,
};
