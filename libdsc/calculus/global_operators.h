/// \file
/// Every operator of the calculus as one sparse matrix over the whole mesh.
///
/// A 0-form has a value a vertex id (V). A 1-form has a value a face corner (C): corner c of a face
/// stands for the edge from it to the face's next corner, so an edge has one value in each of its
/// faces, as the per-face construction wants. A vector field has three values a face, rows 3f,
/// 3f+1, 3f+2 (3F): the memory of a 3 × F matrix. Then
///     gradient = sharp · D,   divergence = −Dᵀ M1,   laplacian = divergence · D.
/// These matrices are for composing; where only a product is needed, field_operators.h is faster.
///
/// All of them throw as assemble_laplacian() does and have the same bits for any thread count.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/calculus/options.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

/// M0, V × V, diagonal: each face gives its corners equal parts of its projected area.
SparseMatrix mass0_matrix(const FlatMesh& mesh, const CalculusOptions& options = {},
                          const Context& context = {});
/// M1, C × C, one block a face.
SparseMatrix mass1_matrix(const FlatMesh& mesh, const CalculusOptions& options = {},
                          const Context& context = {});
/// D, C × V: 0-form to 1-form, the difference along each edge. Depends on the corners alone.
SparseMatrix difference_matrix(const FlatMesh& mesh, const Context& context = {});
/// G, 3F × V: 0-form to vector field.
SparseMatrix gradient_matrix(const FlatMesh& mesh, const CalculusOptions& options = {},
                             const Context& context = {});
/// V, C × 3F: vector field to 1-form.
SparseMatrix flat_matrix(const FlatMesh& mesh, const CalculusOptions& options = {},
                         const Context& context = {});
/// U, 3F × C: 1-form to vector field.
SparseMatrix sharp_matrix(const FlatMesh& mesh, const CalculusOptions& options = {},
                          const Context& context = {});
/// Div = −Dᵀ M1, V × C: 1-form to integrated divergence.
SparseMatrix divergence_matrix(const FlatMesh& mesh, const CalculusOptions& options = {},
                               const Context& context = {});
/// L, V × V; see assemble_laplacian(), which gives M0 with it.
SparseMatrix laplacian_matrix(const FlatMesh& mesh, const CalculusOptions& options = {},
                              const Context& context = {});

}  // namespace dsc
