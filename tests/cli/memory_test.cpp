// Files that claim more than there is, and --max-memory.
#include "tests/cli/program.h"
#include "tests/io/image_bytes.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

namespace dsc::test {
namespace {

constexpr std::int64_t kMebi = 1 << 20;
const std::string k31 = "2147483648";           // 2^31: cubed it wraps to 0 in 64 bits, and in 93
const std::string k63 = "9223372036854775807";  // 2^63 - 1

/// CPU time of a refusal. Readers that are a part of the program take a tenth of it, on a machine
/// that is not busy.
constexpr double kCpuSeconds = 0.05, kCpuSecondsOfProcesses = 0.2;

/// Expects a refusal that names the file, at once and in little memory.
void expect_refused_at_once(const std::string& path, const Words& options = {},
                            [[maybe_unused]] double cpu_seconds = kCpuSeconds) {
  SCOPED_TRACE(path);
  Words words = {"info", path};
  words.insert(words.end(), options.begin(), options.end());
  (void)::malloc_trim(0);  // what this process holds counts as the child's
  const Outcome outcome = run_dsc(words);
  EXPECT_TRUE(outcome.exit_code == 3 || outcome.exit_code == 4) << outcome.exit_code;
  EXPECT_NE(outcome.err.find(path), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("out of memory"), std::string::npos) << outcome.err;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(outcome.cpu_seconds, cpu_seconds);
  EXPECT_LT(outcome.peak_bytes, 50 * kMebi);
#endif
  if (std::getenv("DSC_MEMORY_PRINT") != nullptr) {
    std::printf("%-20s %5.0f ms %4.0f MB  %s",
                std::filesystem::path(path).filename().string().c_str(), 1e3 * outcome.cpu_seconds,
                static_cast<double>(outcome.peak_bytes) / 1e6, outcome.err.c_str());
  }
}

TEST(ClaimedSizes, OfVolumesAreRefusedAtOnce) {
  const Folder folder;
  const auto expect = [&](const std::string& name, const std::string& bytes,
                          const Words& options = {}) {
    write_file(folder / name, bytes + std::string(100, 'x'));
    expect_refused_at_once(folder / name, options);
  };
  const std::string one = "1";
  for (const auto& [x, y, z] : {std::array{k31, k31, k31}, {k63, one, one}, {one, one, k63}}) {
    const std::string sizes = "X: " + x + "\nY: " + y + "\nZ: " + z + "\n";
    for (const std::string version : {"2", "3"}) {
      expect("v" + version + ".vol", vol_text(sizes, version));
      expect("v" + version + ".longvol", vol_text(sizes, version));
    }
    const std::string shape = "(" + z + ", " + y + ", " + x + ")";
    expect("v.npy", npy_text(1, dictionary("<f8", false, shape)));
    expect("f.npy", npy_text(2, dictionary("|u1", true, shape)));
  }
  const auto chunk = [](const std::string& name, const std::string& content) {
    return name + little_endian(content.size(), 4) + little_endian(0, 4) + content;
  };
  const auto vox = [&](std::uint64_t size, std::uint64_t voxels) {
    const std::string chunks =
        chunk("SIZE", little_endian(size, 4) + little_endian(size, 4) + little_endian(size, 4)) +
        chunk("XYZI", little_endian(voxels, 4));
    return "VOX " + little_endian(150, 4) + "MAIN" + little_endian(0, 4) +
           little_endian(chunks.size() + 100, 4) + chunks;
  };
  expect("size.vox", vox(0x7fffffff, 1));
  expect("count.vox", vox(256, 0x7fffffff));
  const auto expect_vti = [&](const std::string& n, const std::string& format,
                              const std::string& more) {
    const std::string extent = "Extent=\"0 " + n + " 0 " + n + " 0 " + n + "\">";
    const std::string data(100, '1');  // numbers, digits of base64 or bytes
    const bool appended = format == "appended";
    write_file(
        folder / "v.vti",
        "<VTKFile type=\"ImageData\"" + more + "><ImageData Whole" + extent + "<Piece " + extent +
            "<PointData><DataArray type=\"UInt8\" Name=\"v\" offset=\"0\" format=\"" + format +
            "\">" + (appended ? "" : data) + "</DataArray></PointData></Piece></ImageData>" +
            (appended ? "<AppendedData encoding=\"raw\">_" + data + "</AppendedData>" : "") +
            "</VTKFile>");
    expect_refused_at_once(folder / "v.vti");
  };
  // 2000 cubed takes a GB of bits, which there may be.
  for (const std::string& n : {k31, k63, std::string("1999")}) {
    for (const char* format : {"ascii", "binary", "appended"}) {
      expect_vti(n, format, "");
      expect_vti(n, format, " compressor=\"vtkZLibDataCompressor\"");
    }
  }
  const std::string axis = "1099511627776";  // 2^40
  expect("cube.raw", "", {"--size", k31 + "," + k31 + "," + k31, "--type", "u8"});
  expect("row.raw", "", {"--size", axis + ",8388607,1", "--type", "f64"});
}

TEST(ClaimedSizes, OfMeshesAreRefusedAtOnce) {
  const Folder folder;
  const auto expect = [&](const std::string& name, const std::string& bytes) {
    write_file(folder / name, bytes);
    expect_refused_at_once(folder / name);
  };
  for (const std::string& n : {k31, k63, std::string("2000000000")}) {
    expect("v.off", "OFF\n" + n + " 1 0\n0 0 0\n");
    expect("f.off", "OFF\n1 " + n + " 0\n0 0 0\n");
    for (const std::string format : {"ascii", "binary_little_endian"}) {
      const std::string head = "ply\nformat " + format + " 1.0\nelement vertex ";
      const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
      const std::string faces = "element face " + n + "\nproperty list uchar int vertex_indices\n";
      expect("v.ply", head + n + "\n" + xyz + "end_header\n0 0 0\n");
      expect("none.ply", head + n + "\nend_header\n0 0 0\n");  // without a property
      expect("f.ply", head + "1\n" + xyz + faces + "end_header\n" + std::string(12, '0') + "\n");
    }
    expect("v.obj", "# libdsc: " + n + " vertices, " + n + " faces\nv 0 0 0\n");
  }
  expect("t.stl", std::string(80, ' ') + little_endian(0xffffffff, 4) + std::string(50, '\0'));
  expect("c.om", "OM\x03\x40" + little_endian(0xffffffff, 4) + little_endian(0xffffffff, 4) +
                     little_endian(0xffffffff, 4) + std::string(100, '\1'));
}

TEST(ClaimedSizes, OfImagesAreRefusedAtOnce) {
#ifndef DSC_IMAGE_READER
  GTEST_SKIP() << "built without DSC_WITH_ITK";
#endif
  const Folder folder;
  const TestImage image = random_image(1);
  const auto expect = [&](const std::string& name, const std::string& bytes) {
    write_file(folder / name, bytes);
    expect_refused_at_once(folder / name, {}, kCpuSecondsOfProcesses);
  };
  // 377 bytes: NIfTI of 2100^3 shorts, 18 GB, and of 32767^3.
  for (const int size : {2100, 32767}) {
    std::string nii = nii_bytes(image).substr(0, 377);
    for (std::size_t a = 0; a < 3; ++a) {
      nii.replace(42 + 2 * a, 2, little_endian(static_cast<std::uint64_t>(size), 2));
    }
    expect("v.nii", nii);
    expect("v.nii.gz", gzipped(nii));
  }
  std::string nifti2(540, '\0');
  nifti2.replace(0, 4, little_endian(540, 4)).replace(4, 8, std::string("n+2\0\r\n\x1a\n", 8));
  nifti2.replace(12, 2, little_endian(2, 2)).replace(14, 2, little_endian(8, 2));  // u8
  for (const std::uint64_t n : {std::uint64_t{1} << 31, ~std::uint64_t{0} >> 1}) {
    nifti2.replace(16, 8, little_endian(3, 8)).replace(168, 8, little_endian(544, 8));
    for (std::size_t a = 0; a < 3; ++a) nifti2.replace(24 + 8 * a, 8, little_endian(n, 8));
    expect("two.nii", nifti2 + "1234");
  }
  for (const std::string& sizes : {k31 + " " + k31 + " " + k31, k63 + " 1 1"}) {
    for (const char* name : {"v.nrrd", "v.mha"}) {
      std::string bytes = name[2] == 'n' ? nrrd_bytes(image) : mha_bytes(image);
      expect(name, bytes.replace(bytes.find("7 6 5"), 5, sizes));
    }
  }
  // Width and height stand in the first two entries of the directory, twelve bytes each.
  std::string tiff = tiff_bytes(image, 0, 1);
  for (const std::size_t entry : {0, 1}) {
    tiff.replace(8 + 2 + 12 * entry + 8, 4, little_endian(0xffffffff, 4));
  }
  expect("v.tif", tiff);
  // Rows and columns of one slice.
  std::filesystem::create_directory(folder / "series");
  std::string dicom = dicom_bytes(image, 0, "1.2.3");
  for (const char number : {'\x10', '\x11'}) {
    const std::string tag = std::string("\x28\0", 2) + number + std::string("\0US", 3);
    dicom.replace(dicom.find(tag) + 8, 2, little_endian(0xffff, 2));
  }
  write_file(folder / "series/1", dicom);
  expect_refused_at_once(folder / "series", {}, kCpuSecondsOfProcesses);
}

TEST(MaxMemory, IsASizeInBytes) {
  const Words sphere = {"info", "shape:sphere", "--gridstep", "0.1", "--max-memory"};
  const auto with = [&](const std::string& size) {
    Words words = sphere;
    words.push_back(size);
    return run_dsc(words);
  };
  for (const char* size : {"2G", "2000M", "0.5G", "1e9", "3000000K", "500000000"}) {
    EXPECT_EQ(with(size).exit_code, 0) << size;
  }
  for (const char* wrong : {"", "0", "-1G", "2g", "2GB", "G", "50%", "nan", "inf", "1e30", "0.1"}) {
    const Outcome outcome = with(wrong);
    EXPECT_EQ(outcome.exit_code, 2) << wrong;
    EXPECT_NE(outcome.err.find("--max-memory"), std::string::npos) << outcome.err;
  }
  const Outcome outcome = with("1000K");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_NE(outcome.err.find("'digitize'"), std::string::npos) << outcome.err;
}

/// Every subcommand asks, and its refusal says which stage, how much and what helps.
TEST(MaxMemory, TooLargeIsASentence) {
  const Folder folder;
  const Words commands[] = {{"info"},
                            {"surface", "-o", folder / "s.ply"},
                            {"normals", "-o", folder / "s.ply"},
                            {"gradient", "--function", "x", "-o", folder / "s.ply"},
                            {"diffuse", "--source", "0,0,1", "--time", "1", "-o", folder / "s.ply"},
                            {"geodesic", "--source", "0,0,1", "-o", folder / "s.ply"},
                            {"spectrum", "-o", folder / "s.ply"},
                            {"curvature", "-o", folder / "s.ply"},
                            {"laplacian", "--function", "x", "-o", folder / "s.ply"},
                            {"poisson", "--rhs", "x", "-o", folder / "s.ply"},
                            {"voxels", "-o", folder / "s.vti"}};
  for (Words words : commands) {
    SCOPED_TRACE(words[0]);
    // Voxels alone take a bit each, and so a finer grid.
    const char* gridstep = words[0] == "voxels" ? "0.002" : "0.007";
    words.insert(words.end(), {"shape:sphere", "--gridstep", gridstep, "--max-memory", "60M"});
    const Outcome outcome = run_dsc(words);
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    for (const char* part :
         {"the stage '", "needs about", "60.0 MiB are allowed by --max-memory", "coarser grid"}) {
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(folder.names(), Words{});
  }
}

/// So do pictures and pages, when the surface is there already.
TEST(MaxMemory, TooLargeToBeSeenIsASentence) {
  const Folder folder;
  const std::string voxels = folder / "v.vol";  // of a shape the errors would be measured, too
  ASSERT_EQ(run_dsc({"voxels", "shape:sphere", "--gridstep", "0.01", "-o", voxels}).exit_code, 0);
  for (const std::string& ending : seen_endings()) {
    const Words words = {"curvature",    voxels, "--radius", "0.1", "-o", folder / ("s." + ending),
                         "--max-memory", "82M"};
    expect_refused(run_dsc(words), 4,
                   {ending == "png" ? "'draw'" : "'page'", "needs about", "82.0 MiB are allowed"});
    EXPECT_EQ(folder.names(), Words{"v.vol"});
  }
}

/// Runs stay within a limit, wherever that lies and whether they end or are refused, but for what
/// the allocator keeps and threads take.
class BoundedRuns {
 public:
  /// \param in_child see run_dsc().
  void run(const Words& job, const std::vector<int>& limits,
           const std::function<void()>& in_child = {}) {
    for (const int mebi : limits) {
      const Outcome outcome =
          run_dsc(job + Words{"--max-memory", std::to_string(mebi) + "M"}, in_child);
      ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 4) << outcome.err;
      ++(outcome.exit_code == 0 ? done : refused);
      EXPECT_LE(outcome.peak_bytes, (mebi + 10) * kMebi)
          << job[0] << " " << job[1] << " within " << mebi << " MiB: " << outcome.err;
    }
  }
  int done = 0, refused = 0;
};

TEST(MaxMemory, BoundsARun) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  const Folder folder;
  std::vector<Words> jobs = {{"geodesic", "--source", "0,0,1", "--method", "bands"},
                             {"geodesic", "--source", "0,0,1", "--method", "direct"},
                             {"poisson", "--rhs", "x"},
                             {"poisson", "--rhs", "x", "--compare", "naive"},
                             {"diffuse", "--source", "0,0,1", "--time", "0.1"},
                             {"gradient", "--function", "x*y", "--compare", "naive"},
                             {"spectrum", "-k", "20"},
                             {"normals", "-o", folder / "s.glb"}};
  for (const std::string& ending : seen_endings()) {
    jobs.push_back({"normals", "-o", folder / ("s." + ending)});
    if (ending == "png") jobs.back() = jobs.back() + Words{"--picture-size", "1500,1000"};
  }
  BoundedRuns runs;
  for (const Words& job : jobs) {
    runs.run(job + Words{"shape:sphere", "--gridstep", "0.02", "--estimator", "trivial"},
             {30, 50, 75, 100, 150, 200, 300, 400});
  }
  EXPECT_GE(runs.refused, 4);
  EXPECT_GE(runs.done, 8);
  runs.run({"curvature", "shape:sphere", "--gridstep", "0.01", "--radius", "0.1"},
           {30, 60, 75, 90, 110, 130});
}

TEST(MaxMemory, BoundsReading) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  const Folder folder;
  BoundedRuns runs;
  for (const std::string ending : {"off", "obj", "ply", "stl", "om"}) {
    const std::string mesh = folder / ("m." + ending);
    ASSERT_EQ(run_dsc({"surface", "shape:sphere", "--gridstep", "0.01", "-o", mesh}).exit_code, 0);
    runs.run({"info", mesh}, {20, 30, 40, 55, 80, 120});
  }
  EXPECT_GE(runs.refused, 5);
  EXPECT_GE(runs.done, 5);

  std::string list;
  for (int i = 0; i < 160 * 160 * 160; ++i) {
    list += {static_cast<char>(i % 160), static_cast<char>(i / 160 % 160),
             static_cast<char>(i / 25600), 1};
  }
  const std::string size = little_endian(160, 4);
  const std::string chunks = "SIZE" + little_endian(12, 4) + little_endian(0, 4) + size + size +
                             size + "XYZI" + little_endian(list.size() + 4, 4) +
                             little_endian(0, 4) + little_endian(list.size() / 4, 4);
  write_file(folder / "v.vox", "VOX " + little_endian(150, 4) + "MAIN" + little_endian(0, 4) +
                                   little_endian(chunks.size() + list.size(), 4) + chunks + list);
  runs.run({"info", folder / "v.vox"}, {15, 25, 60});

  write_file(folder / "v.vol",
             vol_text("X: 400\nY: 300\nZ: 250\n", "2") + std::string(29999999, '\0') + "\1");
  runs.run({"info", "vol:-"}, {20, 40, 80}, [&] {
    const int file = ::open((folder / "v.vol").c_str(), O_RDONLY);
    ::dup2(file, STDIN_FILENO);
  });
}

}  // namespace
}  // namespace dsc::test
