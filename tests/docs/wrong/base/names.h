/// \file
/// Names that the check of the docs has to report, and those that it has not to.
#pragma once

namespace dsc {

struct Bare {  // wrong
  int bare;    // wrong
};

/// A class with a comment, some of whose members have none.
class Told {
 public:
  Told(int size, int more);  // wrong
  Told(const Told&) = delete;
  ~Told();
  int size() const { return size_; }  // wrong
  int told = 0;                       ///< has a comment
  int bare = 0;                       // wrong
  /// Members of a group share its comment.
  /// @{
  int first();
  int second();
  /// @}

 private:
  int size_ = 0;
};

/// An enumeration, whose second value has no comment: reported by its name, without a line.
enum class Kind {
  told,  ///< has one
  bare,
};

using Number = double;  // wrong

void function(Number x);  // wrong

namespace detail {
void hidden();
}  // namespace detail

}  // namespace dsc
