#include "tests/benchmarks/measure.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace dsc::benchmarks {
namespace {

/// A line of /proc/self/status, in bytes.
double status(const std::string& key) {
  std::ifstream file("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (file >> word) {
    if (word == key && file >> kilobytes) return 1024. * kilobytes;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return 0;
}

}  // namespace

double settle_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak becomes what is resident now
  return resident_bytes();
}

double resident_bytes() { return status("VmRSS:"); }

double peak_bytes() { return status("VmHWM:"); }

void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, 64 << 20);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void note_floor(benchmark::State& state, double work, const char* ceiling) {
  state.counters["floor"] = work;
  state.SetLabel(ceiling);
}

}  // namespace dsc::benchmarks
