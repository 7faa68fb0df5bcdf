/// \file
/// How surfels are linked, and what a degree of freedom stands for.
#pragma once

namespace dsc {

/// Which two of the four surfels at a linel with four are linked.
enum class Adjacency {
  interior,  ///< the two of the same inner voxel: (6,18)
  exterior,  ///< the two of the same outer voxel: (18,6)
};

/// What one vertex id stands for.
enum class Glue {
  pointel,   ///< all surfels at a pointel share it (the paper's choice)
  umbrella,  ///< each umbrella at a pointel has its own
};

}  // namespace dsc
