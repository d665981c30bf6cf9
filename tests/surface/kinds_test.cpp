// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/kinds.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "kappa/search/fitted_normals.hpp"
#include "kappa/surface/delaunay.hpp"

namespace kappa {
namespace {

/// Every value of an enum with `count` values has a word, no two rows have the same word, and every row has a meaning.
template <class Enum>
void expect_complete(std::size_t count) {
  std::set<std::string> words;
  std::set<Enum> values;
  for (const Named<Enum>& named : names_of(Enum{})) {
    EXPECT_TRUE(words.insert(named.name).second) << named.name;
    EXPECT_STRNE(named.meaning, "") << named.name;
    values.insert(named.value);
  }
  EXPECT_EQ(values.size(), count);
  for (std::size_t i = 0; i < count; ++i) EXPECT_STRNE(name(static_cast<Enum>(i)), "") << i;
  EXPECT_STREQ(name(static_cast<Enum>(count)), "") << "there are more values than the test knows";
}

TEST(Kinds, EveryValueHasItsOwnWord) {
  expect_complete<SurfaceKind>(11);
  expect_complete<NormalsKind>(9);
  expect_complete<Orientation>(6);
  expect_complete<TriangleScheme>(4);
  expect_complete<PlanDuplicates>(2);
  expect_complete<NormalFit>(3);
}

TEST(Kinds, TheFirstWordOfAValueIsItsName) {
  EXPECT_STREQ(name(Orientation::Consistent), "mst");
  EXPECT_STREQ(name(SurfaceKind::AveragedHexagram), "avg-hexagram");
}

TEST(Kinds, AKindWithoutFacesHasTheNameOfItsScheme) {
  std::size_t schemes = 0;
  for (const Named<SurfaceKind>& kind : names_of(SurfaceKind{})) {
    const auto scheme = triangle_scheme(kind.value);
    if (!scheme) continue;
    ++schemes;
    EXPECT_STREQ(name(*scheme), kind.name);
    EXPECT_FALSE(has_turned_faces(kind.value));
  }
  EXPECT_EQ(schemes, 4u);
}

}  // namespace
}  // namespace kappa
