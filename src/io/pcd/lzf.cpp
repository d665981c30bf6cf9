// SPDX-License-Identifier: BSD-3-Clause
#include "lzf.hpp"

#include "io/pace.hpp"

namespace kappa::io {

namespace {

/// Takes the next byte off the stream.
bool next_byte(std::string_view& stream, std::size_t& byte) {
  if (stream.empty()) return false;
  byte = static_cast<unsigned char>(stream.front());
  stream.remove_prefix(1);
  return true;
}

bool copy_literals(std::string_view& stream, std::size_t count, std::size_t size, std::string& out) {
  if (count > stream.size() || count > size - out.size()) return false;
  out.append(stream.substr(0, count));
  stream.remove_prefix(count);
  return true;
}

/// Repeats `length` bytes from `distance` back; the two ranges may overlap.
bool copy_back(std::size_t distance, std::size_t length, std::size_t size, std::string& out) {
  if (distance > out.size() || length > size - out.size()) return false;
  const std::size_t from = out.size() - distance;
  for (std::size_t i = 0; i < length; ++i) out.push_back(out[from + i]);
  return true;
}

bool expand_back_reference(std::size_t control, std::string_view& stream, std::size_t size, std::string& out) {
  std::size_t length = control >> 5, extra = 0, low = 0;
  if (length == 7 && !next_byte(stream, extra)) return false;
  if (!next_byte(stream, low)) return false;
  const std::size_t distance = ((control & 31) << 8) + low + 1;
  return copy_back(distance, length + extra + 2, size, out);
}

}  // namespace

bool expand_lzf(std::string_view stream, std::size_t size, std::string& out, const Execution& run) {
  out.clear();
  out.reserve(size);
  Pace pace(run, size, kBytesAtOnce);
  for (std::size_t control = 0; next_byte(stream, control);) {
    const bool sound = control < 32 ? copy_literals(stream, control + 1, size, out)
                                    : expand_back_reference(control, stream, size, out);
    if (!sound) return false;
    pace.at(out.size());
  }
  return out.size() == size;
}

}  // namespace kappa::io
