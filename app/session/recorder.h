// The thread between recorder queue, disk and stream.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "app/file/recording/recording_writer.h"
#include "app/file/recording/sample_stream.h"
#include "app/session/loop/spsc_queue.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::session {

// One recording at a time: start(), finish(), start() again. Call all members from the owner's
// thread; the loop only pushes into the queue. Realtime-safe: no.
class Recorder {
 public:
  // How long ticks may wait in the queue, and rows in our own buffers.
  static constexpr std::chrono::milliseconds kDrainInterval{50};
  static constexpr std::chrono::milliseconds kStreamInterval{10};  // kDrainInterval with a stream
  static constexpr std::chrono::milliseconds kFlushInterval{250};
  // Together with kDrainInterval: rows older than a second are on the disk, also after a power cut.
  static constexpr std::chrono::milliseconds kSyncInterval{750};

  using Now = std::function<std::chrono::steady_clock::time_point()>;
  explicit Recorder(SpscQueue<Tick>& queue, Now now = std::chrono::steady_clock::now)
      : queue_(queue), now_(std::move(now)) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder();  // keeps the partial file without finish()

  // Precondition: before the first start().
  void stream_into(std::shared_ptr<file::SampleStream> stream, file::CsvColumns columns);
  [[nodiscard]] bool streams() const { return stream_ != nullptr; }

  // True if a recording runs.
  [[nodiscard]] bool running() const { return writer_ != nullptr && thread_.joinable(); }

  // Begins to move ticks from the queue into `writer` and the stream; a null writer: into the
  // stream alone. Drops what an earlier recording left in the queue. Precondition: the thread does
  // not run, and nothing pushes into the queue yet.
  void start(std::unique_ptr<file::RecordingWriter> writer);

  // Passes the present facts about the recording to the writer's note(), before the ticks that wait
  // in the queue.
  void note(const Scene& scene, file::RecordingMetadata metadata);

  // Drains the queue and joins the thread; the writer stays open for finish(). Does nothing when
  // the thread does not run. Precondition: nothing pushes into the queue any more.
  void drain_and_join();

  // Gives the files their names; sets `metadata.first_tick` to the first row. Precondition:
  // drain_and_join(). Fails with the first error.
  [[nodiscard]] Failure finish(const Scene& scene, file::RecordingMetadata metadata);

  [[nodiscard]] std::uint64_t rows() const { return rows_.load(std::memory_order_relaxed); }
  // Valid after drain_and_join(): tick of the first row, and the one after the last row; both 0
  // without rows.
  [[nodiscard]] std::uint64_t first_tick() const { return first_tick_; }
  [[nodiscard]] std::uint64_t end_tick() const { return end_tick_; }
  // The first failure, if any.
  [[nodiscard]] Failure failure() const;

 private:
  void work();
  // flush() or sync(), if it is time for one.
  void save();
  void move_ticks();
  void write_note();
  void write(const Tick& tick);
  void keep(Failure failure);

  SpscQueue<Tick>& queue_;
  Now now_;
  std::chrono::steady_clock::time_point last_flush_;
  std::chrono::steady_clock::time_point last_sync_;
  std::unique_ptr<file::RecordingWriter> writer_;
  std::shared_ptr<file::SampleStream> stream_;
  file::StreamFeed feed_;
  std::thread thread_;

  std::atomic<std::uint64_t> rows_{0};
  std::uint64_t first_tick_ = 0;
  std::uint64_t end_tick_ = 0;
  bool writable_ = false;  // false after a failure: ticks are taken and dropped

  mutable std::mutex mutex_;  // shared by owner and recorder thread; never taken by the loop
  std::condition_variable wake_;
  bool end_ = false;
  struct Note {
    Scene scene;
    file::RecordingMetadata metadata;
  };
  std::optional<Note> note_;  // not written yet
  Failure failure_;
};

}  // namespace hapticwall::session
