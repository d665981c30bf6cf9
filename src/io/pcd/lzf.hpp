// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace kappa::io {

/// Expands an LZF stream, the compression of PCD files.
/// @returns false unless the stream is sound and expands to exactly `size` bytes.
bool expand_lzf(std::string_view stream, std::size_t size, std::string& out);

/// No LZF stream expands more: three bytes stand for 264 at most.
inline constexpr std::size_t kLzfLargestRatio = 88;

}  // namespace kappa::io
