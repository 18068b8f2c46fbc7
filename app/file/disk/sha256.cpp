#include "app/file/disk/sha256.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace hapticwall::file {
namespace {

constexpr std::size_t kHashedBytes = std::size_t{1} << 16U;

}  // namespace

void Sha256::update(std::string_view bytes) {
  SHA256Update(&context_, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string Sha256::finish() {
  std::array<std::uint8_t, SHA256_DIGEST_LENGTH> digest{};
  SHA256Final(digest.data(), &context_);
  std::string text;
  for (const std::uint8_t byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

std::optional<std::string> sha256_of(const std::string& path, std::uint64_t bytes) {
  std::ifstream in(path, std::ios::binary);
  std::string piece(kHashedBytes, '\0');
  Sha256 digest;
  while (bytes > 0) {
    const std::uint64_t wanted = std::min<std::uint64_t>(bytes, piece.size());
    if (!in.read(piece.data(), static_cast<std::streamsize>(wanted))) return std::nullopt;
    digest.update(std::string_view(piece).substr(0, wanted));
    bytes -= wanted;
  }
  return digest.finish();
}

}  // namespace hapticwall::file
