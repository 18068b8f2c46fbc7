#include "app/draw/film/film_card.h"

#include "app/draw/wall/wall_strip.h"
#include "app/draw/wall/wall_trail.h"

namespace hapticwall::draw {
namespace {

constexpr float kCardPadding = 16.0F;  // pixels at scale 1
constexpr float kCardGap = 12.0F;
constexpr float kCardHeadHeight = 142.0F;   // of name, verdict and detail
constexpr float kCardWallShare = 0.54F;     // of the height below the head
constexpr float kCardContactShare = 0.42F;  // of the width

void draw_card_head(const FilmPen& pen, ImVec2 corner, const FilmMoment& moment) {
  const auto below = [&](float pixels) { return ImVec2(corner.x, corner.y + pixels * pen.scale); };
  ImFont* strong = pen.theme.fonts.strong;
  const VerdictWords words = verdict_words(moment.tail);
  pen.text(corner, moment.now.name, kNameFontSize, Tone::kText, strong);
  pen.text(below(26.0F), words.word, kVerdictFontSize, words.tone, strong);
  pen.text(below(102.0F), words.numbers, kDetailFontSize, Tone::kText, strong);
}

void draw_card_contact(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment,
                       Trace& trail) {
  const Extremes& shown = moment.scales.contact_m;
  const Strip strip{box.from, box.to, 0.5 * (shown.minimum + shown.maximum),
                    shown.maximum - shown.minimum};
  pen.list->AddRectFilled(box.from, box.to, pen.theme.packed(Tone::kBackground));
  pen.list->PushClipRect(box.from, box.to, true);
  const FontScope font(pen.theme.fonts.text, kSmallFontSize);
  const StripContent content{.picture = &moment.picture,
                             .face_m = moment.scales.face_m,
                             .measured_m = moment.measured_m,
                             .encoder_m = {},
                             .detailed = false};
  draw_strip(pen.theme, strip, content, pen.list);
  draw_trail(pen.theme, strip, {moment.run.history, moment.time_s, false}, trail, pen.list);
  pen.text({box.from.x + 10.0F * pen.scale, box.from.y + 8.0F * pen.scale}, "magnified",
           kNoteFontSize, Tone::kMuted);
  pen.list->PopClipRect();
}

}  // namespace

void draw_film_card(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment,
                    FilmScratch& scratch) {
  const float padding = kCardPadding * pen.scale;
  const float gap = kCardGap * pen.scale;
  pen.panel(box, Tone::kPanel);
  pen.frame(box, pen.theme.packed(moment.tone()), 2.5F);
  const PixelBox inside{{box.from.x + padding, box.from.y + padding},
                        {box.to.x - padding, box.to.y - padding}};
  draw_card_head(pen, inside.from, moment);
  const float top = inside.from.y + kCardHeadHeight * pen.scale;
  const float middle = top + kCardWallShare * (inside.to.y - top);
  const float contact = inside.to.x - kCardContactShare * (inside.to.x - inside.from.x);
  draw_film_wall(pen, in_whole_pixels({{inside.from.x, top}, {contact - gap, middle}}), moment);
  draw_card_contact(pen, in_whole_pixels({{contact, top}, {inside.to.x, middle}}), moment,
                    scratch.trail);
  const float half = 0.5F * (inside.from.x + inside.to.x);
  const float plots = middle + gap;
  draw_film_plot(pen, {{inside.from.x, plots}, {half - 0.5F * gap, inside.to.y}}, moment,
                 FilmPlot::kPosition, scratch.plot);
  draw_film_plot(pen, {{half + 0.5F * gap, plots}, inside.to}, moment, FilmPlot::kForce,
                 scratch.plot);
}

}  // namespace hapticwall::draw
