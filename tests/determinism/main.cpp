// hapticwall_determinism [HASHES]: the SHA-256 of the result of every case, one line each. With a
// file of such lines it prints what differs; a line of the file that is not found again is
// status 1. A case that the file does not know (of a new algorithm) is printed as `new` and is no
// difference.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <set>
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

// A line is the digest, two spaces and the case.
std::string case_of(const std::string& line) { return line.substr(line.find(' ')); }

// How many expected lines were not found.
std::size_t print_differences(std::vector<std::string> found, std::vector<std::string> expected) {
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  std::vector<std::string> missing;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(),
                      std::back_inserter(missing));
  std::vector<std::string> other;
  std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                      std::back_inserter(other));
  std::set<std::string> known;
  for (const std::string& line : expected) known.insert(case_of(line));
  for (const std::string& line : missing) std::printf("expected %s\n", line.c_str());
  for (const std::string& line : other) {
    std::printf("%s %s\n", known.contains(case_of(line)) ? "found   " : "new     ", line.c_str());
  }
  return missing.size();
}

int compare_with(const char* path, const std::vector<std::string>& found) {
  std::ifstream file(path);
  if (!file) {
    std::fprintf(stderr, "error: %s: cannot be read\n", path);
    return 2;
  }
  std::vector<std::string> expected;
  for (std::string line; std::getline(file, line);) expected.push_back(line);
  if (expected.empty() || print_differences(found, expected) > 0) return 1;
  std::printf("%zu results as in %s\n", expected.size(), path);
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
