// Lists for scripts: the keys of scenes, the built-in scenes, the version.
#pragma once

#include <nanobind/nanobind.h>

namespace hapticwall::python {

void bind_listing(nanobind::module_& m);

}  // namespace hapticwall::python
