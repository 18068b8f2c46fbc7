#include "app/draw/wall/wall_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/draw/plot/plot_labels.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr double kMicrometresPerMetre = 1e6;
constexpr float kPieceHeight = 4.0F;    // pixels of a wall that gives way
constexpr float kDentWidth = 0.16F;     // share of the strip's height
constexpr float kTickShare = 0.08F;     // length of an encoder tick, of the strip's height
constexpr double kClosestCounts = 3.0;  // pixels; closer ones are not drawn
constexpr double kBarPixels = 110.0;
constexpr float kWallAlpha = 0.42F;
constexpr float kSweptAlpha = 0.34F;
constexpr float kHandleAlpha = 0.80F;

ImU32 packed(const ImVec4& colour, float alpha) {
  return ImGui::ColorConvertFloat4ToU32(with_alpha(colour, alpha));
}

// Everything that draws a strip.
struct Brush {
  const Theme& theme;
  const Strip& strip;
  const StripContent& content;
  ImDrawList* list;
  float line = ImGui::GetFontSize();

  // The width of a line on a screen of many pixels per inch.
  [[nodiscard]] float pixels(float usual) const { return usual * line / kSmallFontSize; }
  void text(ImVec2 place, Tone tone, const std::string& words) const {
    list->AddText(place, theme.packed(tone), words.c_str());
  }
  void upright_line(float x, float from_y, float to_y, ImU32 colour, float width = 1.0F) const {
    list->AddLine(ImVec2(x, from_y), ImVec2(x, to_y), colour, width);
  }
};

// How much of the handle's depth a face takes over at this level.
float dent_share(const Strip& strip, float level) {
  const float away = (level - strip.handle_level()) / (kDentWidth * strip.height());
  return std::exp(-0.5F * away * away);
}

// Draws from one face to the next, or to the right edge. Faces are bent only near the handle.
void draw_layer(const Brush& brush, double face_m, const double* next_m, ImU32 fill, ImU32 edge) {
  const Strip& strip = brush.strip;
  const double tip_m = brush.content.picture->handle_m.x;
  const auto x_at = [&](double at_m, float level) {
    const double bent_m = std::max(0.0, tip_m - at_m);
    return strip.x_of(at_m + static_cast<double>(dent_share(strip, level)) * bent_m);
  };
  const auto end_at = [&](float level) { return next_m ? x_at(*next_m, level) : strip.to.x; };
  // Pieces without smooth edges, which would show as seams; the line along the face is smooth.
  const ImDrawListFlags flags = brush.list->Flags;
  brush.list->Flags &= ~ImDrawListFlags_AntiAliasedFill;
  const int pieces =
      static_cast<int>(std::ceil((strip.trail_from() - strip.from.y) / kPieceHeight));
  const auto level = [&](int piece) {
    return std::min(strip.from.y + kPieceHeight * static_cast<float>(piece), strip.trail_from());
  };
  for (int piece = 0; piece < pieces; ++piece) {
    const float upper = level(piece);
    const float lower = level(piece + 1);
    const std::array<float, 4> x{x_at(face_m, upper), end_at(upper), end_at(lower),
                                 x_at(face_m, lower)};
    if (x[0] < x[1] || x[3] < x[2]) {
      brush.list->AddQuadFilled(ImVec2(x[0], upper), ImVec2(std::max(x[0], x[1]), upper),
                                ImVec2(std::max(x[2], x[3]), lower), ImVec2(x[3], lower), fill);
    }
  }
  brush.list->Flags = flags;
  for (int piece = 0; piece <= pieces; ++piece)
    brush.list->PathLineTo(ImVec2(x_at(face_m, level(piece)), level(piece)));
  brush.list->PathStroke(edge, brush.pixels(1.5F));
}

void draw_walls(const Brush& brush) {
  const WallPicture& picture = *brush.content.picture;
  const Strip& strip = brush.strip;
  const StiffnessScale scale = stiffness_scale(picture);
  const ShownStiffness& shown = picture.shown.front();
  const ImVec4 displayed = stiffness_colour(brush.theme, scale.share(shown.n_per_m));
  for (std::size_t i = 0; i < picture.walls.size(); ++i) {
    const PictureWall& wall = picture.walls[i];
    if (wall.axis != Axis::kX) continue;
    const bool last = i + 1 == picture.walls.size() || picture.walls[i + 1].axis != Axis::kX;
    const double* next_m = last ? nullptr : &picture.walls[i + 1].face_m;
    const ImVec4 own = stiffness_colour(brush.theme, scale.share(wall.stiffness_n_per_m));
    const ImVec4 tint = mixed(own, displayed, static_cast<float>(shown.strength));
    draw_layer(brush, wall.face_m, next_m, packed(tint, kWallAlpha), packed(own, 0.6F));
    const float face = strip.x_of(wall.face_m);
    const float end = next_m ? strip.x_of(*next_m) : strip.to.x;
    if (end > face) {
      brush.list->AddRectFilled(ImVec2(face, strip.trail_from()), ImVec2(end, strip.to.y),
                                packed(tint, 0.45F * kWallAlpha));
    }
    const ImVec4 edge = picture.verdict ? brush.theme.colour(*picture.verdict) : own;
    brush.upright_line(face, strip.from.y, strip.to.y, packed(edge, 1.0F), brush.pixels(1.5F));
  }
}

// The positions that the encoder can measure, and the range of positions that give the present
// count.
void draw_counts(const Brush& brush) {
  const Strip& strip = brush.strip;
  if (!brush.content.encoder_m) return;
  const double encoder_m = *brush.content.encoder_m;
  const double apart = encoder_m * strip.pixels_per_m();
  if (apart < kClosestCounts) return;
  const float from = strip.x_of(brush.content.measured_m - 0.5 * encoder_m);
  const float to = strip.x_of(brush.content.measured_m + 0.5 * encoder_m);
  brush.list->AddRectFilled(ImVec2(from, strip.from.y), ImVec2(to, strip.to.y),
                            brush.theme.packed(Tone::kPosition, 0.10F));
  const double left_m = strip.middle_m - 0.5 * strip.span_m;
  const auto first = static_cast<long>(std::ceil(left_m / encoder_m));
  const auto last = static_cast<long>(std::floor((left_m + strip.span_m) / encoder_m));
  const std::string widest = fmt::format("{}", last);
  const float text_width = ImGui::CalcTextSize(widest.c_str()).x;
  const bool numbered = apart > 1.6 * static_cast<double>(text_width);
  const float length = kTickShare * strip.height();
  for (long count = first; count <= last; ++count) {
    const float x = strip.x_of(static_cast<double>(count) * encoder_m);
    brush.upright_line(x, strip.from.y, strip.to.y, brush.theme.packed(Tone::kText, 0.09F));
    brush.upright_line(x, strip.to.y - length, strip.to.y, brush.theme.packed(Tone::kMuted),
                       brush.pixels(1.5F));
    if (!numbered) continue;
    const std::string number = fmt::format("{}", count);
    brush.text(ImVec2(x + 3.0F, strip.to.y - 1.05F * brush.line), Tone::kMuted, number);
  }
}

// The handle at the free end of its way since the last frame, its way up to the deepest place as a
// faint surface, a line at its true position, and the outline of where the walls would hold it.
void draw_handle(const Brush& brush) {
  const WallPicture& picture = *brush.content.picture;
  const Strip& strip = brush.strip;
  const float middle = strip.handle_level();
  const float half = Strip::kHandleHalf * strip.height();
  const float outside = strip.from.x - 2.0F * half;
  const float tip = strip.x_of(picture.handle_m.x);
  const auto up_to = [&](float x, float alpha) {
    brush.list->AddRectFilled(ImVec2(outside, middle - half), ImVec2(x, middle + half),
                              brush.theme.packed(Tone::kText, alpha), 0.9F * half,
                              ImDrawFlags_RoundCornersRight);
  };
  const float free_end = strip.x_of(picture.handle_m.x - picture.handle_reach_m.below.x);
  const float deepest = strip.x_of(picture.handle_m.x + picture.handle_reach_m.above.x);
  if (deepest - free_end > 0.5F) up_to(deepest, kSweptAlpha);
  up_to(free_end, kHandleAlpha);
  brush.upright_line(tip, middle - 1.5F * half, strip.trail_from(), brush.theme.packed(Tone::kText),
                     brush.pixels(1.0F));
  if (const auto proxy_m = proxy_of(picture)) {
    const float face = strip.x_of(proxy_m->x);
    brush.list->AddRect(ImVec2(outside, middle - 1.25F * half), ImVec2(face, middle + 1.25F * half),
                        brush.theme.packed(Tone::kAccent), 1.1F * half,
                        ImDrawFlags_RoundCornersRight, brush.pixels(2.0F));
  }
}

void draw_measured(const Brush& brush) {
  const Strip& strip = brush.strip;
  const float x = strip.x_of(brush.content.measured_m);
  const float half = Strip::kHandleHalf * strip.height();
  const float upper = strip.handle_level() - 1.5F * half;
  const ImU32 colour = brush.theme.packed(Tone::kPosition);
  brush.upright_line(x, upper, strip.trail_from(), colour, brush.pixels(2.0F));
  const float size = 0.3F * brush.line;
  brush.list->AddTriangleFilled(ImVec2(x - size, upper - size), ImVec2(x + size, upper - size),
                                ImVec2(x, upper), colour);
}

// Draws words at the top of the strip, in the first row that is free there.
void draw_at_top(const Brush& brush, PlotInk& ink, float x, Tone tone, const std::string& words) {
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  const float top = brush.strip.from.y + 0.25F * brush.line;
  const std::array corners{ImVec2(x, top), ImVec2(x, top + 1.1F * brush.line)};
  const auto place = take_free_place(ink, {brush.strip.from, brush.strip.to}, size, corners);
  if (!place) return;
  brush.list->AddRectFilled(*place, ImVec2(place->x + size.x, place->y + size.y),
                            brush.theme.packed(Tone::kPanel, kBehindText), 3.0F);
  brush.text(*place, tone, words);
}

// The name of a thing beyond an edge of the strip, and where it begins at that edge.
struct Beyond {
  float x;
  std::string words;
};
Beyond beyond(const Brush& brush, double position_m, const std::string& text) {
  const Strip& strip = brush.strip;
  const float edge = 0.5F * brush.line;
  if (position_m <= strip.middle_m) return {strip.from.x + edge, "← " + text};
  std::string words = text + " →";
  const float x = strip.to.x - ImGui::CalcTextSize(words.c_str()).x - edge;
  return {x, std::move(words)};
}

// Draws the name of a thing beyond the strip, with the distance from the face.
void draw_thing_beyond(const Brush& brush, PlotInk& ink, const char* name, double position_m,
                       Tone tone) {
  if (brush.strip.shows(position_m)) return;
  const double depth_m = position_m - brush.content.face_m;
  const Beyond label =
      beyond(brush, position_m,
             fmt::format("{} {:.2f} mm {}", name, std::abs(depth_m) * kMillimetresPerMetre,
                         depth_m >= 0.0 ? "inside" : "outside"));
  draw_at_top(brush, ink, label.x, tone, label.words);
}

void draw_face_beyond(const Brush& brush) {
  const double face_m = brush.content.face_m;
  if (brush.strip.shows(face_m)) return;
  const Beyond label =
      beyond(brush, face_m, "face " + length_text(std::abs(brush.strip.middle_m - face_m)));
  brush.text(ImVec2(label.x, brush.strip.trail_from() - 1.2F * brush.line), Tone::kWall,
             label.words);
}

void draw_true_depth(const Brush& brush, PlotInk& ink) {
  const double depth_m = brush.content.picture->handle_m.x - brush.content.face_m;
  if (depth_m <= 0.0 || !brush.strip.shows(brush.content.picture->handle_m.x)) return;
  draw_at_top(brush, ink, brush.strip.from.x + 0.5F * brush.line, Tone::kText,
              fmt::format("true depth {:.4f} mm", depth_m * kMillimetresPerMetre));
}

void draw_scale_bar(const Brush& brush) {
  const Strip& strip = brush.strip;
  const double length_m =
      scale_bar_m(strip.pixels_per_m(),
                  std::min(kBarPixels, 0.3 * static_cast<double>(strip.to.x - strip.from.x)));
  const auto length = static_cast<float>(length_m * strip.pixels_per_m());
  const ImVec2 start(strip.from.x + 0.7F * brush.line, strip.to.y - 1.9F * brush.line);
  const ImU32 colour = brush.theme.packed(Tone::kText);
  const float tick = 0.25F * brush.line;
  const std::string words = length_text(length_m);
  const float reach = length + brush.line + ImGui::CalcTextSize(words.c_str()).x;
  brush.list->AddRectFilled(ImVec2(start.x - 0.3F * brush.line, start.y - 0.65F * brush.line),
                            ImVec2(start.x + reach, start.y + 0.65F * brush.line),
                            brush.theme.packed(Tone::kBackground, 0.75F), 3.0F);
  brush.list->AddLine(start, ImVec2(start.x + length, start.y), colour, brush.pixels(2.0F));
  for (const float x : {start.x, start.x + length})
    brush.upright_line(x, start.y - tick, start.y + tick, colour, brush.pixels(1.5F));
  brush.text(ImVec2(start.x + length + 0.5F * brush.line, start.y - 0.55F * brush.line),
             Tone::kText, words);
}

void draw_strip_notes(const Brush& brush) {
  const WallPicture& picture = *brush.content.picture;
  PlotInk ink;
  draw_true_depth(brush, ink);
  draw_thing_beyond(brush, ink, "handle", picture.handle_m.x, Tone::kText);
  if (picture.hand_m) draw_thing_beyond(brush, ink, "hand", picture.hand_m->x, Tone::kHand);
  draw_face_beyond(brush);
}

}  // namespace

float Strip::x_of(double position_m) const {
  constexpr double kFarPixels = 1e4;  // safe for floats
  const double x =
      0.5 * static_cast<double>(from.x + to.x) + (position_m - middle_m) * pixels_per_m();
  return static_cast<float>(std::clamp(x, static_cast<double>(from.x) - kFarPixels,
                                       static_cast<double>(to.x) + kFarPixels));
}

bool Strip::shows(double position_m) const {
  return std::abs(position_m - middle_m) <= 0.5 * span_m;
}

void draw_strip(const Theme& theme, const Strip& strip, const StripContent& content,
                ImDrawList* list) {
  const Brush brush{theme, strip, content, list};
  const WallPicture& picture = *content.picture;
  draw_walls(brush);
  if (content.detailed) draw_counts(brush);
  draw_handle(brush);
  if (content.detailed) draw_measured(brush);
  if (picture.hand_m && strip.shows(picture.hand_m->x)) {
    brush.upright_line(strip.x_of(picture.hand_m->x), strip.from.y, strip.to.y,
                       theme.packed(Tone::kHand), 1.5F);
  }
  draw_scale_bar(brush);
  if (content.detailed) draw_strip_notes(brush);
}

double scale_bar_m(double pixels_per_m, double pixels) {
  const double longest_m = pixels / pixels_per_m;
  const double power = std::pow(10.0, std::floor(std::log10(longest_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= longest_m) return step * power;
  }
  return power;
}

std::string length_text(double length_m) {
  constexpr double kSmallM = 0.095e-3;
  if (length_m < kSmallM) return fmt::format("{:.3g} µm", length_m * kMicrometresPerMetre);
  return fmt::format("{:.3g} mm", length_m * kMillimetresPerMetre);
}

}  // namespace hapticwall::draw
