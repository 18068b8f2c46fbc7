#include "app/draw/figure/gl_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <string>

#include "embedded_shaders.h"

namespace hapticwall::draw {
namespace {

std::optional<std::string_view> shader_text(std::string_view file_name) {
  for (const EmbeddedFile& file : embedded_shaders()) {
    if (file.name == file_name) return file.bytes;
  }
  return std::nullopt;
}

std::string first_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// True for OpenGL ES, as in a browser.
bool is_es() {
  const std::string_view version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  return version.starts_with("OpenGL ES");
}

Result<GLuint> compile(GLenum kind, std::string_view file_name) {
  const auto text = shader_text(file_name);
  if (!text)
    return Error{ErrorKind::kFile, fmt::format("shader '{}' is not in the program", file_name)};
  const GLuint shader = glCreateShader(kind);
  const std::string whole =
      fmt::format("{}\nprecision highp float;{}", glsl_version(), text->substr(text->find('\n')));
  const GLchar* bytes = whole.data();
  const auto length = static_cast<GLint>(whole.size());
  glShaderSource(shader, 1, &bytes, &length);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::array<GLchar, 512> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteShader(shader);
  return Error{ErrorKind::kFile,
               fmt::format("OpenGL refuses shader '{}': {}", file_name, first_line(log.data()))};
}

GlName<release_framebuffer> new_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  return GlName<release_framebuffer>(name);
}

GlName<release_renderbuffer> new_renderbuffer(GLenum format, int width, int height, int samples) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  return GlName<release_renderbuffer>(name);
}

GlName<release_texture> new_texture(int width, int height) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return GlName<release_texture>(name);
}

GlName<release_buffer> new_buffer(GLenum target, const void* data, std::size_t bytes) {
  GLuint name = 0;
  glGenBuffers(1, &name);
  glBindBuffer(target, name);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  return GlName<release_buffer>(name);
}

}  // namespace

const char* glsl_version() { return is_es() ? "#version 300 es" : "#version 330 core"; }

bool can_copy_samples() { return !is_es(); }

void release_program(GLuint name) { glDeleteProgram(name); }
void release_buffer(GLuint name) { glDeleteBuffers(1, &name); }
void release_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
void release_texture(GLuint name) { glDeleteTextures(1, &name); }
void release_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
void release_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }

Result<GlProgram> GlProgram::create(std::string_view vertex_file, std::string_view fragment_file) {
  const Result<GLuint> vertex = compile(GL_VERTEX_SHADER, vertex_file);
  if (!vertex) return vertex.error();
  const Result<GLuint> fragment = compile(GL_FRAGMENT_SHADER, fragment_file);
  if (!fragment) {
    glDeleteShader(*vertex);
    return fragment.error();
  }
  GlProgram program(glCreateProgram());
  const GLuint name = program.name_.get();
  glAttachShader(name, *vertex);
  glAttachShader(name, *fragment);
  glLinkProgram(name);
  glDeleteShader(*vertex);
  glDeleteShader(*fragment);
  GLint linked = GL_FALSE;
  glGetProgramiv(name, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  std::array<GLchar, 512> log{};
  glGetProgramInfoLog(name, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return Error{ErrorKind::kFile, fmt::format("OpenGL cannot link '{}' and '{}': {}", vertex_file,
                                             fragment_file, first_line(log.data()))};
}

void GlProgram::use() const { glUseProgram(name_.get()); }
void GlProgram::set(const char* uniform, const glm::mat4& value) const {
  glUniformMatrix4fv(glGetUniformLocation(name_.get(), uniform), 1, GL_FALSE,
                     glm::value_ptr(value));
}
void GlProgram::set(const char* uniform, const glm::mat3& value) const {
  glUniformMatrix3fv(glGetUniformLocation(name_.get(), uniform), 1, GL_FALSE,
                     glm::value_ptr(value));
}
void GlProgram::set(const char* uniform, const glm::vec4& value) const {
  glUniform4fv(glGetUniformLocation(name_.get(), uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const char* uniform, const glm::vec3& value) const {
  glUniform3fv(glGetUniformLocation(name_.get(), uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const char* uniform, const glm::vec2& value) const {
  glUniform2fv(glGetUniformLocation(name_.get(), uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const char* uniform, float value) const {
  glUniform1f(glGetUniformLocation(name_.get(), uniform), value);
}

GlMesh::GlMesh(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices)
    : count_(static_cast<GLsizei>(indices.size())) {
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  array_ = GlName<release_vertex_array>(array);
  glBindVertexArray(array);
  vertices_ = new_buffer(GL_ARRAY_BUFFER, vertices.data(), vertices.size_bytes());
  indices_ = new_buffer(GL_ELEMENT_ARRAY_BUFFER, indices.data(), indices.size_bytes());
  const std::array<std::size_t, 2> offsets{offsetof(Vertex, position), offsetof(Vertex, normal)};
  for (GLuint attribute = 0; attribute < offsets.size(); ++attribute) {
    glEnableVertexAttribArray(attribute);
    // OpenGL takes an offset in the shape of a pointer.
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* offset = reinterpret_cast<const void*>(offsets[attribute]);
    glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset);
  }
  glBindVertexArray(0);
}

void GlMesh::draw() const {
  glBindVertexArray(array_.get());
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
}

Result<GlTarget> GlTarget::create(int width, int height, int samples) {
  GLint supported = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &supported);
  samples = std::min(samples, static_cast<int>(supported));
  GlTarget target;
  target.width_ = width;
  target.height_ = height;
  target.texture_ = new_texture(width, height);
  target.resolved_ = new_framebuffer();
  const bool separate = samples > 1;
  target.depth_ = new_renderbuffer(GL_DEPTH_COMPONENT24, width, height, separate ? samples : 0);
  glBindFramebuffer(GL_FRAMEBUFFER, target.resolved_.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture_.get(),
                         0);
  bool complete = true;
  if (separate) {
    complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    target.drawn_ = new_framebuffer();
    target.colour_ = new_renderbuffer(GL_RGBA8, width, height, samples);
    glBindFramebuffer(GL_FRAMEBUFFER, target.drawn_.get());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              target.colour_.get());
  }
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                            target.depth_.get());
  complete = complete && glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (complete) return target;
  return Error{ErrorKind::kFile,
               fmt::format("OpenGL refuses a picture of {}x{} pixels", width, height)};
}

GLuint GlTarget::drawn_framebuffer() const {
  return drawn_.get() != 0 ? drawn_.get() : resolved_.get();
}

void GlTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_framebuffer());
  glViewport(0, 0, width_, height_);
}

void GlTarget::copy_colours(const GlTarget& from) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.drawn_framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, drawn_framebuffer());
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_framebuffer());
}

void GlTarget::resolve() const {
  if (drawn_.get() != 0) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.get());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.get());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

file::Picture read_pixels(GLuint framebuffer, int width, int height) {
  constexpr std::size_t kBytesPerPixel = 4;
  file::Picture picture{width, height, {}};
  const std::size_t row_bytes = static_cast<std::size_t>(width) * kBytesPerPixel;
  std::vector<std::uint8_t> upside_down(row_bytes * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  picture.rgba.reserve(upside_down.size());
  for (int row = height - 1; row >= 0; --row) {
    const auto start = upside_down.begin() + static_cast<std::ptrdiff_t>(row_bytes) * row;
    picture.rgba.insert(picture.rgba.end(), start, start + static_cast<std::ptrdiff_t>(row_bytes));
  }
  constexpr std::size_t kAlpha = 3;
  for (std::size_t i = kAlpha; i < picture.rgba.size(); i += kBytesPerPixel) picture.rgba[i] = 255;
  return picture;
}

}  // namespace hapticwall::draw
