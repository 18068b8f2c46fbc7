// A progress bar on standard error, if that is a terminal and the work is long.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace hapticwall::command {

// "2 h 05 min", "3 min 20 s", "12 s".
[[nodiscard]] std::string duration_text(double seconds);

// The estimated remaining seconds after `passed_s`, when the work went from the fraction `began_at`
// to `done`; nullopt while that is too little for an estimate.
[[nodiscard]] std::optional<double> remaining_s(double passed_s, double began_at, double done);

class Progress {
 public:
  // Draws nothing if not `wanted` or if there is no terminal.
  Progress(std::string label, bool wanted);
  ~Progress();  // clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // An earlier run did this fraction of the work; the estimate of the remaining time leaves it out.
  void begin_at(double fraction) { began_at_ = fraction; }
  // `fraction` of the work is done, 0 to 1. Cheap: may be called often.
  void show(double fraction);

 private:
  std::string label_;
  bool enabled_;
  bool drawn_ = false;
  double began_at_ = 0.0;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace hapticwall::command
