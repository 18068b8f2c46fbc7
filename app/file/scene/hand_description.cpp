#include "app/file/scene/hand_description.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/file/disk/small_file.h"
#include "app/file/scene/table_reader.h"
#include "app/file/text/text.h"
#include "embedded_hands.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxHandDescriptionBytes = std::size_t{1} << 16U;
constexpr std::size_t kMaxHandNameBytes = 100;
constexpr std::size_t kMaxHandSourceBytes = 1000;

std::string required_line(TableReader& reader, std::string_view key, std::size_t longest,
                          std::string_view wanted) {
  std::string text = reader.line(key, longest);
  if (text.empty()) reader.fail_missing(key, wanted);
  return text;
}

HandSettings read_numbers_of(const toml::table& table, const std::string& origin) {
  TableReader reader(table, "hand.", origin);
  HandSettings hand;
  reader.numbers(hand);
  if (!table.contains("stiffness_n_per_m"))
    reader.fail_missing("stiffness_n_per_m", number_in("N/m"));
  reader.finish();
  return hand;
}

// The ranges and contradictions are those of a scene.
void check_described_hand(const HandSettings& hand, const toml::table& root,
                          const std::string& origin) {
  Scene scene;
  scene.x().hand = hand;
  scene.x().hand->path = {{0.0, scene.x().device.start_m}};
  const auto problem = validate(scene);
  if (!problem) return;
  const toml::node_view<const toml::node> node = root.at_path(problem->key);
  const std::string place = place_of(node ? *node.node() : root, origin);
  throw ReadFailure(place + ": " + problem->key + ": " + problem->message);
}

HandDescription read_hand_description(const toml::table& root, const std::string& origin) {
  TableReader reader(root, "", origin);
  HandDescription hand;
  hand.name = required_line(reader, "name", kMaxHandNameBytes, "a name for people");
  hand.source = required_line(reader, "source", kMaxHandSourceBytes, "where the numbers come from");
  const toml::table* table = reader.table("hand");
  if (table == nullptr) reader.fail_missing("hand", "a table [hand]");
  reader.finish();
  hand.hand = read_numbers_of(*table, origin);
  check_described_hand(hand.hand, root, origin);
  return hand;
}

}  // namespace

Result<HandDescription> parse_hand_description(std::string_view toml_text,
                                               const std::string& origin) {
  try {
    return read_hand_description(parse_toml(toml_text, origin, "description of a hand"), origin);
  } catch (const ReadFailure& failure) {
    return usage_error(failure.what());
  }
}

Result<HandDescription> load_hand_description(const std::string& name_or_path) {
  const std::vector<BuiltinHand>& builtin = builtin_hands();
  const std::vector<std::string_view> names = names_of(builtin, &BuiltinHand::name);
  const Result<std::optional<std::size_t>> index = find_builtin(name_or_path, "hand", names);
  if (!index) return index.error();
  if (*index) {
    const BuiltinHand& hand = builtin[**index];
    return parse_hand_description(hand.toml_text, hand.name + " (built in)");
  }
  const Result<std::string> text = read_small_file(name_or_path, "description of a hand",
                                                   kMaxHandDescriptionBytes, problem_of_named);
  if (!text) return text.error();
  return parse_hand_description(*text, name_or_path);
}

const std::vector<BuiltinHand>& builtin_hands() {
  static const std::vector<BuiltinHand> kHands = [] {
    std::vector<BuiltinHand> hands;
    for (const EmbeddedFile& file : embedded_hands()) {
      hands.push_back({std::filesystem::path(file.name).stem().string(), file.bytes});
    }
    std::ranges::sort(hands, {}, &BuiltinHand::name);
    return hands;
  }();
  return kHands;
}

Scene with_hand(Scene scene, const HandSettings& numbers) {
  for (AxisSettings& axis : scene.axes) {
    if (!axis.hand) continue;
    HandSettings hand = numbers;
    hand.path = std::move(axis.hand->path);
    hand.follows_mouse = axis.hand->follows_mouse;
    axis.hand = std::move(hand);
  }
  return scene;
}

}  // namespace hapticwall::file
