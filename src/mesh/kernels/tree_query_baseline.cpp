// SPDX-License-Identifier: BSD-3-Clause
#include "tree_query.hpp"

namespace kappa::kernels {

void query_baseline(const TreeView<double>& tree, const BallQuery& query) {
  run_query(tree, query);
}
void query_baseline(const TreeView<float>& tree, const BallQuery& query) {
  run_query(tree, query);
}

}  // namespace kappa::kernels
