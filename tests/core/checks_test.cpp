// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/checks.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace kappa {
namespace {

TEST(Checks, OneEachNamesBothCounts) {
  EXPECT_NO_THROW(check_one_each(3, "normal", 3, "point"));
  test::expect_error(ErrorCode::InvalidArgument, [] { check_one_each(12, "normal", 10, "point"); },
                     {"12 normals for 10 points: give one a point"});
  test::expect_error(ErrorCode::InvalidArgument, [] { check_one_each(1, "shape operator", 2, "vertex"); },
                     {"1 shape operators for 2 vertices: give one a vertex"});
}

TEST(Checks, RangesAreClosed) {
  EXPECT_NO_THROW(check_range("neighbours", 3, 3, 255, "a star"));
  EXPECT_NO_THROW(check_range("neighbours", 255, 3, 255, "a star"));
  for (const long value : {2L, 256L}) {
    test::expect_error(ErrorCode::InvalidArgument, [&] { check_range("neighbours", value, 3, 255, "a star"); },
                       {"neighbours = " + std::to_string(value) + ": give 3 to 255 for a star"});
  }
}

}  // namespace
}  // namespace kappa
