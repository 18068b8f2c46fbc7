#include "app/session/experiment.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
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

Result<std::vector<SlotScenes>> load_slots(const SlotLoader& loader, const file::TrialList& list,
                                           const std::string& path) {
  std::vector<SlotScenes> scenes;
  for (const file::TrialSpec& trial : list.trials) {
    Result<SlotScenes> both = loader.load(trial);
    if (!both) {
      return usage_error(
          fmt::format("{}:{}: {}", file::shown(path), trial.line, both.error().message));
    }
    scenes.push_back(std::move(*both));
  }
  return scenes;
}

// Each participant has an order of their own, the same after a restart.
file::Answer identity_of(const ExperimentChoice& choice, const std::string& list_sha256,
                         const Scene& base) {
  constexpr int kHexadecimal = 16;
  constexpr std::size_t kSeedDigits = 13;
  static_assert(std::uint64_t{1} << (4 * kSeedDigits) <= file::kMaxSeed);
  file::Answer identity;
  identity.participant = choice.participant;
  identity.session = choice.session;
  identity.program = fmt::format("{} ({})", kVersion, kBuild);
  identity.scene_sha256 = sha256_of_text(file::scene_to_toml(base));
  identity.list_sha256 = list_sha256;
  const std::string mixed =
      sha256_of_text(fmt::format("{}\n{}\n{}", list_sha256, choice.participant, choice.session));
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

std::string stem_of(const std::string& path) { return std::filesystem::path(path).stem().string(); }

Result<std::shared_ptr<Experiment>> open_listed(const ExperimentChoice& choice,
                                                const SceneWith& scene_with) {
  Result<file::TrialList> list = file::read_trial_list(choice.list);
  if (!list) return list.error();
  const Result<Scene> base = scene_with({});
  if (!base) return base.error();
  auto scenes = load_slots(SlotLoader(scene_with, *base, choice.on_device), *list, choice.list);
  if (!scenes) return scenes.error();
  const std::string name = stem_of(choice.list);
  const file::AnswerColumns columns{true, keys_of(list->trials), list->extras};
  auto answers = file::AnswersFile::open(answers_path(choice, name),
                                         identity_of(choice, list->sha256, *base), columns);
  if (!answers) return answers.error();
  auto experiment = std::make_shared<Experiment>(
      Experiment{name, std::move(list->trials), std::move(*scenes), std::move(*answers), nullptr});
  if (const Failure failure = check_order(*experiment)) return *failure;
  return experiment;
}

// In the place of the hash of a list.
constexpr std::string_view kNoList = "trials from a pipe";

Result<std::shared_ptr<Experiment>> open_piped(const ExperimentChoice& choice,
                                               const SceneWith& scene_with,
                                               std::unique_ptr<LinePipe> pipe) {
  if (choice.answers.empty()) return usage_error("--trials -: it needs --answers FILE.csv");
  const Result<Scene> base = scene_with({});
  if (!base) return base.error();
  auto answers = file::AnswersFile::open(
      choice.answers, identity_of(choice, sha256_of_text(kNoList), *base), std::nullopt);
  if (!answers) return answers.error();
  if (!pipe) {
    auto opened = LinePipe::open(STDIN_FILENO, STDOUT_FILENO, file::kMaxMessageBytes);
    if (!opened) return opened.error();
    pipe = std::move(*opened);
  }
  auto feed =
      std::make_unique<TrialFeed>(std::move(pipe), SlotLoader(scene_with, *base, choice.on_device));
  auto experiment = std::make_shared<Experiment>(
      Experiment{stem_of(choice.answers), {}, {}, std::move(*answers), std::move(feed)});
  experiment->feed->begin(*experiment);
  return experiment;
}

}  // namespace

std::vector<std::string> values_at(const Experiment& experiment, std::size_t place) {
  const auto& columns = experiment.answers.columns();
  if (!columns) return {};
  return values_of(columns->keys, experiment.trials[place], experiment.scenes[place]);
}

Result<std::shared_ptr<Experiment>> open_experiment(const ExperimentChoice& choice,
                                                    const SceneWith& scene_with,
                                                    std::unique_ptr<LinePipe> pipe) {
  if (const Failure failure = check_name("--participant", choice.participant)) return *failure;
  if (const Failure failure = check_name("--session", choice.session)) return *failure;
  return choice.list == kPiped ? open_piped(choice, scene_with, std::move(pipe))
                               : open_listed(choice, scene_with);
}

}  // namespace hapticwall::session
