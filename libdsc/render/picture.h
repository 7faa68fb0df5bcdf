/// \file
/// Pictures of surfaces: shaded, coloured by a field, with isolines, arrows and a colour bar, drawn
/// off screen on the CPU. The same bits for any number of threads.
///
/// The surface is looked at from `view` by an orthographic camera and fills the picture but for a
/// margin and the key at the right. A pixel is the weighted mean, in linear light, of `samples`
/// points a pixel in it and around it.
#pragma once

#include "libdsc/io/results.h"
#include "libdsc/render/camera.h"
#include "libdsc/render/image.h"

#include <array>
#include <optional>
#include <string>

namespace dsc::render {

/// The normals that light falls on.
enum class Shading {
  automatic,    ///< true where the mesh has normals
  flat,         ///< of the faces as they are
  true_normals  ///< FlatMesh::normals, a face
};

/// What can be chosen of a picture.
struct PictureOptions {
  int width = 1600;                            ///< pixels of a row
  int height = 1200;                           ///< rows
  View view;                                   ///< from where, and what is up
  std::string colormap;                        ///< see Colormap; empty: by the values' signs
  std::optional<std::array<double, 2>> range;  ///< of the colours; not given: that of the values
  int isolines = 12;                     ///< at most so many steps between round values; 0: none
  Shading shading = Shading::automatic;  ///< what light falls on
  int glyphs = 0;                        ///< about so many arrows, of a field of vectors
  int samples = 8;                       ///< a pixel
  double ambient = 0.45;  ///< the part of the light that comes from everywhere, 0 to 1
  double margin = 0.045;  ///< around the surface, in parts of the shorter side
  bool key = true;        ///< whether there is a colour bar, or a list of colours

  /// Refuses what no picture can be made of. \throws UsageError for a size outside 16 to 16384, or
  /// other numbers out of their range.
  void check() const;
};

/// A picture and what is to be known about it.
struct Picture {
  Image image;              ///< of the size asked for
  std::string title;        ///< of the key: the field's name, |name| for lengths
  std::string colormap;     ///< empty where there is no bar
  double low = 0;           ///< the lower end of the bar
  double high = 0;          ///< its upper end
  double isoline_step = 0;  ///< 0: no isolines
  Index missing = 0;        ///< values that are infinite, drawn grey
};

/// The surface alone.
/// \throws UsageError as PictureOptions::check() does, where normals to shade by are asked for that
/// the mesh does not have, where arrows are asked for without vectors, and where a field's size is
/// not that of the mesh; InputError where the mesh has no face, a corner is no vertex, or positions
/// or values are not numbers; LimitError; Cancelled.
Picture draw(const FlatMesh& mesh, const PictureOptions& options = {}, const Context& context = {});

/// Coloured by a scalar field (isolines where it is one of vertices), by the lengths of a field of
/// vectors, or by their directions where they are unit.
Picture draw(const FlatMesh& mesh, const Field& field, const PictureOptions& options = {},
             const Context& context = {});

/// Coloured by the labels of the faces, inside and outside, one a face each.
Picture draw_labels(const FlatMesh& mesh, std::span<const double> inner,
                    std::span<const double> outer, const PictureOptions& options = {},
                    const Context& context = {});

}  // namespace dsc::render
