// The file of answers: on the disk at once, resumed, and never somebody else's.
#include "app/file/trials/answers_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>

#include "tests/app/file/faulty_disk.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Answer identity_of_p1() {
  Answer answer;
  answer.participant = "P1";
  answer.session = "2";
  answer.seed = 18446744073709551615U;
  answer.program = "0.1.0 (a, b)";
  answer.scene_sha256 = "5ce";
  answer.list_sha256 = "115";
  return answer;
}

Answer answer_number(std::uint64_t trial) {
  Answer answer = identity_of_p1();
  answer.time_utc = "2026-11-23T20:25:38Z";
  answer.trial = trial;
  answer.block = "one";
  answer.kind = TrialKind::kCatch;
  answer.question = "Which is stiffer, \"harder\"?";
  answer.a = "wall.stiffness_n_per_m=1000; algorithm=none";
  answer.first = Slot::kB;
  answer.correct = trial % 2 == 0;
  answer.looks = 3;
  answer.seconds = 0.1 + 0.2;
  return answer;
}

class AnswersFileTest : public hapticwall::test::FolderTest {
 protected:
  // Writes the answers of participant P1: the first `count`.
  void write(std::uint64_t count) {
    auto file = AnswersFile::open(path("p1.csv"), identity_of_p1());
    ASSERT_TRUE(file) << file.error().message;
    for (std::uint64_t i = 1; i <= count; ++i) ASSERT_FALSE(file->append(answer_number(i)));
  }
  [[nodiscard]] std::string refusal(const Answer& identity) const {
    const auto file = AnswersFile::open(path("p1.csv"), identity);
    return file ? "" : file.error().message;
  }
};

TEST_F(AnswersFileTest, ALineIsOneAnswer) {
  EXPECT_EQ(answer_line(answer_number(4)),
            "P1,2,2026-11-23T20:25:38Z,4,one,catch,\"Which is stiffer, \"\"harder\"\"?\","
            "wall.stiffness_n_per_m=1000; algorithm=none,,B,A,A,2,1,3,0.30000000000000004,"
            "18446744073709551615,\"0.1.0 (a, b)\",5ce,115,0,0,0,0,0,0,,,\n");
  for (const std::optional<bool> correct : {std::optional<bool>(), {true}, {false}}) {
    Answer answer = answer_number(3);
    answer.correct = correct;
    const std::string line = answer_line(answer);
    EXPECT_EQ(parse_answer(std::string_view(line).substr(0, line.size() - 1)), answer);
  }
}

TEST_F(AnswersFileTest, ItsColumnsAreThoseOfTheTrials) {
  const AnswerColumns columns{true, {"wall.stiffness_n_per_m"}, {"step", "a, b"}};
  const std::string header = answers_header(columns);
  EXPECT_THAT(header, ::testing::EndsWith(
                          "contact_s,mean_force_n,max_force_n,energy_to_hand_j,touches,lost_ticks,"
                          "recording,first_tick,last_tick,a.wall.stiffness_n_per_m,"
                          "b.wall.stiffness_n_per_m,step,\"a, b\"\n"));
  EXPECT_EQ(parse_answers_header(std::string_view(header).substr(0, header.size() - 1)), columns);
  Answer answer = answer_number(3);
  answer.exposure = {1.5, 2.0, 3.0, -0.25, 4, 5, "r.csv", 7, 9};
  answer.values = {"1000", "1200"};
  answer.extras = {" as it is ", "x,\"y\""};
  const std::string line = answer_line(answer, columns);
  EXPECT_THAT(line, ::testing::EndsWith(
                        ",1.5,2,3,-0.25,4,5,r.csv,7,9,1000,1200, as it is ,\"x,\"\"y\"\"\"\n"));
  EXPECT_EQ(parse_answer(std::string_view(line).substr(0, line.size() - 1), columns), answer);
}

TEST_F(AnswersFileTest, OtherColumnsAreNeverMixed) {
  write(2);
  const std::string before = content("p1.csv");
  const auto other =
      AnswersFile::open(path("p1.csv"), identity_of_p1(), AnswerColumns{true, {}, {"step"}});
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("its columns are not those of these trials"));
  EXPECT_EQ(content("p1.csv"), before);
}

// A file of version 0.1.0 keeps its columns to its end.
TEST_F(AnswersFileTest, OneWithoutExposureIsContinuedWithoutIt) {
  const AnswerColumns old{false, {}, {}};
  put("p1.csv", answers_header(old) + answer_line(answer_number(1), old));
  std::filesystem::permissions(path("p1.csv"), static_cast<std::filesystem::perms>(0600));
  write(1);
  EXPECT_EQ(content("p1.csv"), answers_header(old) + answer_line(answer_number(1), old) +
                                   answer_line(answer_number(1), old));
}

TEST_F(AnswersFileTest, ColumnsWithoutAnAnswerAreWrittenAnew) {
  write(0);
  const AnswerColumns columns{true, {}, {"step"}};
  ASSERT_TRUE(AnswersFile::open(path("p1.csv"), identity_of_p1(), columns));
  EXPECT_EQ(content("p1.csv"), answers_header(columns));
  ASSERT_TRUE(AnswersFile::open(path("p1.csv"), identity_of_p1(), std::nullopt));
  EXPECT_EQ(content("p1.csv"), "") << "the first trial decides";
}

TEST_F(AnswersFileTest, IsContinued) {
  write(2);
  write(0);
  const auto file = AnswersFile::open(path("p1.csv"), identity_of_p1());
  ASSERT_TRUE(file);
  EXPECT_THAT(file->found(), ElementsAre(answer_number(1), answer_number(2)));
  EXPECT_FALSE(file->dropped());
}

// A kill may leave any part of a line, also of the first one.
TEST_F(AnswersFileTest, ATornLineIsDroppedAtEveryByte) {
  write(2);
  const std::string whole = content("p1.csv");
  const std::size_t header = answers_header().size();
  const std::size_t one = header + answer_line(answer_number(1)).size();
  for (std::size_t bytes = 0; bytes <= whole.size(); ++bytes) {
    put("p1.csv", whole.substr(0, bytes));
    const std::size_t kept = bytes < header         ? 0
                             : bytes < one          ? header
                             : bytes < whole.size() ? one
                                                    : bytes;
    {
      const auto file = AnswersFile::open(path("p1.csv"), identity_of_p1());
      ASSERT_TRUE(file) << bytes << ": " << file.error().message;
      EXPECT_EQ(file->found().size(), kept < one ? 0U : kept < whole.size() ? 1U : 2U) << bytes;
      EXPECT_EQ(file->dropped(), kept < bytes) << bytes;
    }
    ASSERT_EQ(content("p1.csv"), whole.substr(0, std::max(kept, header))) << bytes;
  }
}

TEST_F(AnswersFileTest, SomebodyElsesIsRefusedAndUntouched) {
  write(1);
  const std::string torn = content("p1.csv") + "P1,2,20";
  put("p1.csv", torn);
  Answer other = identity_of_p1();
  other.participant = "P2";
  EXPECT_THAT(refusal(other), HasSubstr("answers of participant 'P1'; choose another file"));
  other = identity_of_p1();
  other.session = "3";
  EXPECT_THAT(refusal(other), HasSubstr("answers of session '2'"));
  other = identity_of_p1();
  other.list_sha256 = "116";
  EXPECT_THAT(refusal(other), HasSubstr("to another trial list"));
  other = identity_of_p1();
  other.scene_sha256 = "5cf";
  EXPECT_THAT(refusal(other), HasSubstr("on another scene"));
  other = identity_of_p1();
  other.seed = 1;
  EXPECT_THAT(refusal(other), HasSubstr("in another order"));
  EXPECT_EQ(content("p1.csv"), torn);
}

TEST_F(AnswersFileTest, AFileOfSomethingElseIsRefusedAndUntouched) {
  write(1);
  const std::string whole = content("p1.csv");
  for (const std::string& text :
       {std::string("hello"), std::string("a,b\n"), whole + "hello\n", whole + "\xff\n",
        answers_header() + "x" + whole.substr(answers_header().size())}) {
    put("p1.csv", text);
    EXPECT_NE(refusal(identity_of_p1()), "") << text;
    EXPECT_EQ(content("p1.csv"), text);
  }
}

// Somebody could read and change later what is written into a file that was prepared.
TEST_F(AnswersFileTest, APreparedFileIsRefusedAndUntouched) {
  namespace fs = std::filesystem;
  const auto expect_refused = [&](const std::string& reason) {
    EXPECT_EQ(refusal(identity_of_p1()),
              path("p1.csv") + ": cannot be written: it " + reason + "; choose another name");
    fs::remove(path("p1.csv"));
  };
  put("theirs", "");
  fs::create_symlink(path("theirs"), path("p1.csv"));
  expect_refused("is a symbolic link");
  fs::create_hard_link(path("theirs"), path("p1.csv"));
  expect_refused("has a second name");
  ASSERT_EQ(mkfifo(path("p1.csv").c_str(), 0600), 0);
  expect_refused("is not a regular file");
  for (const mode_t mode : {mode_t{0666}, mode_t{0620}}) {
    put("p1.csv", "");
    ASSERT_EQ(chmod(path("p1.csv").c_str(), mode), 0);
    expect_refused("can be written by others");
  }
  EXPECT_EQ(content("theirs"), "");
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to make a file of another user";
  constexpr uid_t kNobody = 65534;
  put("p1.csv", "");
  ASSERT_EQ(chown(path("p1.csv").c_str(), kNobody, kNobody), 0);
  expect_refused("belongs to another user");
}

TEST_F(AnswersFileTest, OnlyItsOwnerReadsAndWritesANewFile) {
  const mode_t before = umask(0);
  write(1);
  umask(before);
  EXPECT_EQ(std::filesystem::status(path("p1.csv")).permissions(),
            static_cast<std::filesystem::perms>(0600));
}

TEST_F(AnswersFileTest, OneProgramWritesAtATime) {
  const auto first = AnswersFile::open(path("p1.csv"), identity_of_p1());
  ASSERT_TRUE(first);
  EXPECT_THAT(refusal(identity_of_p1()), HasSubstr("another process is writing it"));
}

TEST_F(AnswersFileTest, AFullOrFailingDiskLeavesWholeLines) {
  write(1);
  const std::string before = content("p1.csv");
  {
    auto file = AnswersFile::open(path("p1.csv"), identity_of_p1());
    ASSERT_TRUE(file);
    for (const std::size_t room : {0U, 1U, 40U}) {
      test::FaultyDisk disk;
      disk.fail_after(room, ENOSPC);
      const Failure failure = file->append(answer_number(2));
      ASSERT_TRUE(failure) << room;
      EXPECT_EQ(failure->kind, ErrorKind::kFile);
      EXPECT_THAT(failure->message, HasSubstr("No space left on device"));
      EXPECT_EQ(content("p1.csv"), before) << room;
    }
    test::FaultyDisk disk;
    disk.fail_sync(EIO);
    EXPECT_THAT(file->append(answer_number(2))->message, HasSubstr("Input/output error"));
    EXPECT_EQ(content("p1.csv"), before) << "what is not on the disk does not count";
  }
  write(0);
  auto file = AnswersFile::open(path("p1.csv"), identity_of_p1());
  EXPECT_FALSE(file->append(answer_number(2)));
  EXPECT_EQ(content("p1.csv"), before + answer_line(answer_number(2)));
}

}  // namespace
}  // namespace hapticwall::file
