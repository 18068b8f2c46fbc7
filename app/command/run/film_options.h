// The options of a film: --frames and those that need it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/draw/film/film.h"
#include "core/result.h"

namespace hapticwall::command {

// Numbers are texts, so that NaN and words get the message of their option.
struct FilmOptions {
  std::string slow;
  std::string from;
  std::string to;
  std::string rate;
  std::string size;
  std::string look;
  std::string beside;  // a second algorithm; empty: none
};

// `folder`: of --frames.
void add_film_options(CLI::App& app, std::string& folder, FilmOptions& options);

// Max pictures of a film: ten minutes at 60 in a second.
inline constexpr double kMaxPictures = 36'000;

// The film of a session of this length. Without `folder`, fails if another option of a film is
// given.
[[nodiscard]] Result<draw::FilmSettings> film_settings(const std::string& folder,
                                                       const FilmOptions& options,
                                                       double duration_s);

}  // namespace hapticwall::command
