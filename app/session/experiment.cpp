#include "app/session/experiment.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "app/session/scene_change.h"
#include "hapticwall_version.h"

namespace hapticwall::session {
namespace {

constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

Failure check_name(std::string_view option, const std::string& name) {
  const bool well_formed = !name.empty() && name.size() <= kMaxNameBytes && name.front() != '-' &&
                           name.find_first_not_of(kNameCharacters) == std::string::npos;
  if (well_formed) return std::nullopt;
  return usage_error(fmt::format("{} {}: it takes letters, digits, '-' and '_', at most {}", option,
                                 file::in_quotes(name), kMaxNameBytes));
}

std::string sha256_of_text(std::string_view text) {
  file::Sha256 digest;
  digest.update(text);
  return digest.finish();
}

// Why the session that runs `base` cannot run `slot`; empty if it can.
std::string obstacle(const Scene& base, const Scene& slot, bool on_device) {
  if (const auto problem = needs_new_session(base, slot))
    return fmt::format("{}: {}", problem->key, problem->message);
  if (slot.duration_s != base.duration_s || slot.name != base.name ||
      slot.description != base.description)
    return "name, description and duration_s are those of the session";
  if (!on_device) return "";
  for (std::size_t i = 0; i < base.axes.size(); ++i) {
    if (slot.axes[i].hand != base.axes[i].hand) return "a device has no simulated hand";
  }
  return slot.simulator == base.simulator ? "" : "a device has no simulator";
}

// Loads the slots of a list.
class SlotLoader {
 public:
  SlotLoader(const SceneWith& scene_with, Scene base, bool on_device)
      : scene_with_(scene_with), base_(std::move(base)), on_device_(on_device) {}

  Result<std::vector<SlotScenes>> load(const file::TrialList& list, const std::string& path) const {
    std::vector<SlotScenes> scenes;
    for (const file::TrialSpec& trial : list.trials) {
      scenes.push_back({base_, base_});
      for (std::size_t i = 0; i < trial.slots.size(); ++i) {
        Result<Scene> scene = slot_scene(trial.slots[i]);
        if (!scene) {
          return usage_error(fmt::format("{}:{}: {}: {}", file::shown(path), trial.line,
                                         i == 0 ? "a" : "b", scene.error().message));
        }
        scenes.back()[i] = std::move(*scene);
      }
    }
    return scenes;
  }

 private:
  [[nodiscard]] Result<Scene> slot_scene(const std::string& slot) const {
    Result<Scene> scene = scene_with_(file::slot_overrides(slot));
    if (!scene) return scene;
    const std::string why = obstacle(base_, *scene, on_device_);
    return why.empty() ? scene : usage_error(fmt::format("{}: {}", file::shown(slot), why));
  }

  const SceneWith& scene_with_;
  Scene base_;
  bool on_device_;
};

// Each participant has an order of their own, the same after a restart.
file::Answer identity_of(const ExperimentChoice& choice, const file::TrialList& list,
                         const Scene& base) {
  constexpr int kHexadecimal = 16;
  constexpr std::size_t kSeedDigits = 13;
  static_assert(std::uint64_t{1} << (4 * kSeedDigits) <= file::kMaxSeed);
  file::Answer identity;
  identity.participant = choice.participant;
  identity.session = choice.session;
  identity.program = fmt::format("{} ({})", kVersion, kBuild);
  identity.scene_sha256 = sha256_of_text(file::scene_to_toml(base));
  identity.list_sha256 = list.sha256;
  const std::string mixed =
      sha256_of_text(fmt::format("{}\n{}\n{}", list.sha256, choice.participant, choice.session));
  identity.seed =
      *file::parsed<std::uint64_t>(std::string_view(mixed).substr(0, kSeedDigits), kHexadecimal);
  return identity;
}

std::string answers_path(const ExperimentChoice& choice, const std::string& name) {
  if (!choice.answers.empty()) return choice.answers;
  return fmt::format("{}-{}-{}.csv", name, choice.participant, choice.session);
}

// The answers are those of the first trials.
Failure check_order(const Experiment& experiment) {
  std::size_t answered = 0;
  const auto found = experiment.answers.found();
  for (const file::TrialSpec& trial : experiment.trials) {
    if (answered == found.size()) return std::nullopt;
    if (trial.kind == file::TrialKind::kBreak) continue;
    if (found[answered++].trial == trial.number) continue;
    return usage_error(fmt::format("{}: its answers do not follow the trial list",
                                   file::shown(experiment.answers.path())));
  }
  if (answered == found.size()) return std::nullopt;
  return usage_error(fmt::format("{}: it has more answers than the list has trials",
                                 file::shown(experiment.answers.path())));
}

}  // namespace

Result<std::shared_ptr<Experiment>> open_experiment(const ExperimentChoice& choice,
                                                    const SceneWith& scene_with) {
  if (const Failure failure = check_name("--participant", choice.participant)) return *failure;
  if (const Failure failure = check_name("--session", choice.session)) return *failure;
  Result<file::TrialList> list = file::read_trial_list(choice.list);
  if (!list) return list.error();
  const Result<Scene> base = scene_with({});
  if (!base) return base.error();
  auto scenes = SlotLoader(scene_with, *base, choice.on_device).load(*list, choice.list);
  if (!scenes) return scenes.error();
  const std::string name = std::filesystem::path(choice.list).stem().string();
  auto answers =
      file::AnswersFile::open(answers_path(choice, name), identity_of(choice, *list, *base));
  if (!answers) return answers.error();
  auto experiment = std::make_shared<Experiment>(
      Experiment{name, std::move(list->trials), std::move(*scenes), std::move(*answers)});
  if (const Failure failure = check_order(*experiment)) return *failure;
  return experiment;
}

}  // namespace hapticwall::session
