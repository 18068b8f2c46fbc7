#include <array>
#include <charconv>
#include <concepts>
#include <initializer_list>

#include "app/file/recording_writer.h"
#include "app/file/text.h"

namespace hapticwall::file {
namespace {

constexpr std::string_view kTimeHeader = "tick,time_s";
constexpr std::string_view kHeader =
    ",position_m,velocity_m_per_s,penetration_m,wall_force_n,force_n,stiffness_n_per_m,"
    "energy_cv_j,energy_hold_j,energy_scv_j,energy_budget_j,flags";
constexpr std::string_view kTruthHeader =
    ",true_position_m,true_velocity_m_per_s,hand_path_m,hand_force_n,true_actuator_work_j,"
    "true_dissipation_j,true_hand_work_j,kinetic_j";
constexpr std::string_view kDeviceHeader = ",device_time_s,read_age_s";
constexpr std::string_view kSecondAxisPrefix = ",y_";
constexpr std::size_t kLongestInteger = 20;

void append_numbers(std::string& text, std::initializer_list<double> values) {
  for (const double value : values) {
    text += ',';
    append_number(text, value);
  }
}

void append_integer(std::string& text, std::unsigned_integral auto value) {
  std::array<char, kLongestInteger> digits{};
  text.append(digits.data(),
              std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

// All of one axis but tick and time.
void append_axis(std::string& text, const Sample& sample, MoreColumns columns) {
  append_numbers(
      text, {sample.position_m, sample.velocity_m_per_s, sample.penetration_m, sample.wall_force_n,
             sample.force_n, sample.stiffness_n_per_m, sample.energy_cv_j, sample.energy_hold_j,
             sample.energy_scv_j, sample.energy_budget_j});
  text += ',';
  append_integer(text, sample.flags);
  if (of_simulator(columns)) {
    const PlantTruth& truth = sample.truth;
    append_numbers(
        text, {truth.position_m, truth.velocity_m_per_s, truth.hand_path_m, truth.hand_force_n,
               truth.actuator_work_j, truth.dissipation_j, truth.hand_work_j, truth.kinetic_j});
  } else {
    append_numbers(text, {sample.device_time_s, sample.read_age_s});
  }
}

}  // namespace

std::string csv_header(MoreColumns columns) {
  std::string axis(kHeader);
  axis += of_simulator(columns) ? kTruthHeader : kDeviceHeader;
  std::string header = std::string(kTimeHeader) + axis;
  if (!has_second_axis(columns)) return header;
  for (const char c : axis) header += c == ',' ? std::string(kSecondAxisPrefix) : std::string(1, c);
  return header;
}

void append_csv_row(std::string& text, const Sample& sample, MoreColumns columns, const Sample& y) {
  append_integer(text, sample.tick);
  append_numbers(text, {sample.time_s});
  append_axis(text, sample, columns);
  if (has_second_axis(columns)) append_axis(text, y, columns);
  text += '\n';
}

bool is_finite(const Sample& sample) {
  const PlantTruth& truth = sample.truth;
  // A sum of finite numbers can overflow, but none of these comes near that; times zero it is zero
  // exactly when every one is finite.
  double zero = 0.0;
  for (const double value : {sample.time_s,
                             sample.position_m,
                             sample.velocity_m_per_s,
                             sample.penetration_m,
                             sample.wall_force_n,
                             sample.force_n,
                             sample.stiffness_n_per_m,
                             sample.energy_cv_j,
                             sample.energy_hold_j,
                             sample.energy_scv_j,
                             sample.energy_budget_j,
                             truth.position_m,
                             truth.velocity_m_per_s,
                             truth.hand_path_m,
                             truth.hand_force_n,
                             truth.actuator_work_j,
                             truth.dissipation_j,
                             truth.hand_work_j,
                             truth.kinetic_j,
                             sample.device_time_s,
                             sample.read_age_s}) {
    zero += value * 0.0;
  }
  return zero == 0.0;
}

}  // namespace hapticwall::file
