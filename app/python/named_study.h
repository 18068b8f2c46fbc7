// Studies of the command line, by their contract.
#pragma once

#include <nanobind/nanobind.h>

namespace hapticwall::python {

void bind_studies(nanobind::module_& m);

}  // namespace hapticwall::python
