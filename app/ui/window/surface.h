// An application on a GLFW window with a current OpenGL context: its input, and the painting of its
// frames.
#pragma once

struct GLFWwindow;

namespace hapticwall::ui {

class Application;

// ImGui and ImPlot with their backends for the window.
class Gui {
 public:
  explicit Gui(GLFWwindow* window);
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
  ~Gui();
};

// Passes dropped files, keys with their modifiers, and the pointer with its times, to the
// application, after those of Gui.
class InputTarget {
 public:
  InputTarget(GLFWwindow* window, Application& application);
  InputTarget(const InputTarget&) = delete;
  InputTarget& operator=(const InputTarget&) = delete;
  ~InputTarget();

 private:
  GLFWwindow* window_;
};

void draw_frame(Application& application);
void paint_frame(GLFWwindow* window);

}  // namespace hapticwall::ui
