/// \file
/// What the calculus leaves to choose: the term that completes each face's inner product, and the
/// bound on how steep a face may stand against its estimated normal.
#pragma once

namespace dsc {

/// The coefficient λ_f of the part of a 1-form that no tangent vector explains. On an axis-aligned
/// rectangle the usual local Laplacians are all −(a GᵀG + λ_f g gᵀ), g = (1, −1, 1, −1), and differ
/// in λ_f alone; there, in the rectangle's own frame,
/// \f[ s = \Big(\frac{h_y}{h_x}(1 - u_y^2) + \frac{h_x}{h_y}(1 - u_x^2)\Big) \Big/ u_z. \f]
enum class Stabilization {
  de_goes,             ///< λ_f = CalculusOptions::lambda (de Goes et al.; Alexa and Wardetzky)
  mercat,              ///< λ_f = 0: the checkerboard joins the kernel, so solvers must deflate it
  corrected_elements,  ///< λ_f = s/12, bilinear finite elements; rectangles only
  virtual_refinement,  ///< λ_f = s/8, triangles around a virtual centre; rectangles only
};

/// The defaults suit digital surfaces of smooth objects.
struct CalculusOptions {
  /// λ of Stabilization::de_goes, > 0 and at most 1e6: beyond, what it weighs drowns the rest in
  /// rounding. On flat square surfels the maximum principle holds for
  /// λ <= 1/2.
  double lambda = 0.25;
  /// The least cosine between the estimated normal and the face's own, in (0, 1]; below it the
  /// normal is tilted back (embedding.h) and the face counted. Operators grow like its inverse.
  /// The default leaves all but about one surfel in 10⁴ of a smooth shape alone.
  double min_cosine = 0.01;
  Stabilization stabilization = Stabilization::de_goes;  ///< which λ_f

  /// \throws UsageError naming the option that is out of its range.
  void check() const;
};

}  // namespace dsc
