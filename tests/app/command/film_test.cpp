// `run --frames`: the pictures of a film, or nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

namespace fs = std::filesystem;

class FilmTest : public ProgramTest {
 protected:
  // Names in the folder `name`, sorted.
  [[nodiscard]] std::vector<std::string> pictures(const std::string& name) const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(path(name)))
      names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  }
  [[nodiscard]] Answer film(const std::string& name, std::vector<std::string> more) const {
    std::vector<std::string> arguments{
        "run",     "press",   "--algorithm",   "none", "--duration", "1.05", "--frames-size",
        "320x240", "--quiet", "--frames-from", "1",    "--frames",   name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hapticwall(arguments);
  }
};

TEST_F(FilmTest, HasOnePngForEachPictureOfAScreen) {
  const Answer answer = film("a", {});
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.err, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("a"));
  EXPECT_THAT(pictures("a"), ElementsAre("00000.png", "00001.png", "00002.png"));
  for (const std::string& name : pictures("a"))
    EXPECT_THAT(content("a/" + name), StartsWith("\x89PNG\r\n\x1a\n"));
}

TEST_F(FilmTest, HasTheSameBytesTwiceAndWithoutADisplay) {
  EXPECT_EQ(film("a", {"--slow", "4", "--beside", "energy-bounding"}).status, 0);
  const Answer answer = shell(
      "env -u DISPLAY -u WAYLAND_DISPLAY \"$P\" run press --algorithm none --duration 1.05 "
      "--frames-size 320x240 --quiet --frames-from 1 --slow 4 --beside energy-bounding --frames b");
  EXPECT_EQ(answer.status, 0) << answer.err;
  ASSERT_EQ(pictures("a").size(), 12U);
  ASSERT_EQ(pictures("a"), pictures("b"));
  for (const std::string& name : pictures("a"))
    EXPECT_EQ(content("a/" + name), content("b/" + name)) << name;
}

TEST_F(FilmTest, ShowsTheOtherAlgorithmBesideTheFirst) {
  EXPECT_EQ(film("a", {"--frames-rate", "10"}).status, 0);
  EXPECT_EQ(film("b", {"--frames-rate", "10", "--beside", "none"}).status, 0);
  EXPECT_EQ(film("c", {"--frames-rate", "10", "--beside", "half-sample"}).status, 0);
  EXPECT_NE(content("a/00000.png"), content("b/00000.png"));
  EXPECT_NE(content("b/00000.png"), content("c/00000.png"));
}

TEST_F(FilmTest, EndsWhereTheRunDiverges) {
  const std::vector<std::string> arguments{"run",
                                           "light",
                                           "--algorithm",
                                           "none",
                                           "--quiet",
                                           "--frames",
                                           "a",
                                           "--json",
                                           "a.json",
                                           "--frames-size",
                                           "320x240",
                                           "--frames-rate",
                                           "2",
                                           "--set",
                                           "hand.stiffness_n_per_m=1e7",
                                           "--set",
                                           "simulator.integrator=semi-implicit-euler"};
  const Answer answer = hapticwall(arguments);
  ASSERT_EQ(answer.status, 0) << answer.err;
  ASSERT_THAT(content("a.json"), HasSubstr("\"verdict\": \"diverged\""));
  EXPECT_THAT(pictures("a"), ElementsAre("00000.png"));
}

TEST_F(FilmTest, CtrlCLeavesTheOtherFilesAndNoFilm) {
  const Answer answer = terminated(
      {"run", "press", "--frames", "a", "--json", "a.json", "--slow", "50", "--quiet"},
      [&] { return fs::exists(path("a.partial/00001.png")); }, SIGINT);
  EXPECT_EQ(answer.status, 130);
  EXPECT_EQ(answer.err, "ended early by Ctrl-C; the film was not drawn\n");
  EXPECT_THAT(files(), ElementsAre("a.json"));
}

TEST_F(FilmTest, ATakenFolderStaysAsItIs) {
  fs::create_directory(path("a"));
  put("a/theirs", "kept");
  const Answer answer = film("a", {});
  EXPECT_EQ(answer.status, 4);
  EXPECT_EQ(answer.err,
            "error: a: cannot be written: the folder is not empty; choose another name\n");
  EXPECT_THAT(pictures("a"), ElementsAre("theirs"));
}

}  // namespace
}  // namespace hapticwall::command::test
