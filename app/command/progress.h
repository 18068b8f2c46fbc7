// A progress bar on standard error, where that is a terminal and the work is long.
#pragma once

#include <chrono>
#include <string>

namespace hapticwall::command {

class Progress {
 public:
  // `wanted` false, or no terminal: nothing is ever drawn.
  Progress(std::string label, bool wanted);
  ~Progress();  // the line is cleared
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `fraction` of the work is done, 0 to 1; cheap enough to be called often.
  void show(double fraction);

 private:
  std::string label_;
  bool enabled_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace hapticwall::command
