// Decides whether a frame needs painting: at rest most frames equal the previous one.
#pragma once

#include <imgui.h>

#include <cstdint>

namespace hapticwall::ui {

class PaintGate {
 public:
  // `pictures`: a number that changes with the content of any texture. True if the frame differs
  // from the last one for which this was true.
  [[nodiscard]] bool needs_painting(const ImDrawData& frame, std::uint64_t pictures);
  // The window system has lost the picture.
  void forget() { known_ = false; }

 private:
  std::uint64_t painted_ = 0;  // hash of that frame
  bool known_ = false;
};

}  // namespace hapticwall::ui
