// The tables [in] and [out] of a device file: the raw reports of a device that does not speak the
// protocol (docs/dialects.md). Throws ReadFailure, as the readers of this folder.
#pragma once

#include <optional>
#include <string>

#include "app/file/scene/table_reader.h"
#include "app/file/scene/toml_text.h"
#include "core/dialect.h"

namespace hapticwall::file {

// Reads the tables of `root`; nullopt without them. `has_y`: the file describes a second axis.
// Realtime-safe: no.
[[nodiscard]] std::optional<Dialect> read_dialect(TableReader& root, const std::string& origin,
                                                  bool has_y);

// The tables that read_dialect() reads back the same. Realtime-safe: no.
void write_dialect(TomlText& out, const Dialect& dialect);

}  // namespace hapticwall::file
