// Speed and accuracy of every integrator and substep count on a scene, as a study.
#pragma once

#include "app/study/study.h"
#include "core/study/accuracy.h"

namespace hapticwall::study::accuracy {

[[nodiscard]] Outcome outcome_of(const AccuracyStudy& study);

// The work-precision diagram: two plots with logarithmic axes over ns per tick, the largest error
// of position (m) and the error of the tail's amplitude (%). Points carry their substeps; a hollow
// one has another verdict than the reference. Runs that diverged are named as missing.
[[nodiscard]] draw::LogFigure work_precision(const AccuracyStudy& study);

}  // namespace hapticwall::study::accuracy
