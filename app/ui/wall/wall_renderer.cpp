#include "app/ui/wall/wall_renderer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "app/ui/wall/wall_floor.h"
#include "app/ui/wall/wall_solids.h"

namespace hapticwall::ui {
namespace {

constexpr int kSamplesPerPixel = 4;
constexpr int kStillCalls = 10;         // calls without change before a draft is refined
constexpr double kStepsPerPixel = 8.0;  // precision of the places that move
constexpr double kForceSteps = 2000.0;  // steps of force in the full scale
constexpr double kMinScaleN = 1e-9;
constexpr double kShades = 200.0;  // steps of the tint

double in_steps(double value, double step) { return step * std::round(value / step); }
void in_steps(Reach& reach, int axis, double step) {
  reach.below[axis] = in_steps(reach.below[axis], step);
  reach.above[axis] = in_steps(reach.above[axis], step);
}

bool same_colours(const draw::Theme& a, const draw::Theme& b) {
  return std::equal(a.colours.begin(), a.colours.end(), b.colours.begin(),
                    [](const ImVec4& one, const ImVec4& other) {
                      return one.x == other.x && one.y == other.y && one.z == other.z;
                    });
}

// Drawn by the processor: every pixel costs.
bool draws_by_software() {
  const GLubyte* name = glGetString(GL_RENDERER);
  if (name == nullptr) return false;
  const std::string_view text(reinterpret_cast<const char*>(name));
  return text.find("llvmpipe") != std::string_view::npos ||
         text.find("softpipe") != std::string_view::npos;
}

// Everything that a picture depends on.
struct Drawn {
  WallPicture picture;
  glm::mat4 view_projection{0.0F};
  std::array<ImVec4, draw::kToneCount> colours{};
  int width = 0;
  int height = 0;

  [[nodiscard]] bool same_ground(const Drawn& other) const {
    return view_projection == other.view_projection && width == other.width &&
           height == other.height && same_colours({colours, {}}, {other.colours, {}}) &&
           picture.two_axes == other.picture.two_axes && picture.walls == other.picture.walls;
  }
  [[nodiscard]] bool same_as(const Drawn& other) const {
    return same_ground(other) && picture == other.picture;
  }
};

// What all pictures are drawn with.
struct WallShaders {
  WallFloor floor;
  WallSolids solids;
};

class Renderer final : public WallRenderer {
 public:
  explicit Renderer(std::shared_ptr<const WallShaders> shaders)
      : shaders_(std::move(shaders)), drafts_first_(draws_by_software()) {}

  [[nodiscard]] std::unique_ptr<WallRenderer> another() const override {
    return std::make_unique<Renderer>(shaders_);
  }

  GLuint draw(const WallPicture& picture, const WallCamera& camera, const draw::Theme& theme,
              int width, int height) override;
  void set_draft_share(float share) override {
    if (share == draft_share_) return;
    draft_share_ = share;
    last_ground_.reset();  // the picture has another size
  }
  [[nodiscard]] bool refined() const override { return refined_; }
  [[nodiscard]] std::uint64_t times_drawn() const override { return times_drawn_; }
  [[nodiscard]] GLuint framebuffer() const override {
    const std::optional<draw::GlTarget>& target = refined_ ? fine_ : draft_;
    return target ? target->resolved_framebuffer() : 0;
  }

 private:
  [[nodiscard]] bool needs_drawing(const Drawn& wanted);
  static bool ensure(std::optional<draw::GlTarget>& target, int width, int height, int samples);
  [[nodiscard]] bool keep_ground(const WallView& view, int width, int height, int samples);
  bool draw_draft(const WallView& view);
  bool draw_fine(const WallView& view);
  void draw_solids(const WallView& view) const;

  std::shared_ptr<const WallShaders> shaders_;
  bool drafts_first_;
  float draft_share_ = 1.0F;
  std::optional<draw::GlTarget> ground_;  // the floor of the last draft, which seldom changes
  std::optional<draw::GlTarget> draft_;
  std::optional<draw::GlTarget> fine_;
  Drawn last_;
  std::optional<Drawn> last_ground_;
  bool valid_ = false;
  bool refined_ = false;
  int calls_without_change_ = 0;
  std::uint64_t times_drawn_ = 0;
};

bool Renderer::ensure(std::optional<draw::GlTarget>& target, int width, int height, int samples) {
  if (target && target->width() == width && target->height() == height) return true;
  target.reset();
  Result<draw::GlTarget> created = draw::GlTarget::create(width, height, samples);
  if (created) target = std::move(*created);
  return created.ok();
}

// True if the picture must be drawn. Also counts how long it has stayed the same.
bool Renderer::needs_drawing(const Drawn& wanted) {
  if (!valid_ || !wanted.same_as(last_)) {
    calls_without_change_ = 0;
    return true;
  }
  if (refined_) return false;
  ++calls_without_change_;
  return calls_without_change_ >= kStillCalls;
}

void Renderer::draw_solids(const WallView& view) const {
  shaders_->floor.draw_shadow(view);
  glClear(GL_DEPTH_BUFFER_BIT);
  shaders_->solids.draw(view);
}

// The floor is the costly part of a picture, and seldom changes.
bool Renderer::keep_ground(const WallView& view, int width, int height, int samples) {
  if (last_ground_ && last_ground_->same_ground(last_)) return true;
  last_ground_.reset();
  if (!ensure(ground_, width, height, samples)) return false;
  ground_->bind();
  shaders_->floor.draw(view, height);
  last_ground_ = last_;
  return true;
}

bool Renderer::draw_draft(const WallView& view) {
  const int width = std::max(1, static_cast<int>(draft_share_ * static_cast<float>(last_.width)));
  const int height = std::max(1, static_cast<int>(draft_share_ * static_cast<float>(last_.height)));
  // Fewer pixels would be blocks without smooth edges.
  const int samples = draft_share_ < 1.0F ? kSamplesPerPixel : 1;
  if (!ensure(draft_, width, height, samples)) return false;
  if (draw::can_copy_samples()) {
    if (!keep_ground(view, width, height, samples)) return false;
    draft_->copy_colours(*ground_);
    draft_->bind();
  } else {
    draft_->bind();
    shaders_->floor.draw(view, height);
  }
  draw_solids(view);
  draft_->resolve();
  return true;
}

bool Renderer::draw_fine(const WallView& view) {
  if (!ensure(fine_, last_.width, last_.height, kSamplesPerPixel)) return false;
  fine_->bind();
  shaders_->floor.draw(view, last_.height);
  draw_solids(view);
  fine_->resolve();
  return true;
}

GLuint Renderer::draw(const WallPicture& picture, const WallCamera& camera,
                      const draw::Theme& theme, int width, int height) {
  const double step_m = 1.0 / (kStepsPerPixel * camera.pixels_per_unit() * camera.units_per_m());
  const Drawn wanted{in_visible_steps(picture, step_m), camera.view_projection(), theme.colours,
                     width, height};
  if (needs_drawing(wanted)) {
    last_ = wanted;
    refined_ = !(drafts_first_ || draft_share_ < 1.0F) || calls_without_change_ > 0;
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    const WallView view{picture, camera, theme};
    valid_ = refined_ ? draw_fine(view) : draw_draft(view);
    ++times_drawn_;
  }
  if (!valid_) return 0;
  return (refined_ ? fine_ : draft_)->texture();
}

}  // namespace

WallPicture in_visible_steps(const WallPicture& picture, double step_m) {
  WallPicture result = picture;
  const double force_step_n = std::max(picture.full_scale_n, kMinScaleN) / kForceSteps;
  for (int axis = 0; axis < static_cast<int>(kAxisCount); ++axis) {
    result.handle_m[axis] = in_steps(picture.handle_m[axis], step_m);
    in_steps(result.handle_reach_m, axis, step_m);
    in_steps(result.force_reach_n, axis, force_step_n);
    if (picture.hand_m) (*result.hand_m)[axis] = in_steps((*picture.hand_m)[axis], step_m);
    result.force_n[axis] = in_steps(picture.force_n[axis], force_step_n);
  }
  const StiffnessScale scale = stiffness_scale(picture);
  for (ShownStiffness& shown : result.shown) {
    shown.strength = in_steps(shown.strength, 1.0 / kShades);
    const double shade = in_steps(static_cast<double>(scale.share(shown.n_per_m)), 1.0 / kShades);
    shown.n_per_m = shown.strength > 0.0 ? scale.at(shade) : 0.0;
  }
  return result;
}

Result<std::unique_ptr<WallRenderer>> WallRenderer::create() {
  Result<WallFloor> floor = WallFloor::create();
  if (!floor) return floor.error();
  Result<WallSolids> solids = WallSolids::create();
  if (!solids) return solids.error();
  return std::unique_ptr<WallRenderer>(std::make_unique<Renderer>(
      std::make_shared<const WallShaders>(WallShaders{std::move(*floor), std::move(*solids)})));
}

}  // namespace hapticwall::ui
