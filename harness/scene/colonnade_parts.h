// The repeated parts of the colonnade, in metres, each standing at the origin of its own coordinates.
#pragma once

#include "scene/mesh.h"

namespace vsglbench {

constexpr double kBayWidth = 2.5;       // between the axes of two columns
constexpr double kSpring = 2.7;         // where arches begin: the columns' height
constexpr double kWallThickness = 0.5;  // of the arcade above the columns
constexpr double kTile = 2;             // that a texture repeats over

// Plinth, base mouldings, shaft with entasis, capital and abacus; kSpring high.
Mesh arcade_column(int segments);

// The wall above two columns, from kSpring to `top`, with a round arch and its mouldings: x along the arcade
// (-kBayWidth/2 … kBayWidth/2), z across, middle plane z = 0.
void add_arch(double top, Mesh* wall, Mesh* stone);

// Rail, plinth and turned balusters between two columns.
void add_balustrade(Mesh* stone);

// A drape of cells x cells quads under an arch, in the plane z = 0 but for its folds, which differ by `seed`.
Mesh arch_cloth(int cells, int seed);

}  // namespace vsglbench
