// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace kappa {

enum class ErrorCode {
  InvalidArgument,  ///< a parameter is out of its range
  InvalidData,      ///< points, normals or faces that no result can be had from
  FileNotFound,
  FileFormat,  ///< malformed, or a format or variant that is not read
  FileWrite,
  Unavailable,  ///< something the machine lacks, such as a display
  Cancelled     ///< stopped by `Execution::cancel`; only in a Status, since a call that may throw throws `Cancelled`
};

/// A call that cannot be served. The message names what was wrong (parameter or
/// file, value) and what to do about it, in one sentence fit for a user.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

/// An option that is out of its range or does not go with another one; code InvalidArgument.
class OptionError : public Error {
 public:
  /// The message is "`option` `reason`", such as "min_coverage needs balls: it has no meaning at radius 0".
  OptionError(const std::string& option, const std::string& reason)
      : Error(ErrorCode::InvalidArgument, option + " " + reason), option_(option), reason_(reason) {}
  /// The member of the options struct that is at fault, by which a program finds its own name for it.
  const std::string& option() const noexcept { return option_; }
  const std::string& reason() const noexcept { return reason_; }

 private:
  std::string option_, reason_;
};

/// Thrown when `Execution::cancel` was raised; all outputs are untouched.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Outcome of a call on an interface that must not throw (the PCL adaptor).
class Status {
 public:
  Status() = default;
  Status(ErrorCode code, std::string message) : ok_(false), code_(code), message_(std::move(message)) {}
  bool ok() const noexcept { return ok_; }
  /// Meaningful only if not ok().
  ErrorCode code() const noexcept { return code_; }
  const std::string& message() const noexcept { return message_; }

 private:
  bool ok_ = true;
  ErrorCode code_ = ErrorCode::InvalidArgument;
  std::string message_;
};

}  // namespace kappa
