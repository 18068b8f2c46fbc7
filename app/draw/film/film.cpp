#include "app/draw/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/draw/figure/page_painter.h"
#include "app/draw/film/film_card.h"
#include "app/draw/film/film_pen.h"

namespace hapticwall::draw {
namespace {

constexpr float kFilmDesignHeight = 720.0F;     // pixels of a picture at scale 1
constexpr float kFilmDesignCardWidth = 560.0F;  // the narrowest card at scale 1
constexpr float kFilmHeadingHeight = 36.0F;
constexpr float kBetweenCards = 16.0F;

float film_scale(PictureSize size, std::size_t runs) {
  const float card = static_cast<float>(size.width) / static_cast<float>(runs);
  return std::min(static_cast<float>(size.height) / kFilmDesignHeight, card / kFilmDesignCardWidth);
}

// The scene on the left; time and slow motion on the right.
void draw_film_heading(const FilmPen& pen, const PixelBox& box, const Scene& scene,
                       const FilmSettings& settings, double time_s) {
  constexpr const char* kWidestTime = "0000.000 s";
  const std::string slow =
      settings.slow == 1.0 ? std::string() : fmt::format("slow motion 1/{:g}", settings.slow);
  const float time_x = box.to.x - pen.width(kWidestTime, kNoteFontSize, nullptr);
  const float slow_x = time_x - pen.width(slow, kNoteFontSize, nullptr) - 24.0F * pen.scale;
  pen.short_text(box.from, scene.description.empty() ? scene.name : scene.description,
                 kNoteFontSize, Tone::kMuted, slow_x - box.from.x - 24.0F * pen.scale);
  pen.text({slow_x, box.from.y}, slow, kNoteFontSize, Tone::kMuted);
  const std::string time = fmt::format("{:.3f} s", time_s);
  pen.text({box.to.x - pen.width(time, kNoteFontSize, nullptr), box.from.y}, time, kNoteFontSize,
           Tone::kMuted);
}

}  // namespace

double FilmSettings::picture_count() const {
  constexpr double kRounding = 1e-6;  // of a picture
  return std::max(1.0, std::ceil((to_s - from_s) * pictures_per_s() - kRounding));
}

struct Film::Parts {
  std::vector<FilmRun> runs;
  FilmSettings settings;
  float scale = film_scale(settings.size, runs.size());
  FilmScales scales = film_scales(runs, settings.from_s, settings.to_s);
  std::vector<FilmScratch> scratch{runs.size()};
  PagePainter painter{settings.size, scale, settings.look};

  void draw(const Theme& theme, const std::vector<FilmMoment>& moments);
};

void Film::Parts::draw(const Theme& theme, const std::vector<FilmMoment>& moments) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const PixelBox all{corner, {corner.x + free.x, corner.y + free.y}};
  const FilmPen pen{theme, ImGui::GetWindowDrawList(), scale};
  draw_film_heading(pen, all, runs.front().scenes.front().scene, settings, moments.front().time_s);
  const float gap = kBetweenCards * scale;
  const auto count = static_cast<float>(moments.size());
  const float width = (free.x - (count - 1.0F) * gap) / count;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const float left = corner.x + static_cast<float>(i) * (width + gap);
    const PixelBox box{{left, corner.y + kFilmHeadingHeight * scale}, {left + width, all.to.y}};
    ImGui::PushID(static_cast<int>(i));
    draw_film_card(pen, in_whole_pixels(box), moments[i], scratch[i]);
    ImGui::PopID();
  }
}

Film::Film(std::vector<FilmRun> runs, const FilmSettings& settings)
    : parts_(new Parts{.runs = std::move(runs), .settings = settings}) {}

Film::~Film() = default;

std::uint64_t Film::count() const {
  return static_cast<std::uint64_t>(parts_->settings.picture_count());
}

Result<file::Picture> Film::draw(std::uint64_t index) {
  const double apart_s = 1.0 / parts_->settings.pictures_per_s();
  const double time_s = parts_->settings.from_s + static_cast<double>(index) * apart_s;
  std::vector<FilmMoment> moments;
  for (const FilmRun& run : parts_->runs)
    moments.push_back(moment_of(run, parts_->scales, time_s - apart_s, time_s));
  return parts_->painter.paint([&](const Theme& theme) { parts_->draw(theme, moments); });
}

}  // namespace hapticwall::draw
