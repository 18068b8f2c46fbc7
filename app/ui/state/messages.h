// Messages to the user. Notes fade; problems stay until the user closes them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

enum class MessageKind : std::uint8_t { kNone, kNote, kProblem };

struct Message {
  MessageKind kind = MessageKind::kNone;
  std::string text;
};

struct Toast {
  std::uint64_t id = 0;
  Message message;
  int times = 1;       // number of repetitions
  double age_s = 0.0;  // since it was last raised or hovered
};

inline constexpr double kNoteLifeS = 6.0;
inline constexpr double kFadeS = 0.6;  // the last part of a note's life
inline constexpr std::size_t kMaxToasts = 50;

class Toasts {
 public:
  // The newest is last. A repeated message is counted and becomes the newest.
  void tell(MessageKind kind, std::string text);
  void put_away(std::uint64_t id);
  void put_newest_away();
  void clear() { list_.clear(); }
  // Ages the notes and removes old ones. `looked_at`: the hovered message, which stays young.
  void pass(double seconds, std::uint64_t looked_at);

  [[nodiscard]] const std::vector<Toast>& list() const { return list_; }
  // Kind kNone when there is no message.
  [[nodiscard]] Message newest() const;
  // True while a note fades: frames are needed.
  [[nodiscard]] bool moving() const;

 private:
  std::vector<Toast> list_;
  std::uint64_t next_id_ = 1;
};

// Tells an error.
inline void tell(Toasts& toasts, const Error& error) {
  toasts.tell(MessageKind::kProblem, error.message);
}
// Tells a failure, or this note.
inline void tell(Toasts& toasts, const Failure& failure, std::string note) {
  if (failure) return tell(toasts, *failure);
  toasts.tell(MessageKind::kNote, std::move(note));
}
// Tells a problem of the session or of the validation, in one line.
inline void tell(Toasts& toasts, const SceneProblem& problem) {
  toasts.tell(MessageKind::kProblem,
              problem.key.empty() ? problem.message : problem.key + ": " + problem.message);
}

// Opacity of a toast, 0 to 1.
[[nodiscard]] float opacity(const Toast& toast);

}  // namespace hapticwall::ui
