// The accuracy of integrators over several hands: tables, JSON, CSV and figure.
#pragma once

#include "app/study/study.h"
#include "core/study/accuracy_hands.h"

namespace hapticwall::study::accuracy {

[[nodiscard]] Outcome outcome_of(const AccuracyHandsPlan& plan, const AccuracyHands& measured);

// The largest error of the tail's amplitude (%) over the substeps.
[[nodiscard]] draw::LogFigure error_over_hands(const AccuracyHandsPlan& plan,
                                               const AccuracyHands& measured);

}  // namespace hapticwall::study::accuracy
