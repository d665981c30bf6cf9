// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/bounds.hpp"
#include "sums.hpp"

// Boxes of nodes against balls, and where the walks of neighbouring queries start. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Bounds of the squared distances of boxes that leave no doubt in spite of the rounding of the boxes' floats: `slack`
/// is what centre and corners may be off by, and a relative 1e-6 is far more than what the sums of squares are.
struct BoxBounds {
  float out_sq, in_sq;
  BoxBounds(double radius, double farthest) {
    constexpr double kRounding = 1.2e-7, kRelative = 1e-6;
    const double slack = kRounding * (farthest > 1 ? farthest : 1);
    const double out = (radius + slack) * (1 + kRelative), in = (radius - slack) * (1 - kRelative);
    out_sq = static_cast<float>(out * out);
    in_sq = in > slack ? static_cast<float>(in * in) : -1.0F;
  }
};

/// A place in the unit of a tree.
struct Place {
  double at[3];
  double farthest = 0;  ///< largest absolute value of a coordinate

  Place(const NodeView& tree, const double* x) {
    for (int axis = 0; axis < 3; ++axis) {
      const double c = (x[axis] - tree.middle[axis]) * tree.unit;
      at[axis] = c;
      farthest = c > farthest ? c : -c > farthest ? -c : farthest;
    }
  }
};

/// Boxes of 8 nodes, and their names.
struct Boxes {
  VF lo[3], hi[3], names;
};

inline Boxes boxes_of(const NodeView& tree, int level, std::uint32_t block) {
  const BoxBlock& b = tree.level[level].boxes[block];
  return {{load<VF>(b.lo[0]), load<VF>(b.lo[1]), load<VF>(b.lo[2])},
          {load<VF>(b.hi[0]), load<VF>(b.hi[1]), load<VF>(b.hi[2])},
          numbers_from(kWidth * block)};
}

inline Boxes boxes_at(const Start& s, int first) {
  const auto row = [&](const float* of) { return load<VF>(of + first); };
  return {{row(s.lo[0]), row(s.lo[1]), row(s.lo[2])},
          {row(s.hi[0]), row(s.hi[1]), row(s.hi[2])},
          load<VF>(s.nodes + first)};
}

/// Squared distances from places [lo, hi] to the nearest point of 8 boxes. Rounded as they are they do not grow with
/// the places or the boxes.
inline VF least_distances(const Boxes& b, const float* lo, const float* hi) {
  const VF zero = spread(0.0F);
  const auto gap_sq = [&](int axis) {
    const VF gap = max(max(b.lo[axis] - spread(hi[axis]), spread(lo[axis]) - b.hi[axis]), zero);
    return gap * gap;
  };
  return gap_sq(0) + gap_sq(1) + gap_sq(2);
}

/// Squared distances from a place to the farthest point of 8 boxes.
inline VF most_distances(const Boxes& b, const float* at) {
  const auto reach_sq = [&](int axis) {
    const VF c = spread(at[axis]), reach = min(b.lo[axis] - c, c - b.hi[axis]);
    return reach * reach;
  };
  return reach_sq(0) + reach_sq(1) + reach_sq(2);
}

inline VF half_diagonals_sq(const Boxes& b) {
  const VF half = spread(0.5F);
  const auto side_sq = [&](int axis) {
    const VF side = half * (b.hi[axis] - b.lo[axis]);
    return side * side;
  };
  return side_sq(0) + side_sq(1) + side_sq(2);
}

inline unsigned at_most(VF values, float bound) {
  return bits(values <= spread(bound));
}

/// Finds the nodes that queries start from.
class Descent {
 public:
  Descent(const NodeView& tree, const double* lo, const double* hi, double radius)
      : tree_(tree), bounds_(bounds(Place(tree, lo), Place(tree, hi), radius * tree.unit)) {
    const Place from(tree, lo), to(tree, hi);
    for (int axis = 0; axis < 3; ++axis) {
      lo_[axis] = static_cast<float>(from.at[axis]);
      hi_[axis] = static_cast<float>(to.at[axis]);
    }
  }

  void run(Start& to) {
    std::uint32_t opened[kOpened] = {0};
    int count = tree_.levels > 0 ? 1 : 0;
    for (to.level = tree_.levels; count > 0;) {
      --to.level;
      if (open(opened, count, to) || to.level == 0 || to.count > kOpened) break;
      count = to.count;
      __builtin_memcpy(opened, to.nodes, sizeof(opened));
    }
    add_empty(to);
  }

 private:
  static constexpr int kOpened = kStart / kWidth;

  static BoxBounds bounds(const Place& lo, const Place& hi, double radius) {
    return BoxBounds(radius, lo.farthest > hi.farthest ? lo.farthest : hi.farthest);
  }

  /// Whether one of the nodes met may be in a ball.
  bool open(const std::uint32_t* blocks, int count, Start& to) const {
    bool held = false;
    to.count = 0;
    for (int i = 0; i < count; ++i) {
      const Boxes b = boxes_of(tree_, to.level, blocks[i]);
      const unsigned met = at_most(least_distances(b, lo_, hi_), bounds_.out_sq);
      held |= (at_most(half_diagonals_sq(b), bounds_.out_sq) & met) != 0;
      const Compression<VF> packed(met);
      for (int axis = 0; axis < 3; ++axis) {
        store(to.lo[axis] + to.count, packed(b.lo[axis]));
        store(to.hi[axis] + to.count, packed(b.hi[axis]));
      }
      store(to.nodes + to.count, packed(b.names));
      to.count += __builtin_popcount(met);
    }
    return held;
  }

  static void add_empty(Start& to) {
    const VF infinity = spread(__builtin_inff());
    for (int axis = 0; axis < 3; ++axis) {
      store(to.lo[axis] + to.count, infinity);
      store(to.hi[axis] + to.count, -infinity);
    }
  }

  const NodeView& tree_;
  BoxBounds bounds_;
  float lo_[3], hi_[3];
};

inline void approach(const NodeView& tree, const double* lo, const double* hi, double radius, Start& start) {
  start.level = start.count = 0;
  Descent(tree, lo, hi, radius).run(start);
}

}  // namespace
}  // namespace kappa::kernels
