// A scene as Python holds it: a value with keys.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "app/file/scene/scene_file.h"

namespace hapticwall::python {

using SettingValue = std::variant<double, std::string>;  // text as --set takes it
using Settings = std::vector<std::pair<std::string, SettingValue>>;

// Its functions raise ValueError, OSError, and KeyError for an unknown key.
class SceneBox {
 public:
  SceneBox() = default;
  explicit SceneBox(file::LoadedScene loaded) : loaded_(std::move(loaded)) {}
  [[nodiscard]] static SceneBox load(const std::string& name_or_path);

  [[nodiscard]] const file::LoadedScene& loaded() const { return loaded_; }
  [[nodiscard]] std::string toml() const { return file::scene_to_toml(loaded_.scene); }

  // The keys of all numbers, with those that the scene omits.
  [[nodiscard]] std::vector<std::string> number_keys() const;
  // A number by its key: nothing if there is none of this name; in it nothing if it is omitted.
  [[nodiscard]] std::optional<std::optional<double>> number(const std::string& key) const;
  // Raises KeyError if no scene can have this key.
  void check_key(const std::string& key) const;
  // The scene with other values, which are checked together.
  [[nodiscard]] SceneBox with(const Settings& settings) const;
  // The scene under another algorithm, an index in algorithms(). Parameters keep their values.
  [[nodiscard]] SceneBox under(std::size_t algorithm) const;
  // The scene under another algorithm; parameters that `settings` omits have the defaults of the
  // algorithm.
  [[nodiscard]] SceneBox with_algorithm(std::size_t algorithm, const Settings& settings) const;

 private:
  file::LoadedScene loaded_;
};

// The scene of a study: refuses a session with changes and one that cannot be repeated.
[[nodiscard]] const Scene& scene_of_study(const SceneBox& scene);

}  // namespace hapticwall::python
