#include "app/draw/figure/shapes.h"

#include <imgui_internal.h>

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "app/draw/figure/glyphs.h"

namespace hapticwall::draw {
namespace {

constexpr float kExact = 0.02F;  // pixels; coordinates are floats

glm::vec2 place_of(const ImDrawVert& corner) { return {corner.pos.x, corner.pos.y}; }
bool same(glm::vec2 a, glm::vec2 b) { return glm::distance(a, b) < kExact; }

// A segment of a line, drawn as a rectangle.
struct Segment {
  glm::vec2 from;
  glm::vec2 to;
  float weight;
};

// nullopt for another shape, and for an area.
std::optional<Segment> segment_of(std::span<const ImDrawVert> corners) {
  constexpr float kMaxWeight = 8.0F;
  if (corners.size() != 4) return std::nullopt;
  const glm::vec2 from = place_of(corners[0]);
  const glm::vec2 along = place_of(corners[1]) - from;
  const glm::vec2 across = place_of(corners[3]) - from;
  const float weight = glm::length(across);
  const bool is_rectangle = same(from + along + across, place_of(corners[2])) &&
                            std::abs(glm::dot(along, across)) < kExact * glm::length(along);
  if (weight > kMaxWeight || !is_rectangle) return std::nullopt;
  const glm::vec2 start = from + 0.5F * across;
  return Segment{start, start + along, weight};
}

// Draws the shapes of a frame. Segments that follow each other become one line.
class ShapeWriter {
 public:
  ShapeWriter(cairo_t* page, FontFaces& faces, std::vector<file::DrawnText>* texts)
      : page_(page), text_(page, faces, texts) {
    cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
  }

  // False for a texture that is no glyph.
  [[nodiscard]] bool draw(const ImDrawList& list, const ImDrawCmd& command);

 private:
  [[nodiscard]] bool draw_shape(std::span<const ImDrawVert> corners);
  void add(const Segment& segment, ImU32 colour);
  void fill(std::span<const ImDrawVert> corners);
  void flush_line();

  cairo_t* page_;
  TextRuns text_;
  std::vector<glm::vec2> line_;
  float weight_ = 0.0F;
  ImU32 colour_ = 0;
};

// Triangles around their first corner are one shape, from `at` on. Returns the place behind it.
unsigned take_fan(const ImDrawList& list, const ImDrawCmd& command, unsigned at,
                  std::vector<ImDrawVert>& corners) {
  const auto index = [&](unsigned i) { return list.IdxBuffer[static_cast<int>(i)]; };
  const auto vertex = [&](unsigned i) {
    return list.VtxBuffer[static_cast<int>(command.VtxOffset + index(i))];
  };
  const unsigned end = command.IdxOffset + command.ElemCount;
  corners.assign({vertex(at), vertex(at + 1), vertex(at + 2)});
  unsigned next = at + 3;
  for (; next < end && index(next) == index(at) && index(next + 1) == index(next - 1); next += 3)
    corners.push_back(vertex(next + 2));
  return next;
}

bool ShapeWriter::draw(const ImDrawList& list, const ImDrawCmd& command) {
  const ImRect clip(command.ClipRect);
  cairo_save(page_);
  cairo_rectangle(page_, clip.Min.x, clip.Min.y, clip.GetWidth(), clip.GetHeight());
  cairo_clip(page_);
  text_.clip({clip.Min.x, clip.Min.y, clip.GetWidth(), clip.GetHeight()});
  std::vector<ImDrawVert> corners;
  bool known = true;
  for (unsigned at = command.IdxOffset; known && at < command.IdxOffset + command.ElemCount;) {
    at = take_fan(list, command, at, corners);
    known = draw_shape(corners);
  }
  flush_line();
  text_.flush();
  cairo_restore(page_);
  return known;
}

bool ShapeWriter::draw_shape(std::span<const ImDrawVert> corners) {
  // For upright text: a blank has no area.
  const bool is_blank = place_of(corners.front()) == place_of(corners[2]);
  if (is_blank || (corners.front().col & IM_COL32_A_MASK) == 0) return true;
  const ImVec2 plain = ImGui::GetFontTexUvWhitePixel();
  if (corners.front().uv.x != plain.x || corners.front().uv.y != plain.y) {
    flush_line();
    return text_.add(corners);
  }
  text_.flush();
  if (const auto segment = segment_of(corners)) {
    add(*segment, corners.front().col);
  } else {
    flush_line();
    fill(corners);
  }
  return true;
}

void ShapeWriter::add(const Segment& segment, ImU32 colour) {
  const bool goes_on = !line_.empty() && same(line_.back(), segment.from) && colour == colour_ &&
                       std::abs(segment.weight - weight_) < kExact;
  if (!goes_on) {
    flush_line();
    line_ = {segment.from};
    weight_ = segment.weight;
    colour_ = colour;
  }
  line_.push_back(segment.to);
}

void ShapeWriter::fill(std::span<const ImDrawVert> corners) {
  for (const ImDrawVert& corner : corners) cairo_line_to(page_, corner.pos.x, corner.pos.y);
  cairo_close_path(page_);
  set_colour(page_, corners.front().col);
  cairo_fill(page_);
}

void ShapeWriter::flush_line() {
  if (line_.empty()) return;
  for (const glm::vec2 point : line_) cairo_line_to(page_, point.x, point.y);
  set_colour(page_, colour_);
  cairo_set_line_width(page_, weight_);
  cairo_stroke(page_);
  line_.clear();
}

}  // namespace

Failure draw_shapes(const ImDrawData& frame, FontFaces& faces, std::vector<file::DrawnText>* texts,
                    cairo_t* page) {
  ShapeWriter writer(page, faces, texts);
  for (const ImDrawList* list : frame.CmdLists) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      if (!writer.draw(*list, command))
        return file_error("the figure has a texture that is no glyph; report this as an error");
    }
  }
  return {};
}

Result<std::shared_ptr<const file::Shapes>> record_shapes(const ImDrawData& frame) {
  const cairo_rectangle_t extents{0.0, 0.0, frame.DisplaySize.x, frame.DisplaySize.y};
  const auto shapes = std::make_shared<file::Shapes>(extents);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(shapes->surface),
                                                                cairo_destroy);
  FontFaces faces;
  if (Failure failed = draw_shapes(frame, faces, &shapes->texts, page.get())) return *failed;
  return std::shared_ptr<const file::Shapes>(shapes);
}

}  // namespace hapticwall::draw
