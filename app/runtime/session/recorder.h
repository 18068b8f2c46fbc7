// The thread between the loop's recorder queue and the disk.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/file/recording_writer.h"
#include "app/runtime/spsc_queue.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::runtime {

// One recording at a time: start(), finish(), start() again. All members are called from the
// owner's thread; the loop only pushes into the queue. Realtime-safe: no.
class Recorder {
 public:
  // How long samples may wait in the queue, and written rows in our own buffers.
  static constexpr std::chrono::milliseconds kDrainInterval{50};
  static constexpr std::chrono::milliseconds kFlushInterval{250};

  // `y_queue`: of the second axis, filled by push_both(); null: there is none.
  explicit Recorder(SpscQueue<Sample>& queue, SpscQueue<Sample>* y_queue = nullptr)
      : queue_(queue), y_queue_(y_queue) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder();  // without finish() the partial file stays

  [[nodiscard]] bool running() const { return thread_.joinable(); }

  // Begins to move samples from the queue into `writer`. Precondition: not running, and nothing
  // pushes into the queue yet: what an earlier recording left in it is thrown away.
  void start(std::unique_ptr<file::RecordingWriter> writer);

  // What is known of the recording by now goes to the writer's note(), before the samples that
  // wait in the queue.
  void note(const Scene& scene, file::RecordingMetadata metadata);

  // Drains the queue, which nobody may push into any more, and joins the thread. The writer is left
  // open for finish(). Harmless when not running.
  void drain_and_join();

  // Gives the files their names; `metadata.first_tick` becomes that of the first row.
  // Precondition: drain_and_join() was called. Fails with the first thing that went wrong.
  [[nodiscard]] Failure finish(const Scene& scene, file::RecordingMetadata metadata);

  [[nodiscard]] std::uint64_t rows() const { return rows_.load(std::memory_order_relaxed); }
  // After drain_and_join(): ticks of the first row and after the last one; both 0 without rows.
  [[nodiscard]] std::uint64_t first_tick() const { return first_tick_; }
  [[nodiscard]] std::uint64_t end_tick() const { return end_tick_; }
  // The first thing that went wrong, if anything did.
  [[nodiscard]] Failure failure() const;

 private:
  void work();
  void move_samples();
  void write_note();
  [[nodiscard]] bool take(Sample& x, Sample& y);
  void write(const Sample& x, const Sample& y);
  void keep(Failure failure);

  SpscQueue<Sample>& queue_;
  SpscQueue<Sample>* y_queue_;
  std::unique_ptr<file::RecordingWriter> writer_;
  std::thread thread_;

  std::atomic<std::uint64_t> rows_{0};
  std::uint64_t first_tick_ = 0;
  std::uint64_t end_tick_ = 0;
  bool writable_ = false;  // false once something went wrong: samples are taken and thrown away

  mutable std::mutex mutex_;  // between owner and recorder thread; the loop never sees it
  std::condition_variable wake_;
  bool end_ = false;
  struct Note {
    Scene scene;
    file::RecordingMetadata metadata;
  };
  std::optional<Note> note_;  // not written yet
  Failure failure_;
};

}  // namespace hapticwall::runtime
