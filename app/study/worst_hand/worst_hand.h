// The search for a hand that takes energy out of the wall, as a study.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/draw/plot/log_plot.h"
#include "app/study/study.h"
#include "core/study/worst_hand/damping_criterion.h"
#include "core/study/worst_hand/worst_hand.h"

namespace hapticwall::study::hands {

// The search under one algorithm.
struct Row {
  std::string algorithm;
  worst_hand::Bounds bounds = worst_hand::Bounds::kWide;
  worst_hand::Motion motion = worst_hand::Motion::kLetGo;
  worst_hand::Found found;
  std::optional<worst_hand::DampingCriterion> criterion;  // of a linear loop
};

// `plan`: that of all rows; its algorithm is that of the first row.
[[nodiscard]] Outcome outcome_of(const worst_hand::Plan& plan, const std::vector<Row>& rows);

// Names the accepted numbers of hands if `text` is none; else "".
[[nodiscard]] std::string wrong_hands(std::string_view text);

// Energy over the number of hands.
[[nodiscard]] draw::LogFigure gains_figure(const worst_hand::Plan& plan,
                                           const std::vector<Row>& rows);

}  // namespace hapticwall::study::hands
