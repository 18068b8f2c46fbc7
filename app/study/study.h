// The contract of a study: its options, its computing and its result. The command line, the page of
// the window and the figure files read this, and none of them knows a subject.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/draw/plot/log_plot.h"
#include "app/table/text_table.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::study {

// --KEY on the command line.
struct Option {
  std::string_view key;
  std::string_view type;      // placeholder in --help, as "N,N,..."
  std::string help;           // text with range and default
  std::string default_value;  // the default as text
  // Names the accepted values if `text` is wrong; else "".
  std::string (*wrong)(std::string_view text);
};

// Texts of options by their keys. An option that is not in it has its default.
using Choices = std::map<std::string, std::string, std::less<>>;

// Inputs of a computation from its caller. Any thread may call the callbacks, never two at once.
struct Means {
  int threads = 0;  // max; 0: as many as the processor runs at a time
  std::function<bool()> should_stop;
  std::function<void(double fraction)> progress;  // 0 to 1
  std::function<std::int64_t()> now_ns;           // processor time of the calling thread
};

// Result of a study. Text and data alone: a program without Dear ImGui can read it.
struct Outcome {
  table::Sheet sheet;  // the table for people
  std::string csv;     // the data for programs: all digits, SI units
  std::string json;
  std::optional<draw::LogFigure> figure;  // present if and only if Study::figure is not ""
  std::string scene = {};                 // a scene file; empty: the study found none
};

// Computes. Nullopt if `should_stop` returned true. Realtime-safe: no.
using Run = std::function<std::optional<Outcome>(const Means& means)>;

struct Study {
  std::string_view name;             // name of the command, and of its items in the window
  std::string_view title;            // title in the window
  bool has_command = true;           // false: the study is a mode of another command
  std::string_view help;             // one line of --help
  std::string_view about;            // text of the window before there is a result
  std::string_view line;             // the subject of one line of the CSV
  std::string_view figure;           // help of --plot; "": the study has no figure
  std::string_view scene_file = {};  // help of --scene-file; "": the study has no scene
  std::string_view instead_of_expect;
  std::vector<Option> options;
  bool of_all_algorithms = false;  // the algorithm in force does not matter
  // Stages of the window, at least one. Each is finer than the one before and replaces its result.
  std::vector<Choices> stages;
  // Checks the scene and computes nothing, so that a command can refuse before it opens its files.
  // Fails for a scene that has no such study. Precondition: no choice is wrong.
  Result<Run> (*plan)(const Scene& scene, const Choices& choices);

  // Precondition: `key` is the key of an option.
  [[nodiscard]] const std::string& chosen(const Choices& choices, std::string_view key) const;
};

}  // namespace hapticwall::study
