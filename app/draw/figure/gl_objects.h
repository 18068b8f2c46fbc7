// Small owners of OpenGL objects. All need a current context of OpenGL 3.3 or OpenGL ES 3, for
// their whole life.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <utility>

#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::draw {

// A name that OpenGL gave out, and the way to give it back.
template <void (*Release)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;
  ~GlName() {
    if (name_ != 0) Release(name_);
  }
  [[nodiscard]] GLuint get() const { return name_; }

 private:
  GLuint name_ = 0;
};

void release_program(GLuint name);
void release_buffer(GLuint name);
void release_vertex_array(GLuint name);
void release_texture(GLuint name);
void release_renderbuffer(GLuint name);
void release_framebuffer(GLuint name);

// First line of shaders in the present context, which is one of OpenGL ES 3 in a browser.
[[nodiscard]] const char* glsl_version();
// False in OpenGL ES 3: a target of several samples a pixel cannot be copied into another.
[[nodiscard]] bool can_copy_samples();

class GlProgram {
 public:
  // Compiles the embedded shaders of these file names. Fails with the compiler's words.
  [[nodiscard]] static Result<GlProgram> create(std::string_view vertex_file,
                                                std::string_view fragment_file);
  void use() const;
  // All of these set the program in use.
  void set(const char* uniform, const glm::mat4& value) const;
  void set(const char* uniform, const glm::mat3& value) const;
  void set(const char* uniform, const glm::vec4& value) const;
  void set(const char* uniform, const glm::vec3& value) const;
  void set(const char* uniform, const glm::vec2& value) const;
  void set(const char* uniform, float value) const;

 private:
  explicit GlProgram(GLuint name) : name_(name) {}
  GlName<release_program> name_;
};

struct Vertex {
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F};
};

class GlMesh {
 public:
  GlMesh() = default;
  GlMesh(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices);
  void draw() const;

 private:
  GlName<release_vertex_array> array_;
  GlName<release_buffer> vertices_;
  GlName<release_buffer> indices_;
  GLsizei count_ = 0;
};

// A picture to draw into, with depth: smooth edges by several samples a pixel, resolved into one
// texture; or, without further samples, that texture itself.
class GlTarget {
 public:
  // Sizes in pixels, at least 1. `samples` 0 or 1: one. Fails where the driver refuses.
  [[nodiscard]] static Result<GlTarget> create(int width, int height, int samples);

  void bind() const;  // draw here from now on
  // Takes over the colours of a target of the same size and number of samples. Precondition:
  // can_copy_samples().
  void copy_colours(const GlTarget& from) const;
  void resolve() const;  // the texture shows what was drawn; the default framebuffer is bound again
  [[nodiscard]] GLuint texture() const { return texture_.get(); }
  [[nodiscard]] GLuint resolved_framebuffer() const { return resolved_.get(); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  [[nodiscard]] GLuint drawn_framebuffer() const;

  int width_ = 0;
  int height_ = 0;
  GlName<release_texture> texture_;
  GlName<release_framebuffer> resolved_;
  GlName<release_renderbuffer> colour_;
  GlName<release_renderbuffer> depth_;
  GlName<release_framebuffer> drawn_;
};

// The pixels of a framebuffer object, upper row first, opaque. Needs a current context.
[[nodiscard]] file::Picture read_pixels(GLuint framebuffer, int width, int height);

}  // namespace hapticwall::draw
