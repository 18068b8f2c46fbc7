// A bounded FIFO queue from one thread to another that never allocates after set-up.
//
// Wraps moodycamel's circular buffer: of that library's queues it has fixed memory, and an ordering
// that ThreadSanitizer understands. Only calls that neither block nor grow are used.
#pragma once

#include <readerwriterqueue/readerwritercircularbuffer.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace hapticwall::session {

template <typename T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>, "copies must not allocate, lock or throw");

 public:
  // Room for `capacity` elements, at least 1. Touches all of it, to avoid page faults later.
  // Realtime-safe: no.
  explicit SpscQueue(std::size_t capacity) : queue_(std::max<std::size_t>(capacity, 1)) {
    const T blank{};
    while (queue_.try_enqueue(blank)) {
    }
    T dropped;
    while (queue_.try_dequeue(dropped)) {
    }
  }

  // Producer only: false if the queue is full. Realtime-safe: yes.
  [[nodiscard]] bool try_push(const T& value) { return queue_.try_enqueue(value); }

  // Consumer only: false if the queue is empty. Realtime-safe: yes.
  [[nodiscard]] bool try_pop(T& value) { return queue_.try_dequeue(value); }

  // Number of elements; the other thread may change it at once. Realtime-safe: yes.
  [[nodiscard]] std::size_t size() const { return queue_.size_approx(); }
  [[nodiscard]] std::size_t capacity() const { return queue_.max_capacity(); }

 private:
  moodycamel::BlockingReaderWriterCircularBuffer<T> queue_;
};

}  // namespace hapticwall::session
