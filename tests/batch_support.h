// Support for the tests of the batch: summaries compared bit by bit, and every instruction set of
// this processor.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/run/batch_simulator.h"
#include "core/run/simulate.h"
#include "core/summary.h"
#include "tests/summary_support.h"

namespace hapticwall::testing {

// simulate(), one by one.
inline std::vector<Summary> one_by_one(const std::vector<Scene>& scenes) {
  std::vector<Summary> all;
  for (const Scene& scene : scenes) all.push_back(simulate(scene).summary);
  return all;
}

// The first scene whose summary differs from simulate()'s, in words; empty if none does.
inline std::string first_difference(const BatchResult& batch, const std::vector<Summary>& wanted) {
  if (batch.summaries.size() != wanted.size()) return "number of scenes";
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!batch.summaries[i]) return "scene " + std::to_string(i) + " has no summary";
    const std::string names = differences(*batch.summaries[i], wanted[i]);
    if (!names.empty()) return "scene " + std::to_string(i) + ": " + names;
  }
  return "";
}

}  // namespace hapticwall::testing
