/// \file
/// What libdsc throws. Every message names the place and the remedy; the program maps each class
/// to one exit code.
#pragma once

#include <stdexcept>
#include <string>

namespace dsc {

/// Base of all errors that a caller can cause; internal errors are asserts.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The call or command line is wrong: an unknown name, an option out of its range (exit 2).
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The data is wrong: a truncated file, NaN positions, an unusable header (exit 3).
class InputError : public Error {
 public:
  using Error::Error;
};

/// The data is too large for memory or for the index types (exit 4).
class LimitError : public Error {
 public:
  using Error::Error;
};

/// A solver failed or missed its tolerance (exit 5).
class SolverError : public Error {
 public:
  using Error::Error;
};

/// A result could not be written: a full disk, a missing folder (exit 3).
class OutputError : public Error {
 public:
  using Error::Error;
};

/// The monitor asked for an end (exit 130).
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace dsc
