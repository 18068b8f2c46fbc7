#include "app/ui/window/display_end.h"

#include <dlfcn.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "app/session/loop/crash_stop.h"
#include "app/ui/window/application.h"

namespace hapticwall::ui {
namespace {

constexpr const char* kConnectionLost = "the display server ended the connection";
// Max time for the disk; after it the recording stays recoverable.
constexpr unsigned kMaxFinishS = 10;

Application* g_application = nullptr;  // Xlib's handlers take no data

[[noreturn]] void leave() { _exit(static_cast<int>(ErrorKind::kDisplay)); }

bool records(const session::LiveSession* session) {
  return session != nullptr &&
         session->recording_status().state == session::RecordingState::kRecording;
}

// Finishes the recording, but not if a device hangs, because its loop still records.
void finish_recording(session::LiveSession& session) {
  if (!session.snapshot().ended_by_fault) return;
  std::signal(SIGALRM, [](int) { leave(); });
  alarm(kMaxFinishS);
  static_cast<void>(session.stop_recording());
}

[[noreturn]] void end(const char* reason) {
  session::end_all_force();
  session::LiveSession* session = g_application->live();
  std::fprintf(stderr, "error: %s; the force is off%s\n", reason,
               records(session) ? ", and the recording is kept" : "");
  if (session != nullptr) finish_recording(*session);
  leave();
}

// The types of Xlib and libwayland, whose headers are not needed.
int on_lost_connection(void* /*display*/) { end(kConnectionLost); }
int on_refused_request(void* /*display*/, void* /*event*/) {
  end("the display server refused a request");
}

// Function of a library that GLFW has loaded; null otherwise.
template <typename Function>
Function* loaded_function(const char* library, const char* name) {
  void* handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
  if (handle == nullptr) return nullptr;
  auto* function = reinterpret_cast<Function*>(dlsym(handle, name));
  dlclose(handle);  // GLFW keeps it
  return function;
}

// nullptr: the handlers of Xlib.
void set_handlers(int (*lost)(void*), int (*refused)(void*, void*)) {
  constexpr const char* kXlib = "libX11.so.6";
  if (auto* set = loaded_function<void*(int (*)(void*))>(kXlib, "XSetIOErrorHandler")) set(lost);
  if (auto* set = loaded_function<void*(int (*)(void*, void*))>(kXlib, "XSetErrorHandler")) {
    set(refused);
  }
}

}  // namespace

DisplayEnd::DisplayEnd(Application& application) {
  g_application = &application;
  set_handlers(on_lost_connection, on_refused_request);
}

DisplayEnd::~DisplayEnd() {
  set_handlers(nullptr, nullptr);
  g_application = nullptr;
}

Failure lost_compositor() {
  // GLFW 3.3 for X11 does not have the first.
  auto* display = reinterpret_cast<void* (*)()>(dlsym(RTLD_DEFAULT, "glfwGetWaylandDisplay"));
  auto* error_of = loaded_function<int(void*)>("libwayland-client.so.0", "wl_display_get_error");
  if (display == nullptr || error_of == nullptr) return {};
  void* connection = display();
  if (connection == nullptr || error_of(connection) == 0) return {};
  return Error{ErrorKind::kDisplay, kConnectionLost};
}

}  // namespace hapticwall::ui
