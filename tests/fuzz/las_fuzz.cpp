// SPDX-License-Identifier: BSD-3-Clause
// Entry of libFuzzer. Run: las_fuzz -max_total_time=600 -max_len=4096 NEW_FOLDER tests/fuzz/corpus/las
#include <cstddef>
#include <cstdint>

#include "las_check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kappa::fuzz::check_las(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
