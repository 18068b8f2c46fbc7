// Boards that do not speak the protocol, byte by byte as their firmware does it: nothing here knows
// the program's tables. In virtual time.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/plant/plant_model.h"
#include "core/scene.h"

namespace hapticwall::device::hid::testing {

using Bytes = std::vector<std::uint8_t>;

// A handle on a plant and a firmware.
class ForeignBoard {
 public:
  explicit ForeignBoard(const Scene& scene) : plant(scene) {}
  ForeignBoard(const ForeignBoard&) = delete;
  ForeignBoard& operator=(const ForeignBoard&) = delete;
  virtual ~ForeignBoard() = default;

  // One millisecond; the reports that come out of it.
  std::vector<Bytes> tick() {
    ++now_ms;
    plant.advance(-force_n());
    if (silent) return {};
    return reports();
  }
  // Takes a write as it arrives, with the id in front; false if the device takes none.
  bool take(std::span<const std::uint8_t> bytes) {
    if (refuses) return false;
    written.emplace_back(bytes.begin(), bytes.end());
    obey(bytes);
    return true;
  }
  // Newtons towards growing positions.
  [[nodiscard]] virtual double force_n() const = 0;

  PlantModel plant;
  std::uint64_t now_ms = 0;
  std::vector<Bytes> written;
  double jump_m = 0.0;  // a lie
  bool silent = false;
  bool refuses = false;
  bool blocks = false;  // no write returns

 protected:
  [[nodiscard]] double position_m() const { return plant.measured_position_m() + jump_m; }
  virtual std::vector<Bytes> reports() = 0;
  virtual void obey(std::span<const std::uint8_t> bytes) = 0;
};

// An mbed LPC1768 between encoders and motor controllers: milliamperes in, half a second of
// watchdog.
class MbedBoard : public ForeignBoard {
 public:
  static constexpr std::uint64_t kWatchdogMs = 500;
  static constexpr double kMaxAmpere = 3.0;

  MbedBoard(const Scene& scene, double count_m, double newtons_per_ampere)
      : ForeignBoard(scene), count_m_(count_m), newtons_per_ampere_(newtons_per_ampere) {}

  [[nodiscard]] double force_n() const override {
    const bool alive = heard_ms_ && now_ms - *heard_ms_ < kWatchdogMs;
    return alive ? ampere_ * newtons_per_ampere_ : 0.0;
  }

 protected:
  [[nodiscard]] std::int16_t counts() const {
    const double counts = position_m() / count_m_;
    return static_cast<std::int16_t>(counts < 0.0 ? counts - 0.5 : counts + 0.5);
  }
  void hear() { heard_ms_ = now_ms; }
  void drive(std::int16_t milliamperes) {
    ampere_ = milliamperes * 1e-3;
    if (ampere_ > kMaxAmpere) ampere_ = kMaxAmpere;
    if (ampere_ < -kMaxAmpere) ampere_ = -kMaxAmpere;
  }

 private:
  double count_m_;
  double newtons_per_ampere_;
  std::optional<std::uint64_t> heard_ms_;
  double ampere_ = 0.0;
};

// Polhem v1: a report for each command.
class PolhemBoard : public MbedBoard {
 public:
  // `report_bytes`: 14 of the mbed; 64 of a board whose packets are always full.
  explicit PolhemBoard(const Scene& scene, std::size_t report_bytes = 14)
      : MbedBoard(scene, 24.43e-6, 6.917), report_bytes_(report_bytes) {}

 protected:
  std::vector<Bytes> reports() override {
    if (due_ == 0) return {};
    due_ = 0;
    const std::int16_t word = counts();
    Bytes report(report_bytes_);
    for (const std::size_t encoder : {0U, 1U, 2U}) std::memcpy(&report[2 * encoder], &word, 2);
    report[3] ^= 0x15;  // the others are elsewhere
    return {report};
  }
  void obey(std::span<const std::uint8_t> bytes) override {
    if (bytes.size() != report_bytes_ + 1 || bytes[0] != 0) return;
    std::array<std::int16_t, 4> words{};
    std::memcpy(words.data(), &bytes[1], sizeof words);
    ++due_;
    hear();
    if (words[3] == 0) drive(words[0]);  // else a command that sets the encoders
  }

 private:
  std::size_t report_bytes_;
  int due_ = 1;  // the first one comes by itself
};

// WoodenHaptics: a report every millisecond, also without commands. Its encoder a counts backwards.
class WoodenBoard : public MbedBoard {
 public:
  static constexpr std::size_t kBytes = 8;

  explicit WoodenBoard(const Scene& scene) : MbedBoard(scene, -43.20e-6, 1.8836) {}

 protected:
  std::vector<Bytes> reports() override {
    const std::array<std::int16_t, 4> words{counts(), 77, -77, ++reports_};
    Bytes report(kBytes);
    std::memcpy(report.data(), words.data(), kBytes);
    return {report};
  }
  void obey(std::span<const std::uint8_t> bytes) override {
    if (bytes.size() != kBytes + 1 || bytes[0] != 0) return;
    std::int16_t milliamperes = 0;
    std::memcpy(&milliamperes, &bytes[1], sizeof milliamperes);
    hear();
    drive(milliamperes);
  }

 private:
  std::int16_t reports_ = 0;
};

// A knob of 0.1 m that reports radians as floats: after the first write, and when it moved.
// Numbered reports: 1 from the device, 2 to it. Newton metres, backwards, at 4. No watchdog.
class FloatKnob : public ForeignBoard {
 public:
  static constexpr double kRadiusM = 0.1;
  static constexpr std::size_t kBytes = 16;
  static constexpr const char* kFile = R"(name = "Knob"
source = "a test"
[usb]
vendor_id = 0x1209
product_id = 0x0002
[in]
report_id = 1
bytes = 16
x = { offset = 8, type = "f32", m_per_unit = 0.1 }
reports_on_change = true
[out]
report_id = 2
bytes = 16
x = { offset = 4, type = "f32", n_per_unit = -10 }
keep_alive_ms = 5
[x]
encoder_m = 7.67e-5
force_limit_n = 5
)";

  using ForeignBoard::ForeignBoard;

  [[nodiscard]] double force_n() const override { return -torque_nm_ / kRadiusM; }

  bool breaks = false;  // tells NaN

 protected:
  std::vector<Bytes> reports() override {
    const auto angle = breaks ? std::numeric_limits<float>::quiet_NaN()
                              : static_cast<float>(position_m() / kRadiusM);
    if (angle == told_rad_) return {};
    told_rad_ = angle;
    Bytes report(kBytes + 1);
    report[0] = 1;
    std::memcpy(&report[1 + 8], &angle, sizeof angle);
    return {report};
  }
  void obey(std::span<const std::uint8_t> bytes) override {
    if (bytes.size() != kBytes + 1 || bytes[0] != 2) return;
    if (written.size() == 1) told_rad_ = kNothingYet;
    std::memcpy(&torque_nm_, &bytes[1 + 4], sizeof torque_nm_);
  }

 private:
  static constexpr float kNothingYet = 1e9F;
  float told_rad_ = kNothingYet;
  float torque_nm_ = 0.0F;
};

}  // namespace hapticwall::device::hid::testing
