// `run --wav`: the sound against the recording of the same run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/sample.h"
#include "tests/app/command/binary.h"
#include "tests/spectrum.h"

namespace hapticwall::command::test {
namespace {

using hapticwall::test::decibels;
using hapticwall::test::Line;
using hapticwall::test::rms;
using hapticwall::test::strongest_line;

constexpr double kFileHz = 48000.0;
constexpr double kTickHz = 1000.0;
// The touch of `press` is at 0.69 s; the handle rests 0.3 s later.
constexpr double kAfterTheTouchS = 1.0;

class WavTest : public ProgramTest {
 protected:
  // Samples of a file of 24 bits, read by hand.
  [[nodiscard]] std::vector<double> sound(const std::string& name) const {
    const std::string bytes = content(name);
    const auto byte = [&](std::size_t i) {
      return static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes.at(i)));
    };
    const std::size_t data = bytes.find("data") + 8;
    std::vector<double> samples;
    for (std::size_t i = data; i + 2 < bytes.size(); i += 3) {
      const std::uint32_t word = byte(i) << 8U | byte(i + 1) << 16U | byte(i + 2) << 24U;
      samples.push_back(static_cast<double>(static_cast<std::int32_t>(word)) / 0x1p31);
    }
    return samples;
  }
  // Second difference of the true position.
  [[nodiscard]] std::vector<double> acceleration(const std::string& name) const {
    constexpr std::size_t kColumn = column_index(&PlantTruth::position_m);
    std::istringstream rows(content(name));
    std::string row;
    std::getline(rows, row);
    std::vector<double> positions;
    while (std::getline(rows, row)) {
      std::istringstream cells(row);
      std::string cell;
      for (std::size_t i = 0; i <= kColumn; ++i) std::getline(cells, cell, ',');
      positions.push_back(std::stod(cell));
    }
    std::vector<double> result;
    for (std::size_t i = 2; i < positions.size(); ++i)
      result.push_back(positions[i] - 2.0 * positions[i - 1] + positions[i - 2]);
    return result;
  }
  // Runs a scene; its sound from `from_s` to `to_s`.
  std::vector<double> heard(const std::string& scene, const std::string& algorithm, double from_s,
                            double to_s) {
    const Answer answer = hapticwall(
        {"run", scene, "--algorithm", algorithm, "--wav", "a.wav", "--csv", "a.csv", "--quiet"});
    EXPECT_EQ(answer.status, 0) << answer.err;
    return part(sound("a.wav"), kFileHz, from_s, to_s);
  }
  static std::vector<double> part(const std::vector<double>& all, double rate_hz, double from_s,
                                  double to_s) {
    return {all.begin() + static_cast<std::ptrdiff_t>(from_s * rate_hz),
            all.begin() + static_cast<std::ptrdiff_t>(to_s * rate_hz)};
  }
};

TEST_F(WavTest, TheStrongestLineIsThatOfTheRecording) {
  for (const auto& [scene, expected_hz] : {std::pair{"press", 50.0}, {"tap", 62.5}}) {
    const std::vector<double> of_wav = heard(scene, "none", 4.0, 5.0);
    const std::vector<double> moved = part(acceleration("a.csv"), kTickHz, 4.0, 5.0);
    const Line of_file = strongest_line(std::span<const double>(of_wav), kFileHz, 20.0, 300.0, 0.5);
    const Line of_rows = strongest_line(std::span<const double>(moved), kTickHz, 20.0, 300.0, 0.5);
    RecordProperty(std::string(scene) + "_hz", std::to_string(of_file.hz));
    EXPECT_NEAR(of_file.hz, of_rows.hz, 1.0) << scene;
    EXPECT_NEAR(of_file.hz, expected_hz, 1.0) << scene;
    // Metres a tick² to m/s², and to full scales.
    const double expected = of_rows.amplitude * kTickHz * kTickHz / 200.0;
    EXPECT_NEAR(of_file.amplitude / expected, 0.93, 0.05) << scene;
  }
}

TEST_F(WavTest, EnergyBoundingIsFortyDecibelsBelowNone) {
  const std::vector<double> none = heard("press", "none", kAfterTheTouchS, 5.99);
  const std::vector<double> bounded = heard("press", "energy-bounding", kAfterTheTouchS, 5.99);
  const double apart_db =
      decibels(rms(std::span<const double>(none)) / rms(std::span<const double>(bounded)));
  RecordProperty("apart_db", std::to_string(apart_db));
  EXPECT_GT(apart_db, 40.0);
  EXPECT_GT(rms(std::span<const double>(bounded)), 0.0);
}

TEST_F(WavTest, IsAFileThatOthersRead) {
  ASSERT_EQ(hapticwall({"run", "tap", "--duration", "0.5", "--wav", "tap.wav"}).status, 0);
  const std::string bytes = content("tap.wav");
  EXPECT_THAT(bytes, StartsWith("RIFF"));
  EXPECT_THAT(bytes, HasSubstr("WAVEfmt "));
  EXPECT_EQ(sound("tap.wav").size(), 499U * 48U);
  ASSERT_EQ(hapticwall({"run", "tap", "--duration", "0.5", "--wav", "again.wav"}).status, 0);
  EXPECT_TRUE(bytes == content("again.wav"));
  EXPECT_THAT(files(), ElementsAre("again.wav", "tap.wav"));
  const Answer piped = shell("$P run tap --duration 0.5 --wav /dev/stderr --quiet");
  EXPECT_TRUE(piped.err == bytes);
}

TEST_F(WavTest, TwoAxesAndARunInRealTimeSoundToo) {
  ASSERT_EQ(hapticwall({"run", "corner", "--wav", "a.wav", "--quiet"}).status, 0);
  const std::vector<double> corner = sound("a.wav");
  EXPECT_GT(rms(std::span<const double>(corner)), 1e-4);
  ASSERT_EQ(hapticwall({"run", "tap", "--duration", "0.3", "--wav", "b.wav", "--quiet"}).status, 0);
  ASSERT_EQ(
      hapticwall({"run", "tap", "--duration", "0.3", "--realtime", "--wav", "c.wav", "--quiet"})
          .status,
      0);
  EXPECT_TRUE(content("b.wav") == content("c.wav"));
}

}  // namespace
}  // namespace hapticwall::command::test
