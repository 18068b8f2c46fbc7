#include "tests/offscreen/offscreen.h"

// EGL cannot be included together with epoxy: both declare the same types, differently.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

namespace hapticwall::test {
namespace {

bool has_client_extension(std::string_view name) {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return extensions != nullptr && std::string_view(extensions).find(name) != std::string_view::npos;
}

EGLDisplay open_platform(EGLenum platform, void* native) {
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_display == nullptr) return EGL_NO_DISPLAY;
  const EGLDisplay display = get_display(platform, native, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
    return EGL_NO_DISPLAY;
  return display;
}

// Opens the first device that answers, for drivers other than Mesa's.
EGLDisplay open_any_device() {
  const auto query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  std::array<EGLDeviceEXT, 8> devices{};
  EGLint count = 0;
  if (query_devices == nullptr ||
      query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) {
    return EGL_NO_DISPLAY;
  }
  for (EGLint i = 0; i < count; ++i) {
    const EGLDisplay display =
        open_platform(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)]);
    if (display != EGL_NO_DISPLAY) return display;
  }
  return EGL_NO_DISPLAY;
}

EGLDisplay open_display() {
  EGLDisplay display = EGL_NO_DISPLAY;
  if (has_client_extension("EGL_MESA_platform_surfaceless")) {
    display = open_platform(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
  }
  if (display == EGL_NO_DISPLAY && has_client_extension("EGL_EXT_device_enumeration")) {
    display = open_any_device();
  }
  return display;
}

// Mesa waits forever for a thread that could not be started.
bool can_start_threads() {
  constexpr std::size_t kMaxThreads = 32;  // limit of Mesa
  const std::size_t count = std::min<std::size_t>(std::thread::hardware_concurrency(), kMaxThreads);
  std::atomic<bool> end = false;
  std::vector<std::jthread> threads;
  try {
    while (threads.size() < count) threads.emplace_back([&] { end.wait(false); });
  } catch (const std::system_error&) {
  }
  end = true;
  end.notify_all();
  return threads.size() == count;
}

class Context final : public OffscreenContext {
 public:
  explicit Context(EGLDisplay display) : display_(display) {}
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    // The display stays: it is one for the process, and other contexts may live on it.
  }

  bool make_current() {
    constexpr std::array kConfig{EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                 EGL_OPENGL_BIT, EGL_NONE};
    constexpr std::array kVersion{EGL_CONTEXT_MAJOR_VERSION,
                                  3,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE ||
        eglChooseConfig(display_, kConfig.data(), &config, 1, &count) != EGL_TRUE || count == 0) {
      return false;
    }
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, kVersion.data());
    return context_ != EGL_NO_CONTEXT &&
           eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }

 private:
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

Result<std::unique_ptr<OffscreenContext>> OffscreenContext::create() {
  if (!can_start_threads()) {
    return Error{ErrorKind::kFile,
                 "pictures need a thread for each core, and no more can be started ('ulimit -u')"};
  }
  const EGLDisplay display = open_display();
  if (display == EGL_NO_DISPLAY) {
    return Error{ErrorKind::kFile,
                 "pictures need EGL without a display (Mesa's libegl-mesa0, or a driver with "
                 "EGL_EXT_device_enumeration), and there is none on this machine"};
  }
  auto context = std::make_unique<Context>(display);
  if (!context->make_current()) {
    return Error{ErrorKind::kFile,
                 "pictures need OpenGL 3.3, and the driver of this machine has less"};
  }
  return std::unique_ptr<OffscreenContext>(std::move(context));
}

}  // namespace hapticwall::test
