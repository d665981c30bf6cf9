// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "kappa/core/error.hpp"

namespace kappa::test {

/// `call` must throw an Error of this code, whose message has all these words.
inline void expect_error(ErrorCode code, const std::function<void()>& call, const std::vector<std::string>& words) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code) << e.what();
    for (const std::string& word : words) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << '"' << word << "\" not in: " << e.what();
    }
  }
}

}  // namespace kappa::test
