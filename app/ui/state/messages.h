// What there is to tell: notes that fade, and problems that stay until they are put away.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hapticwall::ui {

struct PanelContext;

enum class MessageKind : std::uint8_t { kNone, kNote, kProblem };

struct Message {
  MessageKind kind = MessageKind::kNone;
  std::string text;
};

struct Toast {
  std::uint64_t id = 0;
  Message message;
  int times = 1;       // how often it was told
  double age_s = 0.0;  // since it was last told or looked at
};

inline constexpr double kNoteLifeS = 6.0;
inline constexpr double kFadeS = 0.6;  // the last part of a note's life
inline constexpr std::size_t kMostToasts = 50;

class Toasts {
 public:
  // The newest comes last. What was told already and is still there is not told twice: it is
  // counted, and becomes the newest.
  void tell(MessageKind kind, std::string text);
  void put_away(std::uint64_t id);
  void put_newest_away();
  void clear() { list_.clear(); }
  // Lets time pass: notes grow old and go. `looked_at`: the one that the pointer is on stays young.
  void pass(double seconds, std::uint64_t looked_at);

  [[nodiscard]] const std::vector<Toast>& list() const { return list_; }
  // Of kind kNone where there is none.
  [[nodiscard]] Message newest() const;
  // Something of it changes by itself: frames are wanted.
  [[nodiscard]] bool moving() const;

 private:
  std::vector<Toast> list_;
  std::uint64_t next_id_ = 1;
};

// How much of a toast is to be seen, 0 to 1.
[[nodiscard]] float opacity(const Toast& toast);

// Stacked over everything else, the newest lowest, their lower right corner at (right, bottom).
void draw_toasts(const PanelContext& context, float right, float bottom);

}  // namespace hapticwall::ui
