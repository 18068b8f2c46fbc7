#include "app/draw/figure/glyphs.h"

#include <cairo-ft.h>
#include <imgui_internal.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace hapticwall::draw {
namespace {

constexpr std::size_t kCorners = 4;

// A font in memory. Cairo's cache keeps it for longer than the page.
class FontFile {
 public:
  explicit FontFile(const ImFontConfig& source)
      : bytes_(static_cast<const char*>(source.FontData),
               static_cast<std::size_t>(source.FontDataSize)) {
    if (FT_Init_FreeType(&library_) != 0) return;
    FT_New_Memory_Face(library_, reinterpret_cast<const FT_Byte*>(bytes_.data()),
                       source.FontDataSize, 0, &face_);
  }
  FontFile(const FontFile&) = delete;
  FontFile& operator=(const FontFile&) = delete;
  ~FontFile() { FT_Done_FreeType(library_); }
  [[nodiscard]] FT_Face face() const { return face_; }

 private:
  std::string bytes_;
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

constexpr cairo_user_data_key_t kFontFileKey{};

const FontFile& file_of(cairo_font_face_t* face) {
  return *static_cast<FontFile*>(cairo_font_face_get_user_data(face, &kFontFileKey));
}

// nullptr if FreeType cannot read it.
cairo_font_face_t* open_font(const ImFontConfig& source) {
  auto file = std::make_unique<FontFile>(source);
  if (file->face() == nullptr) return nullptr;
  cairo_font_face_t* face = cairo_ft_font_face_create_for_ft_face(file->face(), FT_LOAD_NO_HINTING);
  cairo_font_face_set_user_data(face, &kFontFileKey, file.release(),
                                [](void* owned) { delete static_cast<FontFile*>(owned); });
  return face;
}

// Dear ImGui measures a font by its line height, cairo by its em.
double em_of(const FontFile& file, float size) {
  const FT_Face face = file.face();
  return static_cast<double>(size) * face->units_per_EM / (face->ascender - face->descender);
}

}  // namespace

void set_colour(cairo_t* page, ImU32 colour) {
  const ImVec4 part = ImGui::ColorConvertU32ToFloat4(colour);
  cairo_set_source_rgba(page, part.x, part.y, part.z, part.w);
}

FontFaces::~FontFaces() {
  for (const auto& [font, face] : faces_) cairo_font_face_destroy(face);
}

cairo_font_face_t* FontFaces::of(const ImFont& font) {
  const auto [place, is_new] = faces_.try_emplace(&font, nullptr);
  if (is_new) place->second = open_font(*font.Sources[0]);
  return place->second;
}

TextRuns::TextRuns(cairo_t* page, FontFaces& faces, std::vector<file::DrawnText>* texts)
    : page_(page), faces_(faces), texts_(texts) {
  auto& fonts = ImGui::GetIO().Fonts->Builder->BakedPool;
  for (int i = 0; i < fonts.Size; ++i) {
    for (const ImFontGlyph& glyph : fonts[i].Glyphs)
      if (glyph.Visible != 0) sources_[{glyph.U0, glyph.V0}] = {&fonts[i], &glyph};
  }
}

TextRuns::Place TextRuns::place_of(const Source& source, std::span<const ImDrawVert> quad) {
  const glm::vec2 corner(quad[0].pos.x, quad[0].pos.y);
  const glm::vec2 top = glm::vec2(quad[1].pos.x, quad[1].pos.y) - corner;
  const float scale = glm::length(top) / (source.glyph->X1 - source.glyph->X0);
  const glm::vec2 along = glm::normalize(top);
  const glm::vec2 up(along.y, -along.x);
  const float rise = source.glyph->Y0 - std::round(source.font->Ascent);
  return {source.font,
          quad[0].col,
          scale * source.font->Size,
          along,
          corner - scale * (source.glyph->X0 * along - rise * up),
          scale * source.glyph->AdvanceX};
}

// True if `next` is on the same line, at most one blank apart.
bool TextRuns::goes_on(const Place& next) const {
  constexpr float kClose = 0.5F;     // pixels
  constexpr float kSameWay = 1e-3F;  // radians
  constexpr float kBlank = 0.5F;     // sizes, at most
  const glm::vec2 way = next.pen - last_.pen;
  const float fall = way.y * last_.along.x - way.x * last_.along.y;
  const float gap = gap_before(next);
  return next.font == last_.font && next.colour == last_.colour &&
         glm::distance(next.along, last_.along) < kSameWay &&
         std::abs(next.size - last_.size) < kClose && std::abs(fall) < kClose && gap > -kClose &&
         gap < kBlank * last_.size;
}

// From the end of the last glyph to `next`, in pixels.
float TextRuns::gap_before(const Place& next) const {
  return glm::dot(next.pen - last_.pen, last_.along) - last_.advance;
}

bool TextRuns::add(std::span<const ImDrawVert> quad) {
  if (quad.size() != kCorners) return false;
  const auto source = sources_.find({quad[0].uv.x, quad[0].uv.y});
  if (source == sources_.end()) return false;
  cairo_font_face_t* face = faces_.of(*source->second.font->OwnerFont);
  if (face == nullptr) return false;
  const Place place = place_of(source->second, quad);
  if (!goes_on(place)) flush();
  constexpr float kMinBlank = 0.12F;  // sizes; a blank is no quad
  if (!words_.empty() && gap_before(place) > kMinBlank * last_.size) words_ += ' ';
  last_ = place;
  const unsigned character = source->second.glyph->Codepoint;
  std::array<char, 5> bytes{};
  const int length = ImTextCharToUtf8(bytes.data(), character);
  text_.append(bytes.data(), static_cast<std::size_t>(length));
  words_.append(bytes.data(), static_cast<std::size_t>(length));
  clusters_.push_back({length, 1});
  glyphs_.push_back({FT_Get_Char_Index(file_of(face).face(), character), place.pen.x, place.pen.y});
  return true;
}

// Notes the run that flush() has drawn.
void TextRuns::note(double em) {
  if (texts_ == nullptr) return words_.clear();
  cairo_text_extents_t ink;
  cairo_glyph_extents(page_, glyphs_.data(), static_cast<int>(glyphs_.size()), &ink);
  const cairo_rectangle_t box{glyphs_.front().x + ink.x_bearing, glyphs_.front().y + ink.y_bearing,
                              ink.width, ink.height};
  texts_->push_back({std::move(words_), em, box, clip_});
  words_.clear();
}

void TextRuns::flush() {
  if (glyphs_.empty()) return;
  cairo_font_face_t* face = faces_.of(*last_.font->OwnerFont);
  const double em = em_of(file_of(face), last_.size);
  const glm::dvec2 along = last_.along;
  const cairo_matrix_t matrix{em * along.x, em * along.y, -em * along.y, em * along.x, 0.0, 0.0};
  set_colour(page_, last_.colour);
  cairo_set_font_face(page_, face);
  cairo_set_font_matrix(page_, &matrix);
  cairo_show_text_glyphs(page_, text_.data(), static_cast<int>(text_.size()), glyphs_.data(),
                         static_cast<int>(glyphs_.size()), clusters_.data(),
                         static_cast<int>(clusters_.size()), {});
  note(em);
  text_.clear();
  glyphs_.clear();
  clusters_.clear();
}

}  // namespace hapticwall::draw
