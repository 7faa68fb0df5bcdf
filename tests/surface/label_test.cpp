#include "libdsc/surface/extract.h"
#include "tests/support/long_tests.h"
#include "tests/support/surface_check.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace dsc {
namespace {

using testing::Cell;

LabelVolume random_labels(Index3 size, Label labels, unsigned seed, int bytes = 1) {
  LabelVolume volume(Grid{size, {1, 1, 1}, Vec3::Zero()}, bytes);
  std::mt19937 generator(seed);
  std::uniform_int_distribution<Label> label(0, labels);
  for (Index z = 0; z < size[2]; ++z) {
    for (Index y = 0; y < size[1]; ++y) {
      for (Index x = 0; x < size[0]; ++x) volume.set(x, y, z, label(generator));
    }
  }
  return volume;
}

void expect_labels(const DigitalSurface& surface, const LabelVolume& volume) {
  ASSERT_EQ(surface.labels().size(), surface.surfels().size());
  for (std::size_t f = 0; f < surface.labels().size(); ++f) {
    EXPECT_EQ(surface.labels()[f],
              testing::labels_of(volume, testing::cell_of(surface.surfels()[f])));
  }
}

TEST(LabelSurface, RandomVolumesOfUpTo8LabelsAreSoundUnderBothAdjacencies) {
  for (unsigned seed = 0; seed < testing::usually_or_long(1500U, 20000U); ++seed) {
    const auto volume = random_labels({4, 4, 3}, 1 + seed % 8, seed);
    for (const Adjacency adjacency : {Adjacency::interior, Adjacency::exterior}) {
      ExtractOptions options;
      options.adjacency = adjacency;
      options.glue = seed % 3 == 0 ? Glue::umbrella : Glue::pointel;
      const DigitalSurface surface = extract_surface(volume, options, Context{1});
      testing::expect_sound(surface, testing::voxel_topology(volume, adjacency),
                            "seed " + std::to_string(seed));
      expect_labels(surface, volume);
    }
    if (HasFatalFailure() || HasNonfatalFailure()) return;
  }
}

/// Linels with more than two labels around them, counted from the voxels.
Index count_junctions(const LabelVolume& volume) {
  const Index3 n = volume.grid().size;
  Index count = 0;
  for (Index z = 0; z <= n[2]; ++z) {
    for (Index y = 0; y <= n[1]; ++y) {
      for (Index x = 0; x <= n[0]; ++x) {
        const auto at = [&](Index i, Index j, Index k) { return volume(x - i, y - j, z - k); };
        const std::set<Label> around[] = {{at(0, 0, 0), at(0, 1, 0), at(0, 0, 1), at(0, 1, 1)},
                                          {at(0, 0, 0), at(1, 0, 0), at(0, 0, 1), at(1, 0, 1)},
                                          {at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(1, 1, 0)}};
        for (const auto& labels : around) count += labels.size() > 2 ? 1 : 0;
      }
    }
  }
  return count;
}

TEST(LabelSurface, JunctionsAreTheLinelsWhereMoreThanTwoLabelsMeet) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const auto volume = random_labels({6, 5, 4}, 1 + seed % 6, seed);
    const SurfaceCounts counts = extract_surface(volume, {}, Context{1}).counts();
    EXPECT_EQ(counts.junction_edges, count_junctions(volume)) << seed;
    EXPECT_LE(counts.junction_edges, counts.nonmanifold_edges);
    EXPECT_EQ(counts.junction_edges > 0, seed % 6 > 0);  // not of one label and the outside
  }
}

TEST(LabelSurface, OneLabelIsTheBinarySurface) {
  const auto volume = random_labels({70, 5, 4}, 1, 3);
  const DigitalSurface labelled = extract_surface(volume);
  const Label one[] = {1};
  const DigitalSurface binary = extract_surface(volume.select(one));
  EXPECT_TRUE(std::equal(labelled.surfels().begin(), labelled.surfels().end(),
                         binary.surfels().begin(), binary.surfels().end()));
  EXPECT_TRUE(std::equal(labelled.corners().begin(), labelled.corners().end(),
                         binary.corners().begin(), binary.corners().end()));
  EXPECT_EQ(labelled.mesh().n_vertices(), binary.mesh().n_vertices());
  EXPECT_EQ(binary.labels().size(), 0u);
}

TEST(LabelSurface, InterfacesOfOnePairAreSoundParts) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const auto volume = random_labels({4, 4, 4}, 3, seed);
    ExtractOptions options;
    options.between = {{1, 2}, {3, 0}};
    const auto kept = [&](const Cell& c) {
      const auto pair = testing::labels_of(volume, c);
      return pair == LabelPair{1, 2} || pair == LabelPair{3, 0};
    };
    testing::expect_sound(extract_surface(volume, options, Context{1}),
                          testing::voxel_topology(volume, Adjacency::interior, kept),
                          "seed " + std::to_string(seed));
    if (HasFatalFailure() || HasNonfatalFailure()) return;
  }
}

TEST(LabelSurface, ThreeQuartersMeetInOneLineOfJunctions) {
  // Labels 1, 2 and twice 3 around the z axis: 4 x 4 x n voxels in quarters.
  const Index n = 5;
  LabelVolume volume(Grid{{4, 4, n}, {1, 1, 1}, Vec3::Zero()}, 1);
  for (Index z = 0; z < n; ++z) {
    for (Index y = 0; y < 4; ++y) {
      for (Index x = 0; x < 4; ++x) volume.set(x, y, z, y < 2 ? (x < 2 ? 1 : 2) : 3);
    }
  }
  ExtractOptions inner;
  inner.border = Border::open;
  const DigitalSurface s = extract_surface(volume, inner);
  EXPECT_EQ(s.counts().nonmanifold_edges, n);
  EXPECT_EQ(s.counts().junction_edges, n);
  EXPECT_EQ(s.counts().components, 1);  // glued along the junction
  EXPECT_EQ(s.counts().faces, 2 * n + 4 * n);
  // The mesh itself ends there: three sheets, sharing vertex ids and no vertex.
  EXPECT_EQ(static_cast<Index>(s.mesh().n_vertices()), s.vertex_count() + 2 * (n + 1));
  std::map<LabelPair, int> faces;
  for (const LabelPair& pair : s.labels()) ++faces[pair];
  EXPECT_EQ(faces, (std::map<LabelPair, int>{{{1, 2}, 2 * n}, {{1, 3}, 2 * n}, {{2, 3}, 2 * n}}));
}

TEST(LabelSurface, TheOutsideIsNeverInside) {
  const auto volume = random_labels({6, 6, 6}, 5, 11, 4);
  const DigitalSurface s = extract_surface(volume);
  for (const LabelPair& pair : s.labels()) {
    EXPECT_NE(pair[0], 0u);
    EXPECT_TRUE(pair[1] == 0 || pair[0] < pair[1]);
  }
}

TEST(LabelVolume, CountsVoxelsWithALabel) {
  const auto volume = random_labels({70, 50, 90}, 3, 5, 2);
  Index count = 0;
  for (Index z = 0; z < 90; ++z) {
    for (Index y = 0; y < 50; ++y) {
      for (Index x = 0; x < 70; ++x) count += volume(x, y, z) != 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(volume.count(), count);
}

TEST(LabelVolume, HoldsEveryWidthAndRefusesOthers) {
  for (const int bytes : {1, 2, 4}) {
    LabelVolume volume(Grid{{3, 2, 2}, {1, 1, 1}, Vec3::Zero()}, bytes);
    volume.set(2, 1, 1, volume.largest());
    volume.set(0, 0, 0, 7);
    EXPECT_EQ(volume(2, 1, 1), volume.largest());
    EXPECT_EQ(volume(3, 1, 1), 0u);
    EXPECT_EQ(volume(0, -1, 0), 0u);
    EXPECT_EQ(volume.labels(), (std::vector<Label>{7, volume.largest()}));
    EXPECT_EQ(volume.memory_bytes(), static_cast<std::size_t>(12 * bytes));
    const Label seven[] = {7};
    EXPECT_EQ(volume.select(seven).count(), 1);
  }
  EXPECT_THROW(LabelVolume(Grid{{1, 1, 1}, {1, 1, 1}, Vec3::Zero()}, 3), UsageError);
  EXPECT_THROW(LabelVolume(Grid{{-1, 1, 1}, {1, 1, 1}, Vec3::Zero()}, 1), InputError);
  const Index huge = Index{1} << 31;
  EXPECT_THROW(LabelVolume(Grid{{huge, huge, huge}, {1, 1, 1}, Vec3::Zero()}, 1), LimitError);
}

}  // namespace
}  // namespace dsc
