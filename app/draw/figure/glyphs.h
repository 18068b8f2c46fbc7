// Text of a frame of Dear ImGui: from the quads of its glyphs back to characters of a font.
#pragma once

#include <cairo.h>
#include <imgui.h>

#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/draw/figure/shapes.h"

namespace hapticwall::draw {

void set_colour(cairo_t* page, ImU32 colour);

// The fonts of one context of Dear ImGui as fonts of cairo, for one page or for many.
class FontFaces {
 public:
  FontFaces() = default;
  FontFaces(const FontFaces&) = delete;
  FontFaces& operator=(const FontFaces&) = delete;
  ~FontFaces();

  // nullptr if FreeType cannot read the font.
  [[nodiscard]] cairo_font_face_t* of(const ImFont& font);

 private:
  std::map<const ImFont*, cairo_font_face_t*> faces_;
};

// The glyphs of one line of text in one font, size and colour become one piece of text.
class TextRuns {
 public:
  // `page` and, unless null, `texts` receive the text. Fonts are those of the current context of
  // Dear ImGui, to which `faces` belong.
  TextRuns(cairo_t* page, FontFaces& faces, std::vector<file::DrawnText>* texts);

  // `quad`: from the upper left corner along the line, then down. False if it is no glyph.
  [[nodiscard]] bool add(std::span<const ImDrawVert> quad);
  void flush();
  // The clip of the following text, for `texts`. Precondition: flush() was called.
  void clip(const cairo_rectangle_t& clip) { clip_ = clip; }

 private:
  struct Source {
    const ImFontBaked* font;
    const ImFontGlyph* glyph;
  };
  // The last glyph.
  struct Place {
    const ImFontBaked* font = nullptr;
    ImU32 colour = 0;
    float size = 0.0F;      // pixels a line
    glm::vec2 along{0.0F};  // direction of the text, of length 1
    glm::vec2 pen{0.0F};    // on the baseline, before the glyph
    float advance = 0.0F;
  };

  [[nodiscard]] static Place place_of(const Source& source, std::span<const ImDrawVert> quad);
  [[nodiscard]] bool goes_on(const Place& next) const;
  [[nodiscard]] float gap_before(const Place& next) const;
  void note(double em);

  cairo_t* page_;
  FontFaces& faces_;
  std::vector<file::DrawnText>* texts_;
  cairo_rectangle_t clip_{};
  // Sources by the corner of the glyph in the texture.
  std::map<std::pair<float, float>, Source> sources_;
  Place last_;
  std::string text_;   // without the blanks, which are no glyphs
  std::string words_;  // with blanks
  std::vector<cairo_glyph_t> glyphs_;
  std::vector<cairo_text_cluster_t> clusters_;
};

}  // namespace hapticwall::draw
