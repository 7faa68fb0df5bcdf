#include "libdsc/normals/label_invariant.h"

#include "libdsc/base/error.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "tests/normals/normals_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dsc {
namespace {

TEST(InterfaceMoments, EqualBruteForceOnRandomLabels) {
  LabelVolume volume(Grid{{9, 8, 7}, {1, 1.5, 0.75}, Vec3::Zero()}, 1);
  std::mt19937 generator(1);
  for (Index z = 0; z < 7; ++z) {
    for (Index y = 0; y < 8; ++y) {
      for (Index x = 0; x < 9; ++x) volume.set(x, y, z, generator() % 4);
    }
  }
  const DigitalSurface surface = extract_surface(volume);
  for (const double radius : {0.9, 2.0, 4.3}) {
    const Ball ball(radius, volume.grid().spacing);
    for (std::size_t f = 0; f < surface.surfels().size(); f += 7) {
      const Surfel& s = surface.surfels()[f];
      Index3 centre{2 * s.x, 2 * s.y, 2 * s.z}, parity{0, 0, 0};
      centre[static_cast<std::size_t>(s.axis())] += s.sign();
      parity[static_cast<std::size_t>(s.axis())] = 1;
      const InterfaceMoments m =
          interface_moments(volume, surface.labels()[f], BallRows(ball, parity), centre);
      BallMoments expected[2];
      bool third = false;
      for (Index z = -12; z < 20; ++z) {
        for (Index y = -12; y < 20; ++y) {
          for (Index x = -12; x < 20; ++x) {
            const Index d[3] = {2 * x - centre[0], 2 * y - centre[1], 2 * z - centre[2]};
            if (!ball.contains(d[0], d[1], d[2])) continue;
            const Label label = volume(x, y, z);
            const auto& pair = surface.labels()[f];
            if (label != pair[0] && label != pair[1]) {
              third = true;
              continue;
            }
            BallMoments& e = expected[label == pair[0] ? 0 : 1];
            ++e.count;
            for (std::size_t a = 0; a < 3; ++a) {
              e.first[a] += d[a];
              e.second[a] += d[a] * d[a];
            }
            e.second[3] += d[0] * d[1];
            e.second[4] += d[0] * d[2];
            e.second[5] += d[1] * d[2];
          }
        }
      }
      EXPECT_EQ(m.inside, expected[0]);
      EXPECT_EQ(m.outside, expected[1]);
      EXPECT_EQ(m.third, third);
    }
  }
}

/// Three sectors of 120 degrees around the z axis, turned by `angle`.
LabelVolume sectors(Index n, double angle) {
  LabelVolume volume(Grid{{2 * n + 1, 2 * n + 1, 2 * n + 1}, {1, 1, 1}, Vec3::Constant(-1. * n)},
                     1);
  const double third = 2 * M_PI / 3;
  for (Index z = 0; z <= 2 * n; ++z) {
    for (Index y = 0; y <= 2 * n; ++y) {
      for (Index x = 0; x <= 2 * n; ++x) {
        double a = std::atan2(y - n + 1e-3, x - n + 1e-3) - angle;
        a -= 2 * M_PI * std::floor(a / (2 * M_PI));
        volume.set(x, y, z, 1 + static_cast<Label>(std::min(2., std::floor(a / third))));
      }
    }
  }
  return volume;
}

struct JunctionErrors {
  double both = 0, alone = 0;  ///< mean angle to the sheet's normal, degrees
};

/// Over the faces within a quarter of the radius of the junction.
JunctionErrors junction_errors(Index n, double radius, double angle) {
  const LabelVolume volume = sectors(n, angle);
  ExtractOptions near;
  near.part = [&](const Surfel& s) {
    const Vec3 c = s.centre(volume.grid());
    return std::abs(c[2]) < 2 && c.head<2>().norm() < radius / 4;
  };
  DigitalSurface surface = extract_surface(volume, near);
  EXPECT_GT(integral_invariant_normals(surface, volume, {radius}).third_label_faces, 0);
  std::vector<BinaryVolume> labels;
  for (const Label label : {0, 1, 2, 3}) labels.push_back(volume.select(std::span(&label, 1)));
  JunctionErrors mean;
  for (std::size_t f = 0; f < surface.surfels().size(); ++f) {
    const auto pair = surface.labels()[f];
    // The sheet between sectors b and b + 1 lies at angle + b thirds; 1 and 3 meet at `angle`.
    const double sheet = angle + (pair[1] == 3 && pair[0] == 1 ? 0 : pair[0]) * 2 * M_PI / 3;
    const Vec3 normal(-std::sin(sheet), std::cos(sheet), 0);
    const auto error = [&](const Vec3& u) {
      return std::acos(std::min(1., std::abs(u.dot(normal)))) * 180 / M_PI;
    };
    const Surfel s[] = {surface.surfels()[f]};
    mean.both += error(surface.normals()[static_cast<Index>(f)]);
    mean.alone += error(integral_invariant_normals(labels[pair[0]], s, {radius}).u.col(0));
  }
  mean.both /= static_cast<double>(surface.face_count());
  mean.alone /= static_cast<double>(surface.face_count());
  return mean;
}

TEST(LabelNormals, ConvergeAtAJunctionOf120DegreesWhereOneLabelAloneTilts) {
  for (const double angle : {0.1, 0.35, 0.8}) {
    const JunctionErrors coarse = junction_errors(8, 6, angle);
    const JunctionErrors fine = junction_errors(26, 24, angle);
    EXPECT_LT(fine.both, 0.5 * coarse.both);
    EXPECT_LT(fine.both, 3);
    EXPECT_GT(fine.alone, 15);
  }
}

TEST(LabelNormals, FarFromJunctionsNoThirdLabelIsMet) {
  LabelVolume volume(Grid{{20, 20, 20}, {1, 1, 1}, Vec3::Zero()}, 2);
  for (Index z = 5; z < 15; ++z) {
    for (Index y = 5; y < 15; ++y) {
      for (Index x = 5; x < 15; ++x) volume.set(x, y, z, 300);
    }
  }
  DigitalSurface surface = extract_surface(volume);
  EXPECT_EQ(integral_invariant_normals(surface, volume, {3}).third_label_faces, 0);
  EXPECT_THROW(integral_invariant_normals(surface, volume, {3, BallCentre::voxel_pair}),
               UsageError);
  const Label one[] = {300};
  DigitalSurface binary = extract_surface(volume.select(one));
  EXPECT_THROW(integral_invariant_normals(binary, volume, {3}), UsageError);
}

TEST(InterfaceNormals, ContinueBeyondAnOpenBorder) {
  // Two labels fill the volume, with a tilted plane between them.
  const Vec3 n = Vec3(1, 2, 3).normalized();
  LabelVolume volume(Grid{{30, 30, 29}}, 1);
  for (Index z = 0; z < 29; ++z) {
    for (Index y = 0; y < 30; ++y) {
      for (Index x = 0; x < 30; ++x) {
        const Vec3 p = Vec3(double(x), double(y), double(z)) - Vec3(15, 15, 14.3);
        volume.set(x, y, z, p.dot(n) < 0 ? 1 : 2);
      }
    }
  }
  const auto [whole, cut] = test::expect_near_truth_at_open_border(volume, n);
  EXPECT_GT(cut.worst, whole.worst);
  EXPECT_GT(cut.mean, 1.5 * whole.mean);
}

}  // namespace
}  // namespace dsc
