#include "app/file/scene/seal.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/file/disk/sha256.h"

namespace hapticwall::file {
namespace {

constexpr std::string_view kHead = "[recording]\n";
constexpr std::string_view kSeal = "\nsidecar_sha256";

// The line of a seal of all text, given in two pieces.
std::string seal_of(std::string_view before, std::string_view behind) {
  Sha256 digest;
  digest.update(before);
  digest.update(behind);
  return fmt::format("{} = \"{}\"\n", kSeal.substr(1), digest.finish());
}

}  // namespace

std::string sealed(std::string text) {
  const std::string seal = seal_of(text, "");
  return text.insert(text.find(kHead) + kHead.size(), seal);
}

bool is_broken_seal(std::string_view text) {
  const std::size_t found = text.find(kSeal);
  if (found == std::string_view::npos) return false;
  const std::size_t begin = found + 1;
  const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
  return text.substr(begin, end - begin) != seal_of(text.substr(0, begin), text.substr(end));
}

}  // namespace hapticwall::file
