#include "app/session/recorder.h"

#include <exception>
#include <utility>

#include "app/session/loop/realtime_setup.h"

namespace hapticwall::session {
namespace {

// An exception of a writer (no memory, for example) ends the recording, not the program.
template <typename Work>
Failure guarded(Work&& work) {
  try {
    return work();
  } catch (const std::exception& problem) {
    return Error{ErrorKind::kFile, std::string("recording: ") + problem.what()};
  }
}

}  // namespace

Recorder::~Recorder() { drain_and_join(); }

void Recorder::stream_into(std::shared_ptr<file::SampleStream> stream, file::CsvColumns columns) {
  stream_ = std::move(stream);
  feed_ = stream_->begin(std::move(columns));
}

void Recorder::start(std::unique_ptr<file::RecordingWriter> writer) {
  Tick left_over;
  while (queue_.try_pop(left_over)) {
  }
  writer_ = std::move(writer);
  writable_ = writer_ != nullptr;
  if (writable_) rows_ = first_tick_ = end_tick_ = 0;
  end_ = false;
  failure_.reset();
  note_.reset();
  last_flush_ = last_sync_ = now_();
  thread_ = std::thread([this] { work(); });
}

void Recorder::work() {
  const auto interval = streams() ? kStreamInterval : kDrainInterval;
  set_up_recorder_thread();
  std::unique_lock lock(mutex_);
  while (!end_) {
    wake_.wait_for(lock, interval, [this] { return end_; });
    lock.unlock();
    write_note();  // first: a row on the disk needs its sidecar
    move_ticks();
    save();
    lock.lock();
  }
}

// The disk may take its time: the queue holds the ticks of many seconds.
void Recorder::save() {
  const auto now = now_();
  const bool syncs = now - last_sync_ >= kSyncInterval;
  if (!writable_ || (!syncs && now - last_flush_ < kFlushInterval)) return;
  last_flush_ = now;
  if (syncs) last_sync_ = now;
  keep(guarded([&] { return syncs ? writer_->sync() : writer_->flush(); }));
}

void Recorder::note(const Scene& scene, file::RecordingMetadata metadata) {
  const std::scoped_lock lock(mutex_);
  note_ = Note{scene, std::move(metadata)};
}

void Recorder::write_note() {
  std::optional<Note> note;
  {
    const std::scoped_lock lock(mutex_);
    note.swap(note_);
  }
  if (!note || !writable_) return;
  // If it fails, the rows continue, and finish() tries again.
  static_cast<void>(guarded([&] { return writer_->note(note->scene, note->metadata); }));
}

void Recorder::move_ticks() {
  Tick tick;
  while (queue_.try_pop(tick)) {
    if (writable_) write(tick);
    if (stream_) stream_->take(feed_, tick);
  }
  if (stream_) stream_->flush();
}

void Recorder::write(const Tick& tick) {
  keep(guarded([&] { return writer_->append(tick); }));
  if (!writable_) return;
  if (rows() == 0) first_tick_ = tick.x().tick;
  end_tick_ = tick.x().tick + 1;
  rows_.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::keep(Failure failure) {
  if (!failure) return;
  writable_ = false;
  const std::scoped_lock lock(mutex_);
  if (!failure_) failure_ = std::move(failure);
}

Failure Recorder::failure() const {
  const std::scoped_lock lock(mutex_);
  return failure_;
}

void Recorder::drain_and_join() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    end_ = true;
  }
  wake_.notify_one();
  thread_.join();
  move_ticks();
}

Failure Recorder::finish(const Scene& scene, file::RecordingMetadata metadata) {
  metadata.first_tick = first_tick_;
  if (writable_) keep(guarded([&] { return writer_->finish(scene, metadata); }));
  writable_ = false;
  writer_.reset();
  return failure();
}

}  // namespace hapticwall::session
