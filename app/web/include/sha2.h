// SHA-256 as libmd declares it, by Node.js: the window in a browser hashes nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

inline constexpr std::size_t SHA256_DIGEST_LENGTH = 32;
struct SHA2_CTX {
  std::string bytes;
};

inline void SHA256Init(SHA2_CTX* context) { context->bytes.clear(); }
inline void SHA256Update(SHA2_CTX* context, const std::uint8_t* bytes, std::size_t count) {
  context->bytes.append(reinterpret_cast<const char*>(bytes), count);
}
// Throws in JavaScript where there is no Node.js.
void SHA256Final(std::uint8_t* digest, SHA2_CTX* context);
