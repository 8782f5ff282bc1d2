#pragma once

#include <CLI/CLI.hpp>

#include "pdc/math/vec3.h"

namespace pdc {

/// The option --view: a name (see viewNamed) or a direction "X,Y,Z", stored as the direction to the viewer.
void addView(CLI::App& command, Vec3d& target);

}  // namespace pdc
