/// \file
/// How surfels are linked, and what a degree of freedom stands for.
#pragma once

namespace dsc {

/// Which two of the four surfels at a linel with four are linked: the two of the same inner voxel
/// (interior, (6,18)) or the two of the same outer voxel (exterior, (18,6)).
enum class Adjacency { interior, exterior };

/// What one vertex id stands for: a pointel (the paper's choice) or an umbrella.
enum class Glue { pointel, umbrella };

}  // namespace dsc
