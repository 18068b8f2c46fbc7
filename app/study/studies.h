// The list of studies. A new study is a line here and a line in studies.cpp.
#pragma once

#include <span>

#include "app/study/study.h"

namespace hapticwall::study {

[[nodiscard]] const Study& ranking_study();
[[nodiscard]] const Study& accuracy_study();
[[nodiscard]] const Study& worst_hand_study();
[[nodiscard]] const Study& named_hands_study();

// All studies, in the order of the window and of --help.
[[nodiscard]] std::span<const Study* const> studies();

}  // namespace hapticwall::study
