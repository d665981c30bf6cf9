// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/filter.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "kappa/core/bounds.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 16384;

/// A name without what files write differently: ReturnNumber, return_number.
std::string plain(const std::string& name) {
  std::string letters;
  for (const char c : name) {
    if (c != '_' && c != ' ') letters += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return letters;
}

const Field* find_field(const Scan& scan, const std::vector<std::string>& plain_names) {
  for (const std::string& name : plain_names) {
    for (const Field& field : scan.fields) {
      if (plain(field.name) == name) return &field;
    }
  }
  return nullptr;
}

std::string listed(const std::vector<Field>& fields) {
  std::string names;
  for (const Field& field : fields) names += (names.empty() ? "" : " ") + field.name;
  return names.empty() ? "none" : names;
}

const Field& need_field(const Scan& scan, const std::vector<std::string>& plain_names, const std::string& what,
                        const std::string& path) {
  if (const Field* field = find_field(scan, plain_names)) return *field;
  throw Error(ErrorCode::InvalidData, "'" + path + "': its points have no " + what + " to be selected by (fields: " +
                                          listed(scan.fields) + "); leave the filter out");
}

/// "2 (35123 points), 1 (3244 points)".
std::string classes_in(const Field& field) {
  constexpr std::size_t kShown = 12;
  std::map<double, std::size_t> counts;
  for (const double value : field.values) ++counts[value];
  std::string text;
  std::size_t shown = 0;
  for (const auto& [value, count] : counts) {
    if (++shown > kShown) return text + ", ...";
    text += (text.empty() ? "" : ", ") + std::to_string(static_cast<long>(value)) + " (" + std::to_string(count) +
            " points)";
  }
  return text;
}

/// One selection under way.
class Selection {
 public:
  Selection(const Scan& scan, const PointFilter& filter, const std::string& path)
      : scan_(scan), filter_(filter), path_(path), kept_(scan.points.size(), 1) {}

  FilterCounts run(const Execution& run) {
    const std::size_t unplaced =
        drop([&](std::size_t i) { return is_finite(scan_.points[i]); }, "", stage(run, 0.0, 0.25));
    // Points without a position stay in a grid; whoever measures counts them.
    if (!scan_.is_organised()) counts_.unplaced = unplaced;
    if (!filter_.classes.empty()) by_class(stage(run, 0.25, 0.5));
    if (filter_.returns != Returns::All) by_returns(stage(run, 0.5, 0.75));
    if (filter_.bounds) by_bounds(stage(run, 0.75, 1.0));
    return counts_;
  }

  const std::vector<char>& kept() const { return kept_; }

 private:
  /// Takes away every point that `stays` refuses, and counts them. One must be left; else the message ends with `hint`.
  template <class Stays>
  std::size_t drop(const Stays& stays, const std::string& hint, const Execution& run) {
    std::size_t dropped = 0, left = 0;
    serial_for(kept_.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!kept_[i]) continue;
        const bool goes = !stays(i);
        dropped += goes;
        left += !goes;
        if (goes) kept_[i] = 0;
      }
    });
    if (left == 0) throw Error(ErrorCode::InvalidData, "'" + path_ + "': no point is left" + hint);
    return dropped;
  }

  void by_class(const Execution& run) {
    const Field& field = need_field(scan_, {"classification", "class"}, "classification", path_);
    const std::vector<int>& classes = filter_.classes;
    counts_.by_class = drop(
        [&](std::size_t i) {
          return std::any_of(classes.begin(), classes.end(), [&](int c) { return field.values[i] == c; });
        },
        " by the selection of classes: it has " + classes_in(field), run);
  }

  void by_returns(const Execution& run) {
    const Field& number = need_field(scan_, {"returnnumber"}, "return number", path_);
    const auto is_unset = [](double value) { return value == 0; };
    if (std::all_of(number.values.begin(), number.values.end(), is_unset)) {
      throw Error(ErrorCode::InvalidData,
                  "'" + path_ + "': its return numbers are all 0, so they were not recorded: select all returns");
    }
    if (filter_.returns == Returns::First) {
      counts_.by_returns = drop([&](std::size_t i) { return number.values[i] == 1; }, ": it has no first return", run);
      return;
    }
    const Field& of = need_field(scan_, {"numberofreturns"}, "number of returns", path_);
    counts_.by_returns =
        drop([&](std::size_t i) { return number.values[i] == of.values[i]; }, ": it has no last return", run);
  }

  void by_bounds(const Execution& run) {
    if (!((filter_.bounds->min.array() <= filter_.bounds->max.array()).all())) {
      throw Error(ErrorCode::InvalidArgument, "'" + path_ +
                                                  "': its points cannot be selected by bounds of which a "
                                                  "least coordinate is above the greatest; swap them");
    }
    Vec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = local(filter_.bounds->min[axis], axis, -1);
      high[axis] = local(filter_.bounds->max[axis], axis, 1);
    }
    const auto inside = [&](std::size_t i) {
      const auto p = scan_.points[i].array();
      return (p >= low.array()).all() && (p <= high.array()).all();
    };
    const Bounds box = bounds(scan_.points);
    counts_.by_bounds =
        drop(inside, " within the bounds: its points are between " + corner(box.min) + " and " + corner(box.max), run);
  }

  /// A bound relative to the origin, moved outwards by what the coordinates of the file are rounded by.
  double local(double bound, int axis, int outwards) const {
    if (std::isinf(bound)) return bound;
    const double origin = scan_.origin[axis];
    return bound - origin + outwards * 0x1p-52 * std::max(std::abs(bound), std::abs(origin));
  }

  std::string corner(const Vec3& local) const {
    const Vec3 p = scan_.origin + local;
    return std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z());
  }

  const Scan& scan_;
  const PointFilter& filter_;
  const std::string& path_;
  std::vector<char> kept_;
  FilterCounts counts_;
};

}  // namespace

const std::vector<Named<Returns>>& names_of(Returns) {
  static const std::vector<Named<Returns>> names = {
      {Returns::All, "all", "every return"},
      {Returns::First, "first", "the first return of each pulse"},
      {Returns::Last, "last", "the last return of each pulse"},
  };
  return names;
}

std::vector<Index> find_no_returns(const Scan& scan) {
  constexpr std::size_t kFewest = 10, kShare = 1000;
  std::vector<Index> found;
  if (scan.is_mesh()) return found;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if ((scan.points[i] + scan.origin).isZero(0)) found.push_back(static_cast<Index>(i));
  }
  const bool are_many = found.size() >= kFewest && found.size() * kShare > scan.points.size();
  return are_many ? found : std::vector<Index>();
}

SetAside::SetAside(Scan& scan, std::vector<Index> points) : points_(scan.points.size()), indices_(std::move(points)) {
  for (const Index i : indices_) {
    if (i >= points_)
      throw Error(ErrorCode::InvalidArgument, "point " + std::to_string(i) + " of " + std::to_string(points_) +
                                                  " cannot be set aside: give an index below their number");
    positions_.push_back(scan.points[i]);
  }
  for (const Index i : indices_) scan.points[i].setConstant(kNaN);
}

void SetAside::restore(Scan& scan) const {
  if (scan.points.size() != points_) return;
  for (std::size_t k = 0; k < indices_.size(); ++k) scan.points[indices_[k]] = positions_[k];
}

std::vector<Index> find_withheld(const Scan& scan) {
  std::vector<Index> found;
  const Field* const flags = scan.is_mesh() ? nullptr : find_field(scan, {"withheld"});
  for (std::size_t i = 0; flags && i < scan.points.size(); ++i) {
    if (flags->values[i] == 1 && is_finite(scan.points[i])) found.push_back(static_cast<Index>(i));
  }
  return found;
}

FilterCounts select_points(Scan& scan, const PointFilter& filter, const std::string& path, const Execution& run) {
  if (filter.classes.empty() && filter.returns == Returns::All && !filter.bounds) return {};
  Selection selection(scan, filter, path);
  const FilterCounts counts = selection.run(stage(run, 0.0, 0.5));
  leave_out(scan, selection.kept(), stage(run, 0.5, 1.0));
  return counts;
}

void leave_out(Scan& scan, const std::vector<char>& kept, const Execution& run) {
  check_one_each(kept.size(), "mark", scan.points.size(), "point");
  if (scan.is_organised() && !scan.is_mesh()) {
    report_progress(run, 1.0);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (!kept[i]) scan.points[i].setConstant(kNaN);
    }
    return;
  }
  std::vector<Index> indices;
  serial_for(kept.size(), kBlock, stage(run, 0.0, 0.2), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (kept[i]) indices.push_back(static_cast<Index>(i));
    }
  });
  if (indices.size() < kept.size() || scan.is_mesh()) keep_points(scan, indices, stage(run, 0.2, 1.0));
}

}  // namespace kappa
