// hapticwall_determinism [HASHES]: the SHA-256 of what every case computes, a line each; with a
// file of such lines, what differs from it, and status 1.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/determinism/cases.h"

namespace {

using hapticwall::determinism::Case;

std::vector<std::string> lines_of(const std::vector<Case>& cases) {
  std::vector<std::string> lines;
  lines.reserve(cases.size());
  for (const Case& one : cases) lines.push_back(one.sha256 + "  " + one.arguments);
  return lines;
}

// How many lines are in one of both only.
std::size_t print_differences(std::vector<std::string> found, std::vector<std::string> expected) {
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  std::vector<std::string> different;
  std::set_symmetric_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                                std::back_inserter(different));
  for (const std::string& line : different) {
    const bool ours = std::binary_search(found.begin(), found.end(), line);
    std::printf("%s %s\n", ours ? "found   " : "expected", line.c_str());
  }
  return different.size();
}

int compare_with(const char* path, const std::vector<std::string>& found) {
  std::ifstream file(path);
  if (!file) {
    std::fprintf(stderr, "error: %s: cannot be read\n", path);
    return 2;
  }
  std::vector<std::string> expected;
  for (std::string line; std::getline(file, line);) expected.push_back(line);
  if (print_differences(found, expected) > 0) return 1;
  std::printf("%zu results, all as in %s\n", found.size(), path);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> lines = lines_of(hapticwall::determinism::compute_cases());
    if (argc == 2) return compare_with(argv[1], lines);
    for (const std::string& line : lines) std::printf("%s\n", line.c_str());
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "error: %s\n", problem.what());
    return 2;
  }
}
