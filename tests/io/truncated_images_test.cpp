// Medical images cut at every byte, and headers that contradict what follows them: dsc-image-reader
// refuses them in words. ITK alone aborts on some and makes zeros of what is missing on others.
#include "libdsc/base/error.h"
#include "libdsc/io/read_labels.h"
#include "tests/io/image_variants.h"
#include "tests/io/temporary_folder.h"
#include "tests/support/long_tests.h"

#include <gtest/gtest.h>

#include <limits>

namespace dsc {
namespace {

struct ImageFile {
  const char* name;  ///< a file, or a file in a folder of slices
  std::string (*bytes)(const TestImage& image);
};

/// Writes it; returns what is to be opened.
std::string write_image(const TemporaryFolder& folder, const std::string& name,
                        const std::string& bytes) {
  const std::string path = folder / name;
  const std::string parent = std::filesystem::path(path).parent_path().string();
  std::filesystem::create_directories(parent);
  write_all(path, bytes);
  return name.find('/') == std::string::npos ? path : parent;
}

std::vector<Label> labels_of(const std::string& path) {
  const LabelVolume volume = read_labels(path);
  const Index3 size = volume.grid().size;
  std::vector<Label> labels;
  for (Index z = 0; z < size[2]; ++z) {
    for (Index y = 0; y < size[1]; ++y) {
      for (Index x = 0; x < size[0]; ++x) labels.push_back(volume(x, y, z));
    }
  }
  return labels;
}

/// In words of the reader's own, not that it died.
void expect_words(const InputError& error, const std::string& path) {
  const std::string what = error.what();
  EXPECT_NE(what.find(path), std::string::npos) << what;
  for (const char* death : {"Aborted", "Segmentation", "exit code", "signal"}) {
    EXPECT_EQ(what.find(death), std::string::npos) << what;
  }
}

template <class Fixture>
class WithReader : public Fixture {
 protected:
  void SetUp() override {
#ifndef DSC_IMAGE_READER
    GTEST_SKIP() << "built without DSC_WITH_ITK";
#endif
  }
};
class CutImages : public WithReader<::testing::TestWithParam<ImageFile>> {};
class Contradictions : public WithReader<::testing::Test> {};

TEST_P(CutImages, AreErrorsOrWhole) {
  const TemporaryFolder folder;
  const TestImage image = small_image();
  const std::string bytes = GetParam().bytes(image);
  const std::string path = write_image(folder, GetParam().name, bytes);
  const std::vector<Label> whole = labels_of(path);
  const auto count = static_cast<std::ptrdiff_t>(whole.size());  // of one slice or all
  ASSERT_TRUE(
      std::equal(whole.begin(), whole.end(), image.values.begin(), image.values.begin() + count));
  std::size_t refused = 0, cuts = 0;
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    if (!testing::long_tests() && n % 32 != 0 && n + 64 < bytes.size()) continue;
    ++cuts;
    (void)write_image(folder, GetParam().name, bytes.substr(0, n));
    try {
      EXPECT_EQ(labels_of(path), whole) << "cut at byte " << n << " of " << bytes.size();
    } catch (const InputError& error) {
      SCOPED_TRACE(n);
      expect_words(error, path);
      ++refused;
    }
  }
  EXPECT_GE(refused + 16, cuts) << "what is behind the values may be missing, little else";
}

INSTANTIATE_TEST_SUITE_P(
    All, CutImages,
    ::testing::Values(
        ImageFile{"v.mha", mha_bytes}, ImageFile{"deflated.mha", compressed_mha},
        ImageFile{"v.nrrd", nrrd_bytes}, ImageFile{"deflated.nrrd", compressed_nrrd},
        ImageFile{"v.nii", nii_bytes},
        ImageFile{"v.nii.gz", [](const TestImage& i) { return gzipped(nii_bytes(i)); }},
        ImageFile{"v.tif", [](const TestImage& i) { return tiff_bytes(i, 0, 2); }},
        ImageFile{"last.tif",
                  [](const TestImage& i) { return tiff_with_directory_last(i, false); }},
        ImageFile{"deflated.tif",
                  [](const TestImage& i) { return tiff_with_directory_last(i, true); }},
        ImageFile{"explicit/1", [](const TestImage& i) { return dicom_variant(i, kExplicit); }},
        ImageFile{"implicit/1", [](const TestImage& i) { return dicom_variant(i, kImplicit); }},
        ImageFile{"deflated/1", [](const TestImage& i) { return dicom_variant(i, kDeflated); }},
        ImageFile{"big_endian/1", [](const TestImage& i) { return dicom_variant(i, kBigEndian); }}),
    [](const auto& file) {
      std::string name = file.param.name;
      for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
      return name;
    });

TEST_F(Contradictions, AreErrors) {
  const TemporaryFolder folder;
  const TestImage image = small_image();
  const auto expect = [&](const std::string& name, const std::string& bytes,
                          const std::string& part) {
    SCOPED_TRACE(name + ": " + part);
    const std::string path = write_image(folder, name, bytes);
    try {
      (void)labels_of(path);
      ADD_FAILURE() << "it is read";
    } catch (const InputError& error) {
      expect_words(error, path);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  const auto with = [](std::string bytes, std::size_t at, auto value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return bytes;
  };
  const auto with_line = [](std::string bytes, const std::string& line) {
    return bytes.insert(bytes.find("ElementDataFile"), line + "\n");
  };
  std::string mha = compressed_mha(image);
  const std::size_t size = mha.find("CompressedDataSize = ");
  const std::size_t end = mha.find('\n', size);
  for (const char* given : {"1", "20"}) {
    std::string less = mha;
    expect("less.mha", less.replace(size, end - size, std::string("CompressedDataSize = ") + given),
           "truncated");
  }
  expect("negative.mha", mha.replace(size, end - size, "CompressedDataSize = -5"), "not positive");
  expect("far.mha", with_line(mha_bytes(image), "HeaderSize = 1000"), "truncated");

  const std::string nii = nii_bytes(image);
  expect("offset.nii", with(nii, 108, 0.F), "byte 0");
  expect("offset.nii", with(nii, 108, std::numeric_limits<float>::infinity()), "byte inf");
  expect("offset.nii", with(nii, 108, -100.F), "byte -100");
  expect("type.nii", with(nii, 70, std::int16_t{64}), "truncated");  // double
  expect("type.nii", with(nii, 70, std::int16_t{32}), "no integers or floats");
  expect("second.nii", with(nii, 0, std::int32_t{540}), "NIfTI-2");
  // The bits a voxel do not count: the type does.
  EXPECT_NO_THROW((void)labels_of(write_image(folder, "b.nii", with(nii, 72, std::int16_t{8}))));

  const std::string tiff = tiff_with_directory_last(image, false);  // directory at byte 32
  expect("circle.tif", with(tiff, tiff.size() - 4, std::uint32_t{32}), "circle");
  expect("twice.tif", with(tiff, 32 + 2 + 12 * 8, std::uint16_t{273}), "twice");

  std::string nrrd = nrrd_bytes(image);
  nrrd = nrrd.substr(0, nrrd.find("\n\n") + 2);
  for (const std::int16_t value : image.values) nrrd += std::to_string(value) + " ";
  expect("text.nrrd", nrrd.replace(nrrd.find(": raw"), 5, ": ascii"), "as text");

  for (const char* syntax : {kExplicit, kImplicit, kDeflated, kBigEndian}) {
    const std::string name = "short" + std::string(syntax) + "/1";
    expect(name, dicom_variant(image, syntax, image.value_bytes().substr(0, 12)), "promises 24");
    expect(name, dicom_variant(image, syntax, ""), "promises 24");
  }
  expect(
      "none/1",
      dicom_variant(image, kExplicit).substr(0, dicom_variant(image, kExplicit).size() - 24 - 12),
      "no pixel data");
}

}  // namespace
}  // namespace dsc
