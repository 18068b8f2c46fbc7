// A program that is killed at any moment loses no finished trial and repeats none.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "app/compare/blind_trials.h"
#include "app/file/scene/scene_file.h"
#include "app/session/experiment.h"
#include "tests/temporary_folder.h"

namespace hapticwall::compare {
namespace {

constexpr std::uint64_t kTrials = 200;
constexpr int kKills = 20;
constexpr std::size_t kMostInALife = 9;  // so that the list outlasts the kills on a fast disk

class KilledExperiment : public hapticwall::test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    std::string list = "trial,kind,a,b\n";
    for (std::uint64_t i = 1; i <= kTrials; ++i) {
      list += std::to_string(i) + ",test,,wall.stiffness_n_per_m=" + std::to_string(1000 + i % 7) +
              "\n";
      if (i % 30 == 0) list += std::to_string(1000 + i) + ",break,,\n";
    }
    put("list.csv", list);
  }

  [[nodiscard]] Result<std::shared_ptr<session::Experiment>> open() const {
    return session::open_experiment({path("list.csv"), "P1", "1", path("out.csv")},
                                    [](std::span<const std::string> overrides) -> Result<Scene> {
                                      return file::load_scene("press", overrides)->scene;
                                    });
  }

  // Answers up to `most` trials as fast as it can, and tells each once it is stored. Ends after the
  // last trial of the list alone.
  void answer_trials(int told, std::size_t most) const {
    auto experiment = open();
    if (!experiment) _exit(1);
    auto trials =
        *BlindTrials::create({(*experiment)->answers.identity().seed, (*experiment)->trials});
    for (std::size_t i = 0; i < (*experiment)->answers.found().size(); ++i) trials.take();
    for (std::size_t answered = 0; !trials.finished(); ++answered) {
      if (answered == most) pause();
      trials.go_on();
      static_cast<void>(trials.present(Presentation::kFirst, 0.0));
      static_cast<void>(trials.present(Presentation::kSecond, 1.0));
      const file::Answer answer = *trials.answer(Presentation::kFirst, 2.0);
      if ((*experiment)->answers.append(answer)) _exit(2);
      if (write(told, &answer.trial, sizeof answer.trial) < 0) _exit(3);
      trials.take();
    }
    _exit(0);
  }

  // Starts the program, and kills it some time after this many trials. Returns its wait status.
  int live(std::size_t trials, useconds_t more_us) {
    int ends[2] = {};
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) answer_trials(ends[1], trials < kTrials ? kMostInALife : kTrials);
    close(ends[1]);
    std::uint64_t trial = 0;
    const auto hears = [&] { return read(ends[0], &trial, sizeof trial) == sizeof trial; };
    for (std::size_t i = 0; i < trials && hears(); ++i) told_.push_back(trial);
    usleep(more_us);
    if (trials < kTrials) kill(child, SIGKILL);
    while (hears()) told_.push_back(trial);
    close(ends[0]);
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return status;
  }

  [[nodiscard]] std::vector<std::uint64_t> stored() const {
    std::vector<std::uint64_t> trials;
    const auto experiment = open();
    EXPECT_TRUE(experiment) << experiment.error().message;
    if (!experiment) return trials;
    for (const file::Answer& answer : (*experiment)->answers.found())
      trials.push_back(answer.trial);
    return trials;
  }

  std::vector<std::uint64_t> told_;  // trials reported by all programs, in order
};

TEST_F(KilledExperiment, KeepsEveryFinishedTrialOnce) {
  std::mt19937 chance(20);
  for (int i = 0; i < kKills; ++i) {
    const int status = live(chance() % 9, static_cast<useconds_t>(chance() % 1000));
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << i << ": " << status;
    const std::vector<std::uint64_t> kept = stored();
    for (const std::uint64_t trial : told_)
      ASSERT_EQ(std::count(kept.begin(), kept.end(), trial), 1) << "trial " << trial;
    // A loss of power may tear the last line, too.
    const std::string line = file::answer_line({});
    std::ofstream(path("out.csv"), std::ios::app) << line.substr(0, chance() % line.size());
  }
  const int status = live(kTrials, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  std::vector<std::uint64_t> all(kTrials);
  for (std::uint64_t i = 0; i < kTrials; ++i) all[i] = i + 1;
  EXPECT_EQ(stored(), all);
  EXPECT_GT(told_.size(), kTrials / 2) << "the kills came between trials";
}

}  // namespace
}  // namespace hapticwall::compare
