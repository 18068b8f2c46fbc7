// Reads small text files, and refuses large ones. Finds built-in ones by name.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace hapticwall::file {

// "PATH: cannot be read: REASON" for an errno.
[[nodiscard]] Error cannot_be_read(const std::string& path, int code);

// Why the open file may not be read, or "".
using ProblemOfFile = std::function<std::string(int descriptor)>;

// The whole file. `kind` names the expected content in messages ("scene"). Refuses an empty file.
// With `problem_of`, refuses a file with a problem, and what is no regular file, without opening
// that: a pipe would wait for its writer.
[[nodiscard]] Result<std::string> read_small_file(const std::string& path, std::string_view kind,
                                                  std::size_t max_bytes,
                                                  const ProblemOfFile& problem_of = {});

// The problem of a file that a scene names: one of the kernel, in /proc or /sys.
[[nodiscard]] std::string problem_of_named(int descriptor);

// The index of a built-in scene or device; nullopt for the path of a file. Fails if `name_or_path`
// is neither. `kind` names the list in the message ("scene").
[[nodiscard]] Result<std::optional<std::size_t>> find_builtin(
    const std::string& name_or_path, std::string_view kind,
    std::span<const std::string_view> builtin_names);

}  // namespace hapticwall::file
