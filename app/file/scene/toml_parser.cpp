// Parses untrusted TOML. Refuses texts with which toml++ would exhaust the stack.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "app/file/scene/scene_file.h"
#include "app/file/scene/table_reader.h"
#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

// toml++ limits nested values but not dotted keys. A key of 1e5 parts makes as many nested tables,
// whose destruction overflows the stack.
constexpr std::size_t kMaxKeyParts = 32;
constexpr std::size_t kMaxDescriptionBytes = 200;

// The position after the string that begins at `begin`; the end of the text if it is not closed.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const bool escapes = quote == '"';
  const std::string triple(3, quote);
  const bool several_lines = text.substr(begin).starts_with(triple);
  std::size_t i = begin + (several_lines ? 3 : 1);
  for (; i < text.size(); ++i) {
    if (escapes && text[i] == '\\') {
      ++i;
    } else if (several_lines) {
      if (text.substr(i).starts_with(triple)) return i + 3;
    } else if (text[i] == quote || text[i] == '\n') {
      return i + 1;
    }
  }
  return text.size();
}

// Counts that bound the work of toml++ on a text.
struct Load {
  std::size_t key_parts = 0;  // of the longest key; decimal points of numbers count as one part
  std::size_t changes = 0;    // changes of a recording; inline tables count, as they may be changes
};

// True if a line "[[recording.change]]" begins here.
bool begins_change(std::string_view text) {
  constexpr std::size_t kMaxHeaderBytes = 64;
  if (!text.starts_with("[[") || text.starts_with("[[[")) return false;
  text = text.substr(0, kMaxHeaderBytes);
  std::string name;
  for (const char c : text.substr(0, text.find(']'))) {
    if (std::string_view(" \t\"'").find(c) == std::string_view::npos) name += c;
  }
  return name == "[[recording.change";
}

Load load_of(std::string_view text) {
  Load load;
  std::size_t points = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (c == '{' || begins_change(text.substr(i))) ++load.changes;
    if (c == '.') {
      load.key_parts = std::max(load.key_parts, ++points);
    } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
      points = 0;
    }
    ++i;
  }
  return load;
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& origin, std::string_view kind) {
  const Load load = load_of(text);
  if (load.key_parts > kMaxKeyParts) {
    throw ReadFailure(
        fmt::format("{}: not a {}: keys of more than {} parts", shown(origin), kind, kMaxKeyParts));
  }
  if (load.changes > kMaxChanges) {
    throw ReadFailure(fmt::format("{}: not a {}: {}", shown(origin), kind, kTooManyChanges));
  }
  try {
    return toml::parse(text, std::string_view(origin));
  } catch (const toml::parse_error& error) {
    throw ReadFailure(fmt::format("{}:{}: not valid TOML: {}", shown(origin),
                                  error.source().begin.line,
                                  shown(error.description(), kMaxDescriptionBytes)));
  }
}

}  // namespace hapticwall::file
