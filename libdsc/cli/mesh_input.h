/// \file
/// A polygon mesh from a file as the input of a command, in place of voxels.
///
/// Its calculus is the projected one where the file has a normal field (PolygonMesh::normals), else
/// the naive one, unless --calculus says otherwise.
#pragma once

#include "libdsc/cli/run.h"
#include "libdsc/io/polygon_mesh.h"

namespace dsc::cli {

/// Whether the input is a mesh file, by its ending.
bool is_mesh_input(const Options& options);

/// \throws UsageError where the command works on voxels only, or an option is about voxels.
void check_mesh_options(const Options& options);

/// Reads the file, decides the calculus (Run::mesh_projected), and notes in the report what it
/// found. \throws InputError where there is no face, or no normals for --calculus projected.
PolygonMesh read_mesh_input(Run& run);

/// The unit normals of the faces themselves, 3 x F: along the vector area. \throws InputError where
/// a face has no area.
Eigen::Matrix3Xd own_normals(const FlatMesh& mesh, const Context& context);

/// Adds the fields of the file, but those whose names `result` has already.
void keep_fields(const PolygonMesh& mesh, Result& result, Run& run);

}  // namespace dsc::cli
