// SPDX-License-Identifier: BSD-3-Clause
#include "stream.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "kappa/core/error.hpp"
#include "kappa/io/atomic.hpp"

namespace kappa::io {

void write_stream(const std::string& path, const Execution& run, const std::function<void(std::ostream&)>& fill) {
  write_atomically(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    errno = 0;
    if (out) fill(out);
    out.close();
    if (!out) {
      throw Error(ErrorCode::FileWrite,
                  "'" + path + "' cannot be written: " + (errno ? std::strerror(errno) : "the system gave no reason"));
    }
    check_cancelled(run);
  });
}

}  // namespace kappa::io
