// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/balls/measure_options.hpp"

#include "kappa/core/error.hpp"

namespace kappa {

const std::vector<Named<QuadMeasures>>& names_of(QuadMeasures) {
  static const std::vector<Named<QuadMeasures>> names = {
      {QuadMeasures::Split, "split", "four triangles at the barycentre"},
      {QuadMeasures::Bilinear, "bilinear", "one bilinear patch"}};
  return names;
}

const std::vector<Named<Precision>>& names_of(Precision) {
  static const std::vector<Named<Precision>> names = {
      {Precision::Double, "double", "all in double"},
      {Precision::Fast, "fast", "floats on the rim of the ball, 1e-6 of the measures"}};
  return names;
}

const std::vector<Named<Engine>>& names_of(Engine) {
  static const std::vector<Named<Engine>> names = {{Engine::Tree, "tree", "a hierarchy of sums"},
                                                   {Engine::Flann, "flann", "a plain search, slower, for comparison"}};
  return names;
}

void validate(const MeasureOptions& options) {
  if (options.refine < 0 || options.refine > kMostRefinements)
    throw OptionError("refine", "= " + std::to_string(options.refine) + ": give 0 to " +
                                    std::to_string(kMostRefinements) + ", the times that a face is split in four");
  if (options.refine > 0 && options.quads == QuadMeasures::Bilinear)
    throw OptionError("refine", "splits triangles; leave `quads` bilinear out");
}

}  // namespace kappa
