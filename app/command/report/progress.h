// A progress bar on standard error, where that is a terminal and the work is long.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace hapticwall::command {

// "2 h 05 min", "3 min 20 s", "12 s".
[[nodiscard]] std::string duration_text(double seconds);

// Seconds that remain when so many have passed and `done` of the work is done, of which `began_at`
// was done before; nothing where that tells too little yet.
[[nodiscard]] std::optional<double> remaining_s(double passed_s, double began_at, double done);

class Progress {
 public:
  // `wanted` false, or no terminal: nothing is ever drawn.
  Progress(std::string label, bool wanted);
  ~Progress();  // the line is cleared
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // An earlier run has done this part of the work: it does not count for the time that remains.
  void begin_at(double fraction) { began_at_ = fraction; }
  // `fraction` of the work is done, 0 to 1; cheap enough to be called often.
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
