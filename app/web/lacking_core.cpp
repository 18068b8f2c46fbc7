// Stands for parts of core and app/file that a browser lacks: threads, and a library's SHA-256.
#include <emscripten.h>
#include <sha2.h>

#include "core/run/workers.h"

// clang-format off
EM_JS(void, hash_by_node, (std::uint8_t* digest, const char* bytes, std::size_t count), {
  const input = HEAPU8.subarray(bytes, bytes + count);
  HEAPU8.set(require('crypto').createHash('sha256').update(input).digest(), digest);
})
// clang-format on

void SHA256Final(std::uint8_t* digest, SHA2_CTX* context) {
  hash_by_node(digest, context->bytes.data(), context->bytes.size());
}

namespace hapticwall {

std::size_t worker_count(int /*threads*/) { return 1; }

void share_out(std::size_t items, std::size_t /*workers*/,
               const std::function<void(std::size_t item, std::size_t worker)>& work) {
  for (std::size_t item = 0; item < items; ++item) work(item, 0);
}

}  // namespace hapticwall
