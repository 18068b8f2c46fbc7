// A recording writer in memory that fails on request.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/file/recording/recording_writer.h"

namespace hapticwall::session::test {

// The writer's actions. The vectors belong to the writer's thread until it is joined.
struct WriterLog {
  std::vector<std::uint64_t> ticks;
  std::vector<file::RecordingMetadata> finished;
  std::vector<file::RecordingMetadata> notes;
  std::atomic<int> flushes{0};
  std::atomic<int> syncs{0};
  std::uint64_t fail_at_row = 0;   // 0: never
  std::uint64_t throw_at_row = 0;  // 0: never
  std::atomic<bool> fail_at_flush{false};
};

class FakeWriter : public file::RecordingWriter {
 public:
  explicit FakeWriter(std::shared_ptr<WriterLog> log) : log_(std::move(log)) {}

  Failure note(const Scene& scene, const file::RecordingMetadata& metadata) override {
    static_cast<void>(scene);
    log_->notes.push_back(metadata);
    return std::nullopt;
  }
  Failure append(const Tick& tick) override {
    const std::uint64_t row = log_->ticks.size() + 1;
    if (row == log_->throw_at_row) throw std::runtime_error("no memory");
    if (row == log_->fail_at_row) return Error{ErrorKind::kFile, "disk full"};
    log_->ticks.push_back(tick.x().tick);
    return std::nullopt;
  }
  Failure flush() override {
    ++log_->flushes;
    if (log_->fail_at_flush) return Error{ErrorKind::kFile, "disk gone"};
    return std::nullopt;
  }
  Failure sync() override {
    ++log_->syncs;
    return flush();
  }
  Failure finish(const Scene& scene, const file::RecordingMetadata& metadata) override {
    static_cast<void>(scene);
    log_->finished.push_back(metadata);
    return std::nullopt;
  }
  [[nodiscard]] std::uint64_t rows() const override { return log_->ticks.size(); }
  [[nodiscard]] const std::string& csv_path() const override { return path_; }
  [[nodiscard]] const std::string& sidecar_path() const override { return path_; }

 private:
  std::shared_ptr<WriterLog> log_;
  std::string path_ = "memory.csv";
};

}  // namespace hapticwall::session::test
