// OpenGL ES 3.0, which WebGL 2 is, under the name of the desktop's loader.
#pragma once

#include <GLES3/gl3.h>
