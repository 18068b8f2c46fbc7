// A scene under every algorithm with several named hands, as a study.
#pragma once

#include <vector>

#include "app/study/study.h"
#include "core/study/hands_study.h"

namespace hapticwall::study::named_hands {

[[nodiscard]] Outcome outcome_of(const HandsPlan& plan, const std::vector<HandsRow>& rows);

}  // namespace hapticwall::study::named_hands
