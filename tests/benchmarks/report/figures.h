/// \file
/// The figures of the benchmarks, each run in a process of its own.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace report {

enum class Extent {
  full,
  quick,  ///< surfaces below 150 000 faces, smaller jobs
  smoke,  ///< the smallest surface and job: whether everything runs
};

/// One benchmark's.
struct Figure {
  std::string name;    ///< `extract/n:303`
  std::string family;  ///< `extract`: the name without its size
  double seconds = 0;
  std::string ceiling;  ///< what its floor counts; may be empty
  std::map<std::string, double> counters;

  double faces() const { return counter("faces"); }
  /// \throws std::out_of_range naming both where it has none.
  double counter(const std::string& key) const;
  std::optional<double> maybe(const std::string& key) const;
};

class Figures {
 public:
  /// Runs those of `benchmarks` (the program) that `extent` takes.
  Figures(const std::string& benchmarks, Extent extent);

  const std::vector<Figure>& all() const { return figures_; }
  /// Null where it was not run.
  const Figure* find(const std::string& name) const;
  /// In ascending size.
  std::vector<const Figure*> family(const std::string& name) const;
  std::vector<std::string> families() const;

  /// A ceiling's rate per second: `triad/threads:2`. 0 where the machine lacks what it takes.
  double rate(const std::string& ceiling) const;
  /// The share of its ceiling that a stage reaches, in (0, 1]; none where no floor is known.
  std::optional<double> share(const Figure& figure) const;
  /// The exponent of a family's growth with size by a line through the logarithms, from 0.09
  /// million faces on; none for fewer than two sizes.
  std::optional<double> exponent(const std::string& family) const;

 private:
  std::vector<Figure> figures_;
};

}  // namespace report
