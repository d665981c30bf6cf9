// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "kappa/core/execution.hpp"

namespace kappa::io {

/// Expands an LZF stream, the compression of PCD files.
/// @returns false unless the stream is sound and expands to exactly `size` bytes.
/// @throws Cancelled.
bool expand_lzf(std::string_view stream, std::size_t size, std::string& out, const Execution& run);

/// No LZF stream expands more: three bytes stand for 264 at most.
inline constexpr std::size_t kLzfLargestRatio = 88;

}  // namespace kappa::io
