// A film of runs, picture by picture, drawn without a display and OpenGL: verdict, wall, magnified
// contact, position and force.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/draw/figure/page_painter.h"
#include "app/draw/film/film_moment.h"
#include "app/draw/plot/theme.h"
#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::draw {

// Pictures of a film in pixels, and its shortest side for readable text.
inline constexpr PictureSize kFilmSize{1280, 720};
inline constexpr int kMinFilmSide = 240;
inline constexpr int kMaxFilmSide = 4320;

struct FilmSettings {
  PictureSize size = kFilmSize;
  Look look = Look::kScreen;
  double rate_hz = 60.0;  // pictures in a second of the film
  double slow = 1.0;      // seconds of the film for one of the session
  double from_s = 0.0;    // of the session
  double to_s = 0.0;      // of the session; later than from_s

  // Pictures in a second of the session.
  [[nodiscard]] double pictures_per_s() const { return rate_hz * slow; }
  // At least 1; the last picture is earlier than to_s.
  [[nodiscard]] double picture_count() const;
};

class Film {
 public:
  // The runs stand side by side, with the same scales. Precondition: there is one, and each has a
  // sample. Realtime-safe: no.
  Film(std::vector<FilmRun> runs, const FilmSettings& settings);
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  ~Film();

  [[nodiscard]] std::uint64_t count() const;
  // The pictures have the same bytes if they are drawn in order. Fails like draw_page().
  [[nodiscard]] Result<file::Picture> draw(std::uint64_t index);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hapticwall::draw
