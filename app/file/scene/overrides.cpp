// --set KEY=VALUE replaces or adds one key of a parsed scene.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "app/file/scene/scene_reader.h"
#include "app/file/scene/table_reader.h"
#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr std::string_view kKeyCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
constexpr std::size_t kMaxParts = 8;
constexpr std::size_t kMaxOverrideBytes = std::size_t{1} << 20U;

struct KeyPart {
  std::string name;
  std::optional<std::size_t> index;  // 0 in wall[0]
};

[[noreturn]] void fail(const std::string& label, std::string_view message) {
  throw ReadFailure(fmt::format("{}: {}", label, message));
}

KeyPart key_part(std::string_view text, const std::string& label) {
  KeyPart part;
  const std::size_t bracket = text.find('[');
  part.name = std::string(text.substr(0, bracket));
  bool well_formed =
      !part.name.empty() && part.name.find_first_not_of(kKeyCharacters) == std::string::npos;
  if (bracket != std::string_view::npos) {
    part.index = parsed<std::size_t>(text.substr(bracket + 1, text.size() - bracket - 2));
    well_formed = well_formed && part.index && text.ends_with(']');
  }
  if (!well_formed) {
    fail(label, "the key is not dotted words like hand.mass_kg or wall[0].stiffness_n_per_m");
  }
  return part;
}

std::vector<KeyPart> key_parts(std::string_view key, const std::string& label) {
  std::vector<KeyPart> parts;
  while (parts.size() < kMaxParts) {
    const std::size_t point = key.find('.');
    parts.push_back(key_part(trimmed(key.substr(0, point)), label));
    if (point == std::string_view::npos) return parts;
    key.remove_prefix(point + 1);
  }
  fail(label, "the key has too many parts");
}

// The wall that `part` names.
toml::table& named_wall(toml::table& root, const KeyPart& part, const std::string& label) {
  toml::array* walls = root["wall"].as_array();
  if (walls == nullptr || walls->empty()) fail(label, "the scene has no wall");
  const std::size_t count = walls->size();
  if (!part.index && count > 1) {
    fail(label,
         fmt::format("the scene has {} walls; say which: wall[0] ... wall[{}]", count, count - 1));
  }
  const std::size_t index = part.index.value_or(0);
  if (index >= count) {
    fail(label, fmt::format("wall[{}] does not exist; walls of the scene: {}, counted from wall[0]",
                            index, count));
  }
  toml::table* wall = walls->get(index)->as_table();
  if (wall == nullptr) fail(label, "wall is not an array of tables");
  return *wall;
}

bool is_bare_word(std::string_view value) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  if (value.empty() || !is_letter(value.front())) return false;
  return value.find_first_not_of(std::string(kKeyCharacters) + " .") == std::string_view::npos;
}

// The number of "np.float64(300.0)", as NumPy 2 writes a scalar; any other text as it is.
std::string_view without_numpy(std::string_view value) {
  const std::size_t open = value.find('(');
  if (!value.starts_with("np.") || !value.ends_with(')') || open > value.size()) return value;
  const std::string_view number = value.substr(open + 1, value.size() - open - 2);
  return parsed<double>(number) ? number : value;
}

// Parses "key = value" with the position of every value at `label`.
toml::table parse_assignment(const std::string& key, std::string_view value,
                             const std::string& label) {
  try {
    return parse_toml(fmt::format("{} = {}", key, value), label);
  } catch (const ReadFailure&) {
    const bool names_file =
        key == "device" || key == "hand" || key == "file" || key.ends_with("path_file");
    const bool is_file = names_file && value.find('\'') == std::string_view::npos;
    if (is_bare_word(value) || is_file) {
      return parse_toml(fmt::format("{} = '{}'", key, value), label);
    }
    fail(label,
         "the value is not TOML (a number, true, false, a word, \"text\", [[0, 0.03], ...])");
  }
}

// Another environment takes the place of the walls.
void drop_walls(toml::table& root) {
  const auto name = root["environment"]["name"].value<std::string_view>();
  if (name && *name != "walls") root.erase("wall");
}

// A path of points takes the place of a file, and a file that of points.
void drop_other_path(toml::table& hand, std::string_view key) {
  if (key != "path" && key != "path_file") return;
  for (const std::string_view other : {"path", "path_file", "path_sha256"}) hand.erase(other);
}

}  // namespace

void apply_override(toml::table& root, const std::string& override_text) {
  const std::string label = "--set " + shown(override_text);
  const std::size_t equals = override_text.find('=');
  if (equals == std::string::npos) fail(label, "there is no '=': it takes KEY=VALUE");
  const std::string_view value =
      without_numpy(trimmed(std::string_view(override_text).substr(equals + 1)));
  const bool one_line = std::none_of(value.begin(), value.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20U && c != '\t';
  });
  if (value.empty()) fail(label, "there is no value: it takes KEY=VALUE");
  if (!one_line || value.size() > kMaxOverrideBytes)
    fail(label, "the value is not one line of TOML");
  std::vector<KeyPart> parts = key_parts(std::string_view(override_text).substr(0, equals), label);

  // A word alone is the name: algorithm=none.
  const bool is_named = parts.front().name == "algorithm" || parts.front().name == "estimator" ||
                        parts.front().name == "environment";
  if (is_named && parts.size() == 1 && !value.starts_with('{')) parts.push_back({"name", {}});
  toml::table* table = &root;
  std::size_t next = 0;
  if (parts.front().name == "wall" && parts.size() > 1) {
    table = &named_wall(root, parts.front(), label);
    next = 1;
  }
  for (std::size_t i = next; i < parts.size(); ++i) {
    if (parts[i].index)
      fail(label, "only wall.KEY takes an index, as in wall[0].damping_n_s_per_m");
  }
  for (; next + 1 < parts.size(); ++next) {
    toml::node* inner = table->get(parts[next].name);
    if (inner == nullptr) break;
    if (!inner->is_table()) fail(label, fmt::format("{} is not a table", parts[next].name));
    table = inner->as_table();
  }
  std::string key = parts[next].name;
  for (std::size_t i = next + 1; i < parts.size(); ++i) key += "." + parts[i].name;
  toml::table assignment = parse_assignment(key, value, label);
  if (parts.front().name == "hand") drop_other_path(*table, key);
  table->insert_or_assign(parts[next].name, std::move(*assignment.get(parts[next].name)));
  if (parts.front().name == "environment") drop_walls(root);
}

}  // namespace hapticwall::file
