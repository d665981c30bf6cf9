// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kappa/core/names.hpp"

namespace kappa::test {

/// The table of an enum must have these words, in the order of the values from 0 on, each with a meaning.
template <class Enum>
void expect_names(const std::vector<std::string>& words) {
  const std::vector<Named<Enum>>& names = names_of(Enum{});
  ASSERT_EQ(names.size(), words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(names[i].value), i);
    EXPECT_EQ(names[i].name, words[i]);
    EXPECT_GT(std::string(names[i].meaning).size(), 0U) << words[i];
    EXPECT_EQ(name(static_cast<Enum>(i)), words[i]);
  }
  EXPECT_STREQ(name(static_cast<Enum>(words.size())), "") << "a value without a word";
}

}  // namespace kappa::test
