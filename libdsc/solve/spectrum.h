/// \file
/// The lowest part of the spectrum of A x = μ M x: frequencies and harmonics of a surface, where A
/// = -L and M = M0.
///
/// Lanczos on (A - σM)⁻¹ M with σ below the spectrum finds the lowest eigenvalues first, but from
/// one vector it finds one copy of a multiple eigenvalue, and on symmetric shapes most are
/// multiple. So the number of eigenvalues below the last one is counted by the inertia of A - τM;
/// while some are missing, Lanczos starts again on what is orthogonal to those found. What is
/// returned is complete: no eigenvalue below the last one is left out.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

namespace dsc {

/// How many eigenvalues, and how exact.
struct SpectrumOptions {
  Index count = 10;  ///< eigenvalues wanted, in [1, n]
  /// The largest ||A x - μ M x|| accepted, in the norm of M⁻¹ and relative to μ - σ; in (0, 1).
  double tolerance = 1e-7;
};

/// The lowest eigenvalues with their eigenvectors, and what it took to find them.
struct Spectrum {
  Eigen::VectorXd values;      ///< count, ascending; those of the kernel are 0 up to rounding
  Eigen::MatrixXd vectors;     ///< n x count, XᵀMX = I; the entry largest in size is positive
  double residual = 0;         ///< the largest, as of SpectrumOptions::tolerance
  Index rounds = 0;            ///< Lanczos runs that it took; 0 where the matrix was small: dense
  Index copies_recovered = 0;  ///< eigenvalues that the count found missing
  Index checkerboards = 0;     ///< eigenvectors below the last one that were left out as such
};

/// `A` is n x n, symmetric positive semi-definite, both triangles stored; `mass` the n positive
/// entries of the diagonal M. Deterministic; within a multiple eigenvalue the basis is arbitrary.
/// With Stabilization::mercat checkerboards times smooth functions are eigenvectors too, with
/// frequencies as low as those of smooth ones; lowest_smooth_spectrum leaves them out.
/// \throws UsageError on a shape or an option out of range; InputError where a mass is not
/// positive, naming the vertex (one that no face uses has none); SolverError where A is not
/// positive semi-definite, or the residual or the count stays wrong; LimitError as factorizations
/// do.
Spectrum lowest_spectrum(const SparseMatrix& A, const Eigen::VectorXd& mass,
                         const SpectrumOptions& options = {}, const Context& context = {});

/// The same without checkerboards, for Stabilization::mercat. `S` is checkerboard_form(): x is left
/// out where xᵀSx >= ¾ xᵀMx, and is smooth where xᵀSx <= ¼ xᵀMx. Where both kinds share an
/// eigenvalue the basis is the one that tells them apart. \throws SolverError also where an
/// eigenvector is in between: the two parities of the surface hardly hang together then, as on flat
/// parts across an axis, and have spectra of their own.
Spectrum lowest_smooth_spectrum(const SparseMatrix& A, const Eigen::VectorXd& mass,
                                const SparseMatrix& S, const SpectrumOptions& options = {},
                                const Context& context = {});

}  // namespace dsc
