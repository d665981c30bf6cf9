// SPDX-License-Identifier: BSD-3-Clause
#include "rows.hpp"

#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "coordinate.hpp"
#include "scalar.hpp"

namespace kappa::io {

namespace {

constexpr std::size_t kRows = 1024;  // in memory that stays near

/// Rows [begin, end) of a file, filled column by column.
class RowBlock {
 public:
  explicit RowBlock(const Scan& scan) : scan_(scan), size_((scan.normals.empty() ? 3 : 6) * sizeof(double)) {
    for (const Field& field : scan.fields) size_ += size_of(scalar_of(field.type));
  }

  const std::string& fill(std::size_t begin, std::size_t end) {
    rows_ = end - begin;
    offset_ = 0;
    bytes_.resize(rows_ * size_);
    values_.resize(rows_);
    for (int axis = 0; axis < 3; ++axis)
      add_each([&](std::size_t row) { return coordinate(scan_, begin + row, axis); });
    for (int axis = 0; axis < 3 && !scan_.normals.empty(); ++axis)
      add_each([&](std::size_t row) { return scan_.normals[begin + row][axis]; });
    for (const Field& field : scan_.fields) add(field.values.data() + begin, scalar_of(field.type));
    return bytes_;
  }

 private:
  template <class Value>
  void add_each(const Value& value) {
    for (std::size_t row = 0; row < rows_; ++row) values_[row] = value(row);
    add(values_.data(), Scalar::Float64);
  }

  void add(const double* column, Scalar type) {
    store(column, rows_, type, &bytes_[offset_], size_);
    offset_ += size_of(type);
  }

  const Scan& scan_;
  std::size_t size_;  ///< of a row
  std::size_t rows_ = 0, offset_ = 0;
  std::string bytes_;
  std::vector<double> values_;
};

/// What threads that take parts of a whole in increasing order do one after the other.
class Turns {
 public:
  /// Ends when those before have ended, so that however one is left, those that wait for it go on.
  class Turn {
   public:
    Turn(Turns& turns, std::size_t number) : turns_(turns), number_(number) {}
    ~Turn() {
      wait();
      const std::lock_guard<std::mutex> lock(turns_.mutex_);
      ++turns_.next_;
      turns_.changed_.notify_all();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

    /// Until those before have ended.
    void wait() {
      std::unique_lock<std::mutex> lock(turns_.mutex_);
      turns_.changed_.wait(lock, [&] { return turns_.next_ == number_; });
    }

   private:
    Turns& turns_;
    std::size_t number_;
  };

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0;
};

}  // namespace

void write_rows(std::ostream& out, const Scan& scan, const Execution& run) {
  std::vector<RowBlock> blocks(static_cast<std::size_t>(thread_count(run)), RowBlock(scan));
  Turns turns;
  parallel_for(scan.points.size(), kRows, run, [&](std::size_t begin, std::size_t end, int worker) {
    Turns::Turn turn(turns, begin / kRows);
    const std::string& bytes = blocks[static_cast<std::size_t>(worker)].fill(begin, end);
    turn.wait();
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

}  // namespace kappa::io
