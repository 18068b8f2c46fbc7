// The user's wishes for recordings, and for the marks in them.
#pragma once

#include <cstdint>
#include <string>

namespace hapticwall::ui {

// A question in a popup.
enum class Question : std::uint8_t { kNone, kAsked, kShown };

struct RecordingWishes {
  // Stored in the settings file.
  std::string chosen_folder;    // empty: the current one
  bool chosen_signals = false;  // signals of algorithms

  // In force: from the command line, or as chosen.
  std::string folder;
  bool records_signals = false;

  std::string name;                           // empty: named after scene and algorithm
  std::string mark_text;                      // of the next mark
  bool focus_mark = false;                    // the mark's field gets the keyboard
  bool names_mark = false;                    // the mark's field names the newest mark
  Question reset_question = Question::kNone;  // "a recording runs: reset?"
};

}  // namespace hapticwall::ui
