// SHA-256 of a file while it is being written.
#pragma once

#include <sha2.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapticwall::file {

class Sha256 {
 public:
  Sha256() { SHA256Init(&context_); }
  void update(std::string_view bytes);
  // 64 hexadecimal digits. Call it once, at the end.
  [[nodiscard]] std::string finish();

 private:
  SHA2_CTX context_;
};

// SHA-256 of the first `bytes` of a file; nullopt if they cannot be read. Realtime-safe: no.
[[nodiscard]] std::optional<std::string> sha256_of(const std::string& path, std::uint64_t bytes);

}  // namespace hapticwall::file
