// SPDX-License-Identifier: BSD-3-Clause
// PLY and PCD: a text header, then the same rows of little-endian numbers.
#include <algorithm>
#include <condition_variable>
#include <limits>
#include <mutex>

#include "kappa/scan/scan.hpp"
#include "scalar.hpp"
#include "writers.hpp"

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

/// One thread writes while the others fill blocks.
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

const char* ply_type(Field::Type type) {
  switch (type) {
    case Field::Type::Float32:
      return "float";
    case Field::Type::Int32:
      return "int";
    case Field::Type::UInt32:
      return "uint";
    case Field::Type::UInt16:
      return "ushort";
    case Field::Type::UInt8:
      return "uchar";
    case Field::Type::Float64:
      break;
  }
  return "double";
}

std::size_t largest_face(const Faces& faces) {
  std::size_t largest = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) largest = std::max(largest, faces[f].size());
  return largest;
}

/// How faces are stored: in a byte and an int, as all readers know it, unless the mesh needs more.
struct FaceTypes {
  Scalar count, index;
  const char* text;
};

FaceTypes face_types(const Scan& scan) {
  const bool long_faces = largest_face(scan.faces) > 255;
  const bool many_points = scan.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  const Scalar index = many_points ? Scalar::UInt32 : Scalar::Int32;
  if (long_faces) return {Scalar::Int32, index, many_points ? "int uint" : "int int"};
  return {Scalar::UInt8, index, many_points ? "uchar uint" : "uchar int"};
}

std::string ply_header(const Scan& scan, const FaceTypes& types) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment written by kappa\nelement vertex " +
                       std::to_string(scan.points.size()) + "\n";
  for (const char* name : {"x", "y", "z"}) header += std::string("property double ") + name + "\n";
  for (const char* name : {"nx", "ny", "nz"}) {
    if (!scan.normals.empty()) header += std::string("property double ") + name + "\n";
  }
  for (const Field& field : scan.fields) {
    header += std::string("property ") + ply_type(field.type) + " " + safe_name(field.name) + "\n";
  }
  if (scan.is_mesh()) {
    header +=
        "element face " + std::to_string(scan.faces.size()) + "\nproperty list " + types.text + " vertex_indices\n";
  }
  return header + "end_header\n";
}

std::string pcd_header(const Scan& scan) {
  std::string names = "x y z", sizes = "8 8 8", types = "F F F", counts = "1 1 1";
  const auto add = [&](const std::string& name, Scalar type) {
    names += " " + name;
    sizes += " " + std::to_string(size_of(type));
    types += is_floating(type) ? " F" : (type == Scalar::Int32 ? " I" : " U");
    counts += " 1";
  };
  for (const char* name : {"normal_x", "normal_y", "normal_z"}) {
    if (!scan.normals.empty()) add(name, Scalar::Float64);
  }
  for (const Field& field : scan.fields) add(safe_name(field.name), scalar_of(field.type));
  std::string viewpoint;
  for (int axis = 0; axis < 3; ++axis) append_decimal(viewpoint += " ", scan.viewpoint ? (*scan.viewpoint)[axis] : 0.0);
  const std::size_t width = scan.is_organised() ? scan.width : scan.points.size();
  const std::size_t height = scan.is_organised() ? scan.height : 1;
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + names + "\nSIZE " + sizes + "\nTYPE " +
         types + "\nCOUNT " + counts + "\nWIDTH " + std::to_string(width) + "\nHEIGHT " + std::to_string(height) +
         "\nVIEWPOINT" + viewpoint + " 1 0 0 0\nPOINTS " + std::to_string(scan.points.size()) + "\nDATA binary\n";
}

}  // namespace

void write_ply(std::ostream& out, const Scan& scan, const Execution& run) {
  const FaceTypes types = face_types(scan);
  out << ply_header(scan, types);
  const double share = scan.is_mesh() ? 0.5 : 1.0;
  write_rows(out, scan, stage(run, 0.0, share));
  std::string row;
  for_each_row(scan.faces.size(), stage(run, share, 1.0), [&](std::size_t f) {
    row.clear();
    const Faces::View face = scan.faces[f];
    append(row, static_cast<double>(face.size()), types.count);
    for (const Index corner : face) append(row, corner, types.index);
    out.write(row.data(), static_cast<std::streamsize>(row.size()));
  });
}

void write_pcd(std::ostream& out, const Scan& scan, const Execution& run) {
  out << pcd_header(scan);
  write_rows(out, scan, run);
}

}  // namespace kappa::io
