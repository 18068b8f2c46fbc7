// A bounded first-in first-out queue from one thread to another that never allocates after set-up.
//
// moodycamel's circular buffer with the two calls that neither block nor grow: a push that finds no
// room fails at once. (Of the two queues in that library this is the one of fixed memory, and the
// one whose ordering ThreadSanitizer understands.)
#pragma once

#include <readerwriterqueue/readerwritercircularbuffer.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace hapticwall::runtime {

template <typename T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>, "copies must not allocate, lock or throw");

 public:
  // Room for `capacity` elements (at least 1), all of it touched, so that the first round through
  // the queue takes no page faults. Realtime-safe: no.
  explicit SpscQueue(std::size_t capacity) : queue_(std::max<std::size_t>(capacity, 1)) {
    const T blank{};
    while (queue_.try_enqueue(blank)) {
    }
    T dropped;
    while (queue_.try_dequeue(dropped)) {
    }
  }

  // Producer only: false where the queue is full. Realtime-safe: yes.
  [[nodiscard]] bool try_push(const T& value) { return queue_.try_enqueue(value); }

  // Consumer only: false where the queue is empty. Realtime-safe: yes.
  [[nodiscard]] bool try_pop(T& value) { return queue_.try_dequeue(value); }

  // Elements waiting; out of date as soon as it is known. Realtime-safe: yes.
  [[nodiscard]] std::size_t size() const { return queue_.size_approx(); }
  [[nodiscard]] std::size_t capacity() const { return queue_.max_capacity(); }

 private:
  moodycamel::BlockingReaderWriterCircularBuffer<T> queue_;
};

}  // namespace hapticwall::runtime
