// A stream of samples: names and numbers of the CSV, whole lines, and an exact count of losses.
#include "app/file/recording/sample_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <sstream>

#include "app/file/text/text.h"
#include "tests/app/file/faulty_disk.h"
#include "tests/app/file/recording_support.h"
#include "tests/app/file/stream_support.h"

namespace hapticwall::file::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Ticks = std::vector<std::uint64_t>;

constexpr std::uint64_t kTooMany = 10'000;  // ticks; more than pipe and buffer hold

class SampleStreamTest : public hapticwall::test::FolderTest {
 protected:
  void take(std::uint64_t first, std::uint64_t end) {
    for (std::uint64_t tick = first; tick < end; ++tick) stream_->take(feed_, tick_at(tick));
    stream_->flush();
  }
  void open(std::uint64_t every = 1) {
    StreamOptions options;
    options.every = every;
    open_at(reader_.path(), std::move(options));
  }
  // It waits for its reader until `stopped`.
  void open_waiting(std::function<bool()> stopped) {
    StreamOptions options;
    options.waits = true;
    options.stopped = std::move(stopped);
    open_at(reader_.path(), std::move(options));
  }
  void open_at(const std::string& file, StreamOptions options = {}) {
    stream_ = opened_stream(file, told_, std::move(options));
    feed_ = stream_->begin(csv_columns(true));
  }

  StreamReader reader_{path("pipe")};
  std::shared_ptr<std::vector<std::string>> told_ = std::make_shared<std::vector<std::string>>();
  std::shared_ptr<SampleStream> stream_;
  StreamFeed feed_;
};

TEST_F(SampleStreamTest, EventsStandBetweenTheSamplesAndCountInNoNumber) {
  open();
  take(0, 2);
  stream_->add_event(R"({"event":"mark","tick":1})");
  stream_->add_event(std::string(SampleStream::kMaxEventBytes + 1, ' '));
  take(2, 3);
  stream_->finish();
  const auto objects = reader_.objects();
  ASSERT_EQ(objects.size(), 5U);
  EXPECT_EQ(objects[2]["event"], "mark");
  EXPECT_EQ(objects[4], nlohmann::json::parse(R"({"end":true,"samples":3,"lost":0})"));
}

TEST_F(SampleStreamTest, UnreadEventsAreNoLostSamples) {
  open();
  take(0, kTooMany);
  for (int i = 0; i < 5; ++i) stream_->add_event(R"({"event":"mark"})");
  const std::uint64_t lost = stream_->lost();
  stream_->finish();
  const auto samples = ticks_in(reader_.objects()).size();
  EXPECT_GT(lost, 0U);
  EXPECT_EQ(samples + stream_->lost(), kTooMany);
}

TEST_F(SampleStreamTest, AnObjectHasTheNamesAndNumbersOfTheRow) {
  for (const bool simulated : {true, false}) {
    for (const std::uint8_t axes : {std::uint8_t{1}, std::uint8_t{2}}) {
      Tick tick = tick_at(7);
      tick.axes[1] = sample_at(7);
      tick.axes[1].position_m = 0.25;
      tick.axes[1].applied_force_n = 1.0 / 3.0;
      tick.count = axes;
      const CsvColumns columns = csv_columns(simulated, axes);
      std::string row;
      std::string object;
      append_csv_row(row, tick, columns);
      append_json_object(object, tick, columns, 5);
      const auto read = nlohmann::ordered_json::parse(object);
      const std::string header = csv_header(columns);
      const auto names = split(header, ',');
      const auto values = split(trimmed(row.erase(row.size() - 1)), ',');
      ASSERT_EQ(read.size(), names.size() + 1);
      for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(read.at(names[i]).get<double>(), parsed<double>(values[i])) << names[i];
      }
      EXPECT_EQ(read.at("lost"), 5);
      EXPECT_EQ(object.back(), '\n');
    }
  }
}

TEST_F(SampleStreamTest, EveryNthTickAndALineAtTheEnd) {
  open(10);
  take(5, 35);
  stream_->finish();
  const auto objects = reader_.objects();
  EXPECT_EQ(ticks_in(objects), (Ticks{10, 20, 30}));
  EXPECT_EQ(objects.back(), nlohmann::json::parse(R"({"end":true,"samples":3,"lost":0})"));
  EXPECT_THAT(*told_, IsEmpty());
}

TEST_F(SampleStreamTest, AReaderThatNeverReadsLosesACountedNumber) {
  open();
  take(0, kTooMany);
  stream_->finish();
  const std::uint64_t read = ticks_in(reader_.objects()).size();
  EXPECT_GT(read, 0U);
  ASSERT_EQ(told_->size(), 1U);
  EXPECT_THAT(told_->front(), HasSubstr(std::to_string(kTooMany - read) + " of " +
                                        std::to_string(kTooMany) + " samples were lost"));
}

// A reader that takes nothing for 1.2 s, then everything.
TEST_F(SampleStreamTest, AStreamThatWaitsLosesNothing) {
  int asked = 0;
  open_waiting([&] {
    if (++asked > 24) reader_.drained();
    return false;
  });
  take(0, kTooMany);
  stream_->finish();
  const auto objects = reader_.objects();
  EXPECT_EQ(ticks_in(objects).size(), kTooMany);
  EXPECT_EQ(objects.back()["lost"], 0);
  EXPECT_GT(asked, 24);
  EXPECT_THAT(*told_, IsEmpty());
}

TEST_F(SampleStreamTest, AStreamThatWaitsEndsWhenItIsAsked) {
  bool stopped = false;
  int asked = 0;
  open_waiting([&] { return stopped = ++asked > 3; });
  take(0, kTooMany);
  stream_->finish();
  EXPECT_TRUE(stopped);
  const std::uint64_t read = ticks_in(reader_.objects()).size();
  EXPECT_EQ(stream_->lost(), kTooMany - read);
  EXPECT_EQ(told_->size(), 1U);
}

// A kill at any moment leaves what was written until then.
TEST_F(SampleStreamTest, AFullPipeEndsWithALine) {
  open();
  take(0, kTooMany);
  for (int i = 0; i < 50; ++i) {
    for (int blocks = 0; blocks < 3; ++blocks) reader_.read_some();
    stream_->flush();
    if (i % 10 > 0) continue;
    ASSERT_EQ(reader_.drained().back(), '\n') << i;
  }
}

TEST_F(SampleStreamTest, AFileHasWholeLinesOnEveryPage) {
  constexpr std::size_t kPage = 4096;
  open_at(path("a.jsonl"));
  std::size_t checked = 0;
  for (std::uint64_t tick = 0; tick < 500; ++tick) {
    take(tick, tick + 1);
    const std::string text = content("a.jsonl");
    ASSERT_EQ(text.size() % kPage, 0U) << "a write is a page";
    if (text.size() == checked) continue;
    checked = text.size();
    ASSERT_EQ(text.back(), '\n');
  }
  stream_->finish();
  std::istringstream text(content("a.jsonl"));
  std::uint64_t tick = 0;
  for (std::string line; std::getline(text, line); ++tick) {
    const auto object = nlohmann::json::parse(line);
    EXPECT_EQ(object.value("tick", tick), tick);
  }
  EXPECT_EQ(tick, 501U) << "and the line at the end";
}

TEST_F(SampleStreamTest, AFullDiskLeavesWholeLines) {
  open_at(path("a.jsonl"));
  FaultyDisk disk;
  disk.fail_after(10'000, ENOSPC);
  take(0, 100);
  ASSERT_TRUE(stream_->failure());
  EXPECT_EQ(content("a.jsonl").size(), 8192U);
  EXPECT_EQ(content("a.jsonl").back(), '\n');
}

TEST_F(SampleStreamTest, AReaderThatHasLeftIsNoticedWithoutASample) {
  open(1000);
  reader_.close_early();
  EXPECT_FALSE(stream_->reader_left());
  stream_->flush();
  EXPECT_TRUE(stream_->reader_left());
  EXPECT_THAT(*told_, ElementsAre(HasSubstr("the reader has closed it")));
}

TEST_F(SampleStreamTest, AReaderThatComesBackIsToldTheLoss) {
  open();
  take(0, kTooMany);
  while (reader_.read_some()) stream_->flush();  // reads the pending bytes
  const std::size_t before = ticks_in(reader_.objects()).size();
  EXPECT_LT(before, kTooMany) << "the buffer has a limit";
  take(kTooMany, kTooMany + 1);
  const auto objects = reader_.objects();
  ASSERT_EQ(ticks_in(objects).size(), before + 1);
  EXPECT_EQ(objects.back()["tick"], kTooMany);
  EXPECT_EQ(objects.back()["lost"], kTooMany - before);
  EXPECT_EQ(objects.front()["lost"], 0);
  stream_->finish();
  EXPECT_EQ(reader_.objects().back()["lost"], kTooMany - before);
}

TEST_F(SampleStreamTest, AReaderThatClosesEndsItWithOneLine) {
  open();
  take(0, 10);
  reader_.close_early();
  take(10, kTooMany);
  stream_->finish();
  EXPECT_THAT(*told_, ElementsAre(HasSubstr("the reader has closed it")));
  EXPECT_FALSE(stream_->failure());
}

TEST_F(SampleStreamTest, MissingTicksAreLostAndAResetLosesNone) {
  open(10);
  take(0, 15);
  take(45, 55);  // 20, 30, 40
  take(0, 1);    // a reset
  stream_->finish();
  const auto objects = reader_.objects();
  EXPECT_EQ(ticks_in(objects), (Ticks{0, 10, 50, 0}));
  EXPECT_EQ(objects.back()["lost"], 3);
}

// JSON has no NaN, and the CSV has no row of it either.
TEST_F(SampleStreamTest, ATickThatIsNotFiniteIsLeftOut) {
  open();
  Tick tick = tick_at(0);
  tick.axes.front().force_n = std::numeric_limits<double>::quiet_NaN();
  stream_->take(feed_, tick);
  take(1, 2);
  stream_->finish();
  const auto objects = reader_.objects();
  EXPECT_EQ(ticks_in(objects), (Ticks{1}));
  EXPECT_EQ(objects.back()["lost"], 0);
}

TEST_F(SampleStreamTest, ANewSessionSilencesTheOldOne) {
  open();
  take(0, 2);
  StreamFeed old = feed_;
  feed_ = stream_->begin(csv_columns(true));
  stream_->take(old, tick_at(50));
  take(0, 1);
  stream_->finish();
  const auto objects = reader_.objects();
  EXPECT_EQ(ticks_in(objects), (Ticks{0, 1, 0}));
  EXPECT_EQ(objects.back()["lost"], 0);
}

TEST_F(SampleStreamTest, AFileWithoutASampleIsRemoved) {
  for (const bool empty : {true, false}) {
    stream_ = opened_stream(path("a.jsonl"));
    feed_ = stream_->begin(csv_columns(true));
    if (!empty) take(0, 1);
    stream_->finish();
    EXPECT_EQ(std::filesystem::exists(path("a.jsonl")), !empty);
  }
}

TEST_F(SampleStreamTest, AFullDiskEndsItAndIsAFailure) {
  stream_ = opened_stream("/dev/full", told_);
  feed_ = stream_->begin(csv_columns(true));
  take(0, 2);
  ASSERT_TRUE(stream_->failure());
  EXPECT_EQ(stream_->failure()->kind, ErrorKind::kFile);
  EXPECT_THAT(*told_, ElementsAre(HasSubstr("No space left")));
}

}  // namespace
}  // namespace hapticwall::file::test
