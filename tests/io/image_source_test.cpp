// Medical images through dsc-image-reader, against files written here from the formats'
// descriptions.
#include "libdsc/base/error.h"
#include "libdsc/io/image_stream.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "tests/io/image_variants.h"
#include "tests/io/temporary_folder.h"
#include "tests/support/memory_left.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include <signal.h>
#include <sys/stat.h>

namespace dsc {
namespace {

class Images : public testing::Test {
 protected:
  void SetUp() override {
#ifndef DSC_IMAGE_READER
    GTEST_SKIP() << "built without DSC_WITH_ITK";
#endif
  }

  /// Writes it and expects the image back, values and place.
  void expect_image(const std::string& name, const std::string& bytes, const TestImage& image,
                    double tolerance = 1e-12) {
    write_all(folder_ / name, bytes);
    expect_image(folder_ / name, image, tolerance);
  }
  static void expect_image(const std::string& path, const TestImage& image, double tolerance) {
    SCOPED_TRACE(path);
    const auto source = open_volume(path);
    ASSERT_EQ(source->grid().size, image.size);
    EXPECT_LT((source->grid().spacing - image.spacing).norm(), tolerance);
    EXPECT_EQ(source->grid().origin, Vec3(Vec3::Zero()));
    const RigidMap world = source->world();
    EXPECT_LT((world.rotation - image.direction).norm(), tolerance);
    EXPECT_LT((world.translation - image.origin).norm(), 20 * tolerance);
    EXPECT_EQ(world.mirrors(), image.direction.determinant() < 0);
    const LabelVolume labels = read_labels(*source);
    EXPECT_EQ(labels.largest(), 65535U);
    for (Index z = 0, i = 0; z < image.size[2]; ++z) {
      for (Index y = 0; y < image.size[1]; ++y) {
        for (Index x = 0; x < image.size[0]; ++x, ++i) {
          ASSERT_EQ(labels(x, y, z), static_cast<Label>(image.values[static_cast<std::size_t>(i)]));
        }
      }
    }
  }

  TemporaryFolder folder_;
};

TEST_F(Images, EveryFormatGivesTheVoxelsAndTheirPlace) {
  for (const double mirror : {1., -1.}) {
    const TestImage image = random_image(mirror);
    expect_image("v.mha", mha_bytes(image), image);
    expect_image("v.nrrd", nrrd_bytes(image), image);
    // NIfTI keeps its place in 32 bits.
    expect_image("v.nii", nii_bytes(image), image, 1e-6);
    expect_image("V.NII.GZ", gzipped(nii_bytes(image)), image, 1e-6);
  }
}

TEST_F(Images, DetachedHeadersFindTheirData) {
  const TestImage image = random_image(1);
  write_all(folder_ / "v.bin", image.value_bytes());
  const std::string nrrd = nrrd_bytes(image), mha = mha_bytes(image);
  expect_image("v.nhdr", nrrd.substr(0, nrrd.find("\n\n") + 1) + "data file: v.bin\n", image);
  expect_image("v.mhd", mha.substr(0, mha.find("LOCAL")) + "v.bin\n", image);
}

TEST_F(Images, TiffPagesAndTiffFilesAreSlices) {
  TestImage image = random_image(1);
  image.spacing = {1, 1, 1};
  image.origin = {0, 0, 0};
  image.direction = Mat3::Identity();
  expect_image("v.tif", tiff_bytes(image, 0, 5), image);
  // slice8, slice9, slice10 …
  ASSERT_EQ(::mkdir((folder_ / "slices").c_str(), 0700), 0);
  for (Index z = 0; z < 5; ++z) {
    write_all(folder_ / ("slices/slice" + std::to_string(8 + z) + ".tiff"),
              tiff_bytes(image, z, z + 1));
  }
  expect_image(folder_ / "slices", image, 1e-12);
  write_all(folder_ / "slices/slice9.tiff", tiff_bytes(image, 0, 2));
  expect_input_error([&] { (void)open_volume(folder_ / "slices"); }, {"slice9", "more than one"});
}

TEST_F(Images, ADicomSeriesIsOrderedByItsPlaceInTheWorld) {
  for (const double mirror : {1., -1.}) {
    TestImage image = random_image(1);
    image.direction.col(2) *= mirror;
    const std::string series = folder_ / ("series" + std::to_string(static_cast<int>(mirror + 1)));
    ASSERT_EQ(::mkdir(series.c_str(), 0700), 0);
    for (Index z = 0; z < 5; ++z) {
      // Names in another order than the slices.
      write_all(series + "/" + std::to_string((3 * z) % 5), dicom_bytes(image, z, "1.2.3.4"));
    }
    // The slices' order follows their normal, so that a series against it comes turned around.
    if (mirror < 0) {
      const TestImage before = image;
      image.origin += 4 * image.spacing[2] * image.direction.col(2);
      image.direction.col(2) *= -1;
      for (std::size_t z = 0; z < 5; ++z) {
        std::copy_n(before.values.begin() + static_cast<long>((4 - z) * 42), 42,
                    image.values.begin() + static_cast<long>(z * 42));
      }
    }
    expect_image(series, image, 1e-8);

    write_all(series + "/other", dicom_bytes(image, 0, "1.2.3.5"));
    expect_input_error([&] { (void)open_volume(series); }, {"2 DICOM series"});
    std::filesystem::remove(series + "/other");
    std::filesystem::remove(series + "/1");
    expect_input_error([&] { (void)open_volume(series); }, {"missing or uneven"});
  }
}

TEST_F(Images, CompressedValuesAreInflated) {
  const TestImage image = random_image(-1);
  expect_image("v.mha", compressed_mha(image), image);
  expect_image("v.nrrd", compressed_nrrd(image), image);
}

TEST_F(Images, TruncatedFilesAreErrors) {
  const TestImage image = random_image(1);
  const std::pair<const char*, std::string> files[] = {
      {"v.mha", mha_bytes(image)},        {"v.nrrd", nrrd_bytes(image)},
      {"v.nii", nii_bytes(image)},        {"v.nii.gz", gzipped(nii_bytes(image))},
      {"z.mha", compressed_mha(image)},   {"z.nrrd", compressed_nrrd(image)},
      {"v.tif", tiff_bytes(image, 0, 5)}, {"s/1", dicom_bytes(image, 0, "1.2.3")}};
  ASSERT_EQ(::mkdir((folder_ / "s").c_str(), 0700), 0);
  for (const auto& [name, bytes] : files) {
    for (const double part : {0., 0.01, 0.3, 0.6, 0.9, 0.99}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(part));
      const auto size = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
      write_all(folder_ / name, bytes.substr(0, size));
      const std::string path = folder_ / (name[0] == 's' ? "s" : name);
      expect_input_error([&] { (void)read_labels(path); }, {path});
    }
  }
}

TEST_F(Images, WhatIsNoVolumeIsRefused) {
  const TestImage image = random_image(1);
  const auto expect = [&](const std::string& name, std::string bytes, const std::string& from,
                          const std::string& to, const std::string& part) {
    SCOPED_TRACE(to);
    const std::size_t at = bytes.find(from);
    ASSERT_NE(at, std::string::npos);
    write_all(folder_ / name, bytes.replace(at, from.size(), to));
    expect_input_error([&] { (void)read_labels(folder_ / name); }, {folder_ / name, part});
  };
  const auto expect_limit = [&](const std::string& name, std::string bytes, const std::string& to,
                                const std::string& part) {
    SCOPED_TRACE(to);
    write_all(folder_ / name, bytes.replace(bytes.find("7 6 5"), 5, to));
    expect_error<LimitError>([&] { (void)read_labels(folder_ / name); }, {folder_ / name, part});
  };
  const std::string nrrd = nrrd_bytes(image), mha = mha_bytes(image);
  expect("v.mha", mha, "MET_SHORT", "MET_SHORT_ARRAY\nElementNumberOfChannels = 3", "");
  expect("v.nrrd", nrrd, "7 6 5", "7000000 6000000 5000", "truncated");
  expect_limit("v.mha", mha, "2147483648 2147483648 2147483648", "memory");
  expect("v.mha", mha, "7 6 5", "7000000 6000000 5000", "truncated");
  expect("v.mha", compressed_mha(image), "CompressedDataSize", "Comment", "lacks");
  expect("v.mha", mha, "BinaryData = True", "BinaryData = False", "text");
  expect("v.mha", mha, joined(image.spacing, " "), "0.5 -1 2", "");
  expect("v.nrrd", nrrd, "7 6 5", "7 0 5", "");
  // Sheared axes.
  TestImage sheared = image;
  sheared.direction.col(0) = (image.direction.col(0) + image.direction.col(1)).normalized();
  expect("v.mha", mha_bytes(sheared), "", "", "right angles");
  std::string four = nii_bytes(image);
  four[40] = 4;
  four[48] = 2;  // two volumes
  expect("v.nii", four + image.value_bytes(), "", "", "2 volumes");
  expect_input_error([&] { (void)open_volume(folder_ / "missing.nii"); }, {"does not exist"});
  ASSERT_EQ(::mkdir((folder_ / "empty").c_str(), 0700), 0);
  expect_input_error([&] { (void)open_volume(folder_ / "empty"); }, {"neither TIFF"});
}

TEST_F(Images, CancellationEndsTheReading) {
  write_all(folder_ / "v.mha", mha_bytes(random_image(1)));
  const auto source = open_volume(folder_ / "v.mha");
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW((void)read_binary(*source, {}, Context{1, &monitor}), Cancelled);
}

/// Programs that answer in the place of dsc-image-reader.
class Readers : public testing::Test {
 protected:
  Readers() { write_all(image_, ""); }
  ~Readers() override { ::unsetenv("DSC_IMAGE_READER"); }

  void use(const std::string& script) {
    write_all(folder_ / "reader", "#!/bin/sh\n" + script);
    ASSERT_EQ(::chmod((folder_ / "reader").c_str(), 0700), 0);
    ::setenv("DSC_IMAGE_READER", (folder_ / "reader").c_str(), 1);
  }

  TemporaryFolder folder_;
  std::string image_ = folder_ / "v.nii";
};

TEST_F(Readers, TheirFailuresAreInputErrors) {
  const auto expect = [&](const std::string& script, const std::string& part) {
    SCOPED_TRACE(script);
    use(script);
    expect_input_error([&] { (void)open_volume(image_); }, {image_, part});
  };
  expect("echo first >&2; echo the reason >&2; exit 1", "v.nii': the reason");
  expect("exit 7", "exit code 7");
  expect("exit 0", "before all values");
  expect("kill -SEGV $$", "Segmentation fault");
  expect("head -c 200 /dev/zero", "this version");
  // More on standard error than a pipe holds.
  expect("head -c 300000 /dev/zero | tr '\\0' '\\n' >&2; echo last >&2; exit 1", "last");
}

TEST_F(Readers, TheirExcessIsOutOfLimits) {
  use("echo \"no memory for $2 bytes\" >&2; exit 4");
  const test::MemoryLeft limit(12345);
  expect_error<LimitError>(
      [&] {
        (void)open_volume(image_, {0, nullptr, &limit});
      },
      {image_, "no memory for 12345 bytes"});
}

TEST_F(Readers, OneThatSendsNothingIsGivenUp) {
  ::setenv("DSC_IMAGE_READER_SECONDS", "1", 1);
  use("echo $$ > '" + folder_ / "pid" + "'\nexec sleep 1000");
  expect_input_error([&] { (void)open_volume(image_); },
                     {image_, "nothing for 1 seconds", "DSC_IMAGE_READER_SECONDS"});
  EXPECT_NE(::kill(std::stoi(read_all(folder_ / "pid")), 0), 0) << "the reader still runs";
  // It closes its output, but does not end.
  use("exec sleep 1000 >&- 2>&-");
  expect_input_error([&] { (void)open_volume(image_); }, {image_, "nothing for 1 seconds"});
  for (const char* wrong : {"0", "-1", "1x", "nan"}) {
    ::setenv("DSC_IMAGE_READER_SECONDS", wrong, 1);
    EXPECT_THROW((void)open_volume(image_), UsageError) << wrong;
  }
  ::unsetenv("DSC_IMAGE_READER_SECONDS");
}

TEST_F(Images, TheMemoryThatIsLeftBoundsTheReader) {
  TestImage image{{400, 400, 300}, {1, 1, 1}, Mat3::Identity(), {0, 0, 0}, {}};
  image.values.assign(48000000, 1);  // 96 MB in 100 KB
  write_all(folder_ / "v.nii.gz", gzipped(nii_bytes(image)));
  const auto count = [&](Index bytes) {
    const test::MemoryLeft limit(bytes);
    return read_binary(folder_ / "v.nii.gz", {}, {0, nullptr, &limit}).count();
  };
  EXPECT_EQ(count(Index{400} << 20), 48000000);
#ifndef __SANITIZE_ADDRESS__
  expect_error<LimitError>([&] { (void)count(Index{1} << 20); }, {folder_ / "v.nii.gz", "memory"});
#endif
}

/// Behind the values, megabytes of zeros and then damage, which nobody sees who stops in time.
TEST_F(Images, InflationStopsAtTheDeclaredSize) {
  const TestImage image = random_image(1);
  const auto with_bomb = [](const std::string& bytes, auto&& pack) {
    std::string packed = pack(bytes + std::string(64 << 20, '\0'));
    for (std::size_t i = packed.size() / 2; i < packed.size(); ++i) packed[i] = '\xff';
    return packed;
  };
  expect_image("v.nii.gz", with_bomb(nii_bytes(image), gzipped), image, 1e-6);  // of floats
  std::string text = nrrd_bytes(image);
  text.replace(text.find("encoding: raw"), 13, "encoding: gzip");
  text = text.substr(0, text.find("\n\n") + 2);
  expect_image("v.nrrd", text + with_bomb(image.value_bytes(), gzipped), image);
  text = mha_bytes(image);
  text.replace(text.find("CompressedData = False"), 22, "CompressedData = True");
  const std::string packed = with_bomb(image.value_bytes(), deflated);
  text.insert(text.find("ElementDataFile"),
              "CompressedDataSize = " + std::to_string(packed.size()) + "\n");
  expect_image("v.mha", text.substr(0, text.find("LOCAL\n") + 6) + packed, image);
}

TEST_F(Readers, AMissingOneSaysHowToGetIt) {
  ::setenv("DSC_IMAGE_READER", (folder_ / "nowhere").c_str(), 1);
  expect_input_error([&] { (void)open_volume(image_); }, {"nowhere", "cannot start"});
#ifndef DSC_IMAGE_READER
  ::unsetenv("DSC_IMAGE_READER");
  expect_input_error([&] { (void)open_volume(image_); }, {"v.nii", "-DDSC_WITH_ITK=ON"});
#endif
}

TEST_F(Readers, OneThatHangsIsKilledUponCancellation) {
#ifndef DSC_IMAGE_READER
  GTEST_SKIP() << "built without DSC_WITH_ITK";
#else
  // The header comes, the values do not.
  write_all(folder_ / "v.mha", mha_bytes(random_image(1)));
  use("echo $$ > '" + folder_ / "pid" + "'\n'" + DSC_IMAGE_READER + "' '" + folder_ / "v.mha" +
      "' | head -c " + std::to_string(sizeof(detail::ImageHeader) + 8) + "\nexec sleep 1000");
  auto source = open_volume(image_);
  Monitor monitor;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    monitor.cancel();
  });
  EXPECT_THROW((void)read_binary(*source, {}, Context{1, &monitor}), Cancelled);
  canceller.join();
  source.reset();
  const int pid = std::stoi(read_all(folder_ / "pid"));
  EXPECT_NE(::kill(pid, 0), 0) << "the reader still runs";
#endif
}

}  // namespace
}  // namespace dsc
