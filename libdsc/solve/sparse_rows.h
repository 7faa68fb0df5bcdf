/// \file
/// \internal
/// Compressed sparse rows, read and built in parallel: the matrices of the multigrid hierarchy.
///
/// A symmetric column-major Eigen matrix is its own row-major form, so its arrays can be viewed.
#pragma once

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dsc {

/// Rows that one chunk of a parallel loop takes. Fixed, so that results never depend on threads.
inline constexpr Index kRowGrain = 8192;

/// Arrays of a sparse matrix that somebody else owns: row i has entries start[i] .. start[i + 1].
template <class Value>
struct RowsView {
  Index rows = 0;
  const int* start = nullptr;
  const int* column = nullptr;
  const Value* value = nullptr;

  Index nonzeros() const { return rows == 0 ? 0 : start[rows]; }

  /// Entry i of the product with x, accumulated in Value's precision.
  template <class Vector>
  Value row_times(Index i, const Vector* x) const {
    Value sum = 0;
    for (int k = start[i]; k < start[i + 1]; ++k) sum += value[k] * x[column[k]];
    return sum;
  }
};

template <class Value>
struct SparseRows {
  Index columns = 0;
  std::vector<int> start{0};
  std::vector<int> column;
  std::vector<Value> value;

  Index rows() const { return static_cast<Index>(start.size()) - 1; }
  RowsView<Value> view() const { return {rows(), start.data(), column.data(), value.data()}; }
  Index bytes() const {
    return static_cast<Index>(start.capacity() * sizeof(int) + column.capacity() * sizeof(int) +
                              value.capacity() * sizeof(Value));
  }
};

/// Sums the terms of one sparse row, given in any order with repeats: a small hash table.
class RowSum {
 public:
  RowSum() { resize(64); }

  void add(int column, double value) {
    std::size_t slot = hash(column);
    while (keys_[slot] != column) {
      if (keys_[slot] < 0) {
        if (2 * (used_.size() + 1) > keys_.size()) {
          grow();
          return add(column, value);
        }
        keys_[slot] = column;
        sums_[slot] = 0;
        used_.push_back(static_cast<int>(slot));
        break;
      }
      slot = (slot + 1) & (keys_.size() - 1);
    }
    sums_[slot] += value;
  }

  /// Calls visit(column, sum) in ascending order of columns and empties the row.
  template <class Visit>
  void drain(Visit&& visit) {
    std::sort(used_.begin(), used_.end(), [&](int a, int b) { return key(a) < key(b); });
    for (const int slot : used_) {
      visit(key(slot), sums_[slot]);
      keys_[slot] = -1;
    }
    used_.clear();
  }

 private:
  int key(int slot) const { return keys_[slot]; }
  std::size_t hash(int column) const {
    return (static_cast<std::uint32_t>(column) * 2654435769u) >> shift_;
  }
  void resize(std::size_t size) {
    keys_.assign(size, -1);
    sums_.assign(size, 0.0);
    shift_ = 32;
    for (std::size_t s = size; s > 1; s /= 2) --shift_;
  }
  void grow() {
    std::vector<std::pair<int, double>> entries;
    for (const int slot : used_) entries.emplace_back(key(slot), sums_[slot]);
    used_.clear();
    resize(2 * keys_.size());
    for (const auto& [column, sum] : entries) add(column, sum);
  }

  std::vector<int> keys_;  // -1: free
  std::vector<double> sums_;
  std::vector<int> used_;
  int shift_ = 32;
};

/// Builds a matrix row by row: fill(i, row) adds the terms of row i to an empty RowSum.
/// \throws LimitError past 2^31 - 1 nonzeros.
template <class Value, class Fill>
SparseRows<Value> build_rows(const Context& context, Index rows, Index columns, Fill&& fill) {
  struct Piece {
    std::vector<int> column;
    std::vector<Value> value;
  };
  constexpr Index kGrain = 2048;
  std::vector<Piece> pieces((rows + kGrain - 1) / kGrain);
  SparseRows<Value> result;
  result.columns = columns;
  result.start.assign(rows + 1, 0);
  parallel_for(context, rows, kGrain, [&](Index first, Index last) {
    Piece& piece = pieces[first / kGrain];
    RowSum row;
    for (Index i = first; i < last; ++i) {
      fill(i, row);
      row.drain([&](int column, double sum) {
        piece.column.push_back(column);
        piece.value.push_back(static_cast<Value>(sum));
      });
      result.start[i + 1] = static_cast<int>(piece.column.size());
    }
  });
  std::vector<Index> offset(pieces.size() + 1, 0);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    offset[p + 1] = offset[p] + static_cast<Index>(pieces[p].column.size());
  }
  const VertexId nonzeros = checked_id(offset.back(), "sparse matrix entries");
  result.column.resize(nonzeros);
  result.value.resize(nonzeros);
  parallel_for(context, rows, kGrain, [&](Index first, Index last) {
    Piece& piece = pieces[first / kGrain];
    const Index shift = offset[first / kGrain];
    for (Index i = first; i < last; ++i) result.start[i + 1] += static_cast<int>(shift);
    std::copy(piece.column.begin(), piece.column.end(), result.column.begin() + shift);
    std::copy(piece.value.begin(), piece.value.end(), result.value.begin() + shift);
    piece = {};
  });
  return result;
}

/// The transpose, each row in ascending order of columns.
template <class Value>
SparseRows<Value> transpose(const SparseRows<Value>& a) {
  SparseRows<Value> t;
  t.columns = a.rows();
  t.start.assign(a.columns + 1, 0);
  t.column.resize(a.column.size());
  t.value.resize(a.value.size());
  for (const int j : a.column) ++t.start[j + 1];
  for (std::size_t j = 1; j < t.start.size(); ++j) t.start[j] += t.start[j - 1];
  std::vector<int> next(t.start.begin(), t.start.end() - 1);
  for (std::size_t i = 0; i + 1 < a.start.size(); ++i) {
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      const int slot = next[a.column[k]]++;
      t.column[slot] = static_cast<int>(i);
      t.value[slot] = a.value[k];
    }
  }
  return t;
}

}  // namespace dsc
