// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/names.hpp"

#include <gtest/gtest.h>

namespace kappa {
namespace {

enum class Fruit { Apple, Pear, Unnamed };

const std::vector<Named<Fruit>>& names_of(Fruit) {
  static const std::vector<Named<Fruit>> names = {{Fruit::Apple, "apple", "round"}, {Fruit::Pear, "pear", "not round"}};
  return names;
}

TEST(Names, AreReadFromTheTableOfTheEnum) {
  EXPECT_STREQ(name(Fruit::Apple), "apple");
  EXPECT_STREQ(name(Fruit::Pear), "pear");
  EXPECT_STREQ(name(Fruit::Unnamed), "");
}

}  // namespace
}  // namespace kappa
