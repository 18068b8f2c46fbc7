// What the layers under the window lack in a browser: threads, files of pictures, plug-ins, sound
// cards and a priority. Capabilities hide what leads here; a test of the page presses the rest.
#include <emscripten.h>

#include <cmath>
#include <system_error>

#include "app/draw/figure/page.h"
#include "app/file/picture.h"
#include "app/file/plugin/plugin_library.h"
#include "app/session/line_pipe.h"
#include "app/session/loop/crash_stop.h"
#include "app/session/loop/loop_driver.h"
#include "app/session/loop/realtime_setup.h"
#include "app/sound/live/card.h"
#include "app/sound/signal/resampler.h"

namespace hapticwall {
namespace {

Error lacking(const char* what) {
  return {ErrorKind::kUsage,
          std::string(what) + ": not in a browser; the program for the desktop has it"};
}

}  // namespace

namespace file {

Failure write_png(const std::string& /*path*/, const Picture& /*picture*/) {
  return lacking("PNG files");
}
Result<LibraryBytes> read_library(const std::string& /*path*/) { return lacking("plug-ins"); }
Result<const void*> load_library(const LibraryBytes& /*file*/, const char* /*symbol*/,
                                 const ProblemOf& /*problem_of*/) {
  return lacking("plug-ins");
}
Error not_a_plugin(const std::string& /*path*/, std::string_view /*problem*/) {
  return lacking("plug-ins");
}

}  // namespace file

namespace draw {

float print_scale() { return 1.0F; }
Result<file::Picture> draw_page(const Paper& /*paper*/, const DrawPage& /*draw*/) {
  return lacking("figures for print");
}

}  // namespace draw

namespace sound {

bool may_have_card() { return false; }
Result<std::unique_ptr<Card>> open_usual_card(const FillSound& /*fill*/) {
  return lacking("sound");
}
Resampler::Resampler(double /*from_hz*/, double /*to_hz*/) {}
void Resampler::push(double /*sample*/, std::vector<float>& /*out*/) {}

}  // namespace sound

namespace session {

CrashStop::CrashStop() = default;
CrashStop::~CrashStop() = default;

std::unique_ptr<LoopDriver> start_loop_thread(ServoLoop& /*loop*/, Exchange& /*exchange*/,
                                              double /*rate_hz*/, Clock& /*clock*/,
                                              int /*affinity_core*/) {
  throw std::system_error(std::make_error_code(std::errc::not_supported),
                          "a browser has no thread");
}
Failure refuse_without_realtime(const device::DeviceInfo& /*device*/,
                                const RealtimeStatus& /*status*/, bool /*allowed*/) {
  return std::nullopt;  // there is the simulator alone
}
void set_up_recorder_thread() {}
void set_up_background_thread() {}
std::int64_t thread_processor_time_ns() { return MonotonicClock().now_ns(); }
std::int64_t MonotonicClock::now_ns() { return std::llround(emscripten_get_now() * 1e6); }
void MonotonicClock::sleep_until_ns(std::int64_t /*deadline_ns*/) {}

// Experiments end there.
LinePipe::~LinePipe() = default;
void LinePipe::send(std::string_view /*line*/) {}
std::optional<std::string> LinePipe::take() { return std::nullopt; }
bool LinePipe::ended() const { return true; }

}  // namespace session
}  // namespace hapticwall
