/// \file
/// Results in files: a polygon mesh and the fields on its vertices and faces.
///
/// - `.ply`: binary little-endian; doubles; corner lists of int32; a vector is three properties.
/// - `.vtp`: ParaView's XML PolyData; doubles as base64; a vector is one array of 3 components.
/// - `.csv`: a header line, then x, y, z and the fields, a row per vertex or per face (below).
/// - `.off`, `.obj`: text; the mesh only.
/// - `.stl`: binary; the mesh only, as triangles of floats that repeat their vertices: a quad is
/// cut
///   along its shorter diagonal, a larger face into a fan from its first corner.
/// - `.om`: OpenMesh's own; doubles; a scalar or a vector is a persistent property of its name, the
///   face field normal `dsc:normal`. Where faces form no oriented manifold the mesh is split, and
///   the vertex property `dsc:vertex` says how to glue it (split_mesh.h). Read back before it is
///   kept.
///
/// Vertices are vertex ids: the junction vertices of a digital surface stay shared, however its
/// halfedge mesh had to split them. Every double is written in full but in .stl: text uses the
/// shortest form that reads back to the same bits. In .vtp the components of a vector carry its
/// parts' names. An infinite value (a distance that no source reaches) is IEEE infinity in .ply and
/// .vtp and `inf` in .csv; NaN is refused.
///
/// A .csv file holds one kind of row. It is that of the first field: per vertex with the vertex's
/// position, or per face with the mean of the face's corners. Fields of the other kind are left
/// out, and write_result() returns their names, as it does where a form holds the mesh only.
/// Without any field the rows are the vertices.
///
/// The path `ply:-`, `csv:-` and so on is standard output.
/// Files are written beside their target, flushed and renamed: a failure leaves what was there.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/flat_mesh.h"

#include <span>
#include <string>
#include <vector>

namespace dsc {

/// What a field has one value for.
enum class FieldOn {
  vertex,  ///< a value per vertex id
  face,    ///< a value per face
};

/// A named scalar or vector per vertex or per face. It does not own its values.
struct Field {
  std::string name;                ///< of the array in .vtp: `distance`, `normal`, `gradient`
  std::vector<std::string> parts;  ///< of the properties and columns: {distance}, {nx, ny, nz}
  FieldOn on = FieldOn::vertex;    ///< what has a value each
  std::span<const double> values;  ///< one after another, parts.size() each
};

/// A scalar field; `name` is also its one part.
Field scalar_field(std::string name, FieldOn on, std::span<const double> values);
/// The same of a vector, which must outlive the field.
Field scalar_field(std::string name, FieldOn on, const Eigen::VectorXd& values);
/// A field of 3-vectors, with the names of its parts.
Field vector_field(std::string name, std::vector<std::string> parts, FieldOn on, Vec3View values);

/// What a file holds; a view, so that what it looks at must outlive it. Of the mesh, positions,
/// corners and offsets are written; its normals only where a field names them.
struct Result {
  FlatMesh mesh;              ///< what the fields lie on
  std::vector<Field> fields;  ///< in the order of the file
};

/// The endings that write_result() knows, for messages and help: ".ply, .vtp, .csv, …".
std::string result_endings();

/// Refuses a path that write_result() could not serve, before anything is computed.
/// \throws UsageError where the ending is unknown, naming the ones known; OutputError as
/// check_writable() of atomic_file.h.
void check_result_path(const std::string& path);

/// What every writer refuses of a result. \throws UsageError, InputError as write_result().
void check_result(const Result& result, const Context& context = {});

/// Writes `result` in the form that the ending of `path` names (upper or lower case).
/// \return the names of the fields that the form could not hold (see above).
/// \throws UsageError as check_result_path(), or where a field has another number of values than
/// the mesh has vertices or faces, or a name that no format takes (letters, digits and
/// underscores); InputError where a field is NaN, a position not finite or a corner
/// no vertex, naming the first; OutputError where
/// the file cannot be written; Cancelled. In every case the file at `path` is as it was before.
std::vector<std::string> write_result(const std::string& path, const Result& result,
                                      const Context& context = {});

}  // namespace dsc
