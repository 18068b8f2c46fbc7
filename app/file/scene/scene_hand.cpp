// A scene's hand from a description: `hand = "NAME"`, or [hand] with file = "NAME".
#include <filesystem>

#include "app/file/scene/hand_description.h"
#include "app/file/scene/scene_reader.h"
#include "app/file/scene/table_reader.h"
#include "core/scene_keys.h"

namespace hapticwall::file {
namespace {

constexpr std::string_view kHandFileEnding = ".toml";

// A built-in name, or a file: of the scene beside it, and of --set in the current folder. A word
// that is neither stays as it is: load_hand_description() then names the known hands.
std::string file_of_hand(const toml::node& node, const std::string& name,
                         const std::string& origin) {
  for (const BuiltinHand& hand : builtin_hands()) {
    if (hand.name == name) return name;
  }
  const auto& source = node.source().path;
  const bool of_scene = source && *source == origin;
  std::string file = name.ends_with(kHandFileEnding) ? name : name + std::string(kHandFileEnding);
  file = (std::filesystem::path(of_scene ? origin : "").parent_path() / file).string();
  std::error_code ignored;
  const bool is_word = !name.empty() && name.find_first_of("/.") == std::string::npos;
  return is_word && !std::filesystem::exists(file, ignored) ? name : file;
}

// Adds the numbers of the description. A number that `table` already has is kept where it `wins`.
void add_hand_numbers(const HandSettings& hand, bool wins, toml::table& table) {
  for (const NumberKey<HandSettings>& key : number_keys<HandSettings>()) {
    if (wins && table.contains(key.key)) continue;
    table.erase(key.key);
    if (const auto value = key.get(hand)) table.insert_or_assign(key.key, *value);
  }
}

// `parent.key` is the hand of one axis, and `before` the table that its name replaces.
std::string resolve_axis(toml::table& parent, std::string_view key, const toml::table* before,
                         toml::table& root, const std::string& origin) {
  const toml::node* node = parent.get(key);
  if (node == nullptr) return "";
  const std::string shown_key = &parent == &root ? "hand" : "hand.y";
  const bool whole = node->is_string();
  if (!whole) {
    if (!node->is_table() || !node->as_table()->contains("file")) return "";
    node = node->as_table()->get("file");
    if (!node->is_string()) {
      throw ReadFailure(place_of(*node, origin) + ": " + shown_key +
                        ".file: not the name of a hand");
    }
  }
  const std::string file = file_of_hand(*node, node->value_or(std::string()), origin);
  const Result<HandDescription> hand = load_hand_description(file);
  if (!hand) {
    throw ReadFailure(place_of(*node, origin) + ": " + shown_key + ": " + hand.error().message);
  }
  toml::table table;
  if (!whole) table = *parent.get(key)->as_table();
  if (whole && before != nullptr) table = *before;
  table.erase("file");
  add_hand_numbers(hand->hand, !whole, table);
  parent.insert_or_assign(key, std::move(table));
  const std::string own = root["description"].value_or(std::string());
  root.insert_or_assign("description", own + (own.empty() ? "" : "; ") + shown_key + " " +
                                           hand->name + ": " + hand->source);
  return file;
}

}  // namespace

std::vector<std::string> resolve_hands(toml::table& root, const toml::table& before,
                                       const std::string& origin) {
  std::vector<std::string> files{resolve_axis(root, "hand", &before, root, origin)};
  toml::table* hands = root["hand"].as_table();
  if (hands == nullptr) return files;
  files.push_back(resolve_axis(*hands, "y", before["y"].as_table(), root, origin));
  return files;
}

}  // namespace hapticwall::file
