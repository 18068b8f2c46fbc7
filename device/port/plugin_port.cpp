#include "device/port/plugin_port.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string_view>
#include <thread>
#include <utility>

#include "core/algorithm/plugin/library_call.h"
#include "core/scene_keys.h"
#include "core/text.h"
#include "device/link/stand_in.h"
#include "device/port/node_lock.h"

namespace hapticwall::device {
namespace {

// Shortest time from one read() to the next.
constexpr std::int64_t kPaceNs = kMillisecondNs / 2;
constexpr std::int64_t kKeepAliveNs = 10 * kMillisecondNs;
constexpr std::size_t kMaxTitleBytes = 100;
constexpr std::size_t kMaxWordsBytes = 200;

// A line of the library that may hold anything.
std::string line_of(const char* text, std::size_t max_bytes) {
  constexpr std::string_view kReplacement = "?";
  const std::string_view line = text == nullptr ? "" : text;
  std::string clean;
  for (std::size_t i = 0; i < line.size() && clean.size() < max_bytes;) {
    const std::string_view rest = line.substr(i);
    const std::size_t length = std::max<std::size_t>(utf8_length(rest), 1);
    const bool bad = utf8_length(rest) == 0 || starts_with_control(rest);
    clean += bad ? kReplacement : rest.substr(0, length);
    i += length;
  }
  return clean;
}

std::atomic<const char*> g_faulty_function{nullptr};
std::atomic<LibraryFault> g_fault{LibraryFault::kNone};

// A library's fault ends here, as a failed call.
template <class Call>
int guarded(const LibraryCall& where, const Call& call) {
  int result = HW_READ_FAILED;
  const LibraryFault fault = call_library(where, [&] { result = call(); });
  if (fault == LibraryFault::kNone) return result;
  g_faulty_function = where.function;
  g_fault = fault;
  return HW_READ_FAILED;
}

LibraryCall call_of(const PluginDevice& device, const char* function) {
  return {.library = device.path.c_str(), .function = function, .kind = ErrorKind::kDevice};
}

// The ranges of a device file.
std::string info_problem(const hw_device_info& info) {
  struct Number {
    const char* name;
    double value;
    ValueRange range;
    const char* unit;
  };
  for (const Number& number :
       {Number{"encoder_m", info.encoder_m, {1e-9, 0.01}, "m"},
        Number{"force_limit_n", info.force_limit_n, {0.0, hid::kMaxForceN, true}, "N"},
        Number{"min_m", info.min_m, {-10.0, 0.0}, "m"},
        Number{"max_m", info.max_m, {0.0, 10.0}, "m"},
        Number{"max_speed_m_per_s", info.max_speed_m_per_s, {0.0, 100.0, true}, "m/s"},
        Number{"max_force_rate_n_per_s", info.max_force_rate_n_per_s, {0.0, 1e6}, "N/s"}}) {
    if (number.range.contains(number.value)) continue;
    return std::string(number.name) + ": " +
           out_of_range_text(number.value, number.range, number.unit);
  }
  return "";
}

// "PATH: WHAT: the library's own words".
Error plugin_error(const PluginDevice& device, const std::string& what) {
  std::string words;
  static_cast<void>(guarded(call_of(device, "last_error()"), [&] {
    words = line_of(device.plugin->last_error(), kMaxWordsBytes);
    return 0;
  }));
  return device_error(device.path + ": " + what + (words.empty() ? "" : ": " + words));
}

}  // namespace

std::string device_plugin_problem(const hw_device_plugin& plugin) {
  if (plugin.abi != HAPTICWALL_DEVICE_ABI)
    return "it was built for ABI " + std::to_string(plugin.abi) + ", this program has ABI " +
           std::to_string(HAPTICWALL_DEVICE_ABI);
  if (plugin.size != sizeof(hw_device_plugin))
    return "its hw_device_plugin has " + std::to_string(plugin.size) +
           " bytes, this program's has " + std::to_string(sizeof(hw_device_plugin));
  if (plugin.info == nullptr || plugin.open == nullptr || plugin.read == nullptr ||
      plugin.write == nullptr || plugin.close == nullptr || plugin.last_error == nullptr)
    return "info, open, read, write, close or last_error is NULL";
  const std::string title = line_of(plugin.title, kMaxTitleBytes);
  if (title.empty() || title != plugin.title)
    return "its title must be one line of UTF-8 of at most 100 bytes";
  return "";
}

Result<PluginDevice> describe_plugin(const hw_device_plugin& plugin, const std::string& path) {
  PluginDevice device{&plugin, path, {}, plugin.title};
  device.info.size = sizeof(hw_device_info);
  if (guarded(call_of(device, "info()"), [&] { return plugin.info(&device.info); }) != 0)
    return plugin_error(device, "info() failed");
  const std::string problem = info_problem(device.info);
  if (!problem.empty()) return device_error(path + ": info(): " + problem);
  return device;
}

std::string device_plugin_fault() {
  const char* const function = g_faulty_function;
  if (function == nullptr) return "";
  return std::string(function) + " " + std::string(library_fault_text(g_fault)) +
         ", which is a failed call";
}

ImpulseEngineOptions options_of(const PluginDevice& device) {
  const hw_device_info& info = device.info;
  ImpulseEngineOptions options;
  options.path = device.path;
  options.name = device.name;
  options.axes[0] = AxisDescription{info.encoder_m,
                                    info.force_limit_n,
                                    {info.min_m, info.max_m, info.max_speed_m_per_s},
                                    info.max_force_rate_n_per_s};
  options.keep_alive_ns = kKeepAliveNs;
  options.delay_is_known = (info.flags & HW_DEVICE_ANSWERS) != 0;
  options.has_clock = false;
  options.reads_may_hang = true;
  return options;
}

// Connection from open() to close() of the library, for both handles.
class PluginPort::Connection {
 public:
  Connection(PluginDevice described, std::shared_ptr<hid::NodeLock> lock)
      : device(std::move(described)),
        plugin(*device.plugin),
        answers((device.info.flags & HW_DEVICE_ANSWERS) != 0),
        calibrated((device.info.flags & HW_DEVICE_CALIBRATED) != 0),
        stand_in({device.info.encoder_m, 0.0}, kPaceNs),
        lock_(std::move(lock)) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    static_cast<void>(guarded(call_of(device, "close()"), [this] {
      plugin.close();
      return 0;
    }));
  }

  const PluginDevice device;
  const hw_device_plugin& plugin;
  const bool answers;
  const bool calibrated;
  hid::StandIn stand_in;
  // Set when one of the two handles has closed: no new handle may share the device.
  std::atomic<bool> closing{false};

 private:
  std::shared_ptr<hid::NodeLock> lock_;
};

class PluginPort::PluginHandle : public hid::Handle {
 public:
  PluginHandle(std::shared_ptr<Connection> connection, HostClock now_ns)
      : connection_(std::move(connection)), now_ns_(std::move(now_ns)) {}
  ~PluginHandle() override { connection_->closing = true; }

  hid::ReadOutcome read(std::span<std::uint8_t> bytes, int wait_ms) override {
    const std::int64_t early_ns = kPaceNs - (now_ns_() - returned_ns_);
    if (early_ns > 0 && wait_ms == 0) return {};
    if (early_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(early_ns));
    hw_device_reading reading{};
    reading.size = sizeof reading;
    const int result = guarded(call_of(connection_->device, "read()"),
                               [&] { return connection_->plugin.read(&reading); });
    returned_ns_ = now_ns_();
    if (result == HW_READ_NOTHING) return {};
    if (result != HW_READ_POSITION) return {hid::ReadKind::kFailed, 0};
    const hid::ReportBytes state =
        connection_->stand_in.state({reading.position_m, 0.0}, returned_ns_, told(reading));
    const std::size_t size = std::min(bytes.size(), state.size());
    std::copy_n(state.begin(), size, bytes.begin());
    return {hid::ReadKind::kReport, size};
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    const hid::Decoded<hid::ForceReport> force = hid::decode_force(bytes);
    if (force.report() == nullptr) return false;
    const hid::ForceReport& report = *force.report();
    const double force_n = report.enable ? 0.0 - report.force_n[0] : 0.0;
    const hw_device_command command{sizeof command, report.sequence, report.enable ? 1U : 0U,
                                    force_n};
    LastCommand last{connection_->plugin,
                     {sizeof command, (command.number + 1U) & 0xFFFFU, 0U, 0.0}};
    LibraryCall here = call_of(connection_->device, "write()");
    here.remove_force = LastCommand::write;
    here.owner = &last;
    if (guarded(here, [&] { return connection_->plugin.write(&command); }) != 0) {
      connection_->stand_in.refused();
      return false;
    }
    if (!connection_->answers) connection_->stand_in.took(report, now_ns_());
    return true;
  }

  std::size_t get_feature(std::uint8_t /*id*/, std::span<std::uint8_t> /*bytes*/) override {
    return 0;
  }

 private:
  // Follows a write() that ends the process: no other thread may write meanwhile.
  struct LastCommand {
    const hw_device_plugin& plugin;
    hw_device_command command;

    static void write(void* self) noexcept {
      const auto& last = *static_cast<LastCommand*>(self);
      static_cast<void>(last.plugin.write(&last.command));
    }
  };

  [[nodiscard]] hid::Told told(const hw_device_reading& reading) const {
    hid::Told told{.fault = (reading.flags & HW_READING_FAULT) != 0,
                   .calibrated = connection_->calibrated};
    if (connection_->answers)
      told.answer = {static_cast<std::uint16_t>(reading.command),
                     (reading.flags & HW_READING_ENABLED) != 0, 0.0 - reading.force_n};
    return told;
  }

  std::shared_ptr<Connection> connection_;
  const HostClock now_ns_;
  std::int64_t returned_ns_ = 0;  // read()
};

PluginPort::PluginPort(PluginDevice device, HostClock now_ns)
    : device_(std::move(device)), now_ns_(std::move(now_ns)) {}

PluginPort::~PluginPort() = default;

Result<std::vector<hid::Listing>> PluginPort::list() {
  hid::Listing listing;
  listing.path = device_.path;
  listing.product = device_.plugin->title;
  listing.usage_page = hid::kUsagePage;
  listing.usage = hid::kUsage;
  return std::vector<hid::Listing>{listing};
}

Result<std::unique_ptr<hid::Handle>> PluginPort::open(const std::string& path) {
  auto connection = open_.lock();
  if (connection && connection->closing)
    return device_error(path + ": a call of the library has not returned");
  if (!connection) {
    auto lock = hid::NodeLock::take(device_.path, path);
    if (!lock) return lock.error();
    pulse_.begin();
    LibraryCall here = call_of(device_, "open()");
    here.pulse = &pulse_;
    if (guarded(here, [this] { return device_.plugin->open(); }) != 0)
      return plugin_error(device_, "open() failed");
    open_ = connection = std::make_shared<Connection>(device_, std::move(*lock));
  }
  return std::unique_ptr<hid::Handle>(std::make_unique<PluginHandle>(connection, now_ns_));
}

hid::Obstacle PluginPort::obstacle(const std::string& /*path*/) { return hid::Obstacle::kNone; }

}  // namespace hapticwall::device
