// SHA-256 of a file while it is being written.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // OpenSSL's

namespace hapticwall::file {

class Sha256 {
 public:
  Sha256();  // throws std::runtime_error if libcrypto has no SHA-256
  void update(std::string_view bytes);
  // 64 hexadecimal digits. Call it once, at the end.
  [[nodiscard]] std::string finish();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

// Of the first `bytes` of a file; nullopt if they cannot be read. Realtime-safe: no.
[[nodiscard]] std::optional<std::string> sha256_of(const std::string& path, std::uint64_t bytes);

}  // namespace hapticwall::file
