// The commonest error: what somebody typed or wrote into a file.
#pragma once

#include <string>
#include <utility>

#include "core/result.h"

namespace hapticwall {

[[nodiscard]] inline Error usage_error(std::string message) {
  return {ErrorKind::kUsage, std::move(message)};
}

}  // namespace hapticwall
