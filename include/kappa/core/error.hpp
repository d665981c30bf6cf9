// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace kappa {

/// Why a call cannot be served.
enum class ErrorCode {
  InvalidArgument,  ///< a parameter is out of its range
  InvalidData,      ///< the points, normals or faces give no result
  FileNotFound,     ///< there is no such file, or it may not be read
  FileFormat,       ///< the file is malformed, or its format or variant is not read
  FileWrite,        ///< the file cannot be written
  Unavailable,      ///< the machine lacks something, such as a display
  Cancelled  ///< `Execution::cancel` was raised. Only a Status has this code; a call that throws, throws `Cancelled`
};

/// Thrown by a call that cannot be served. The message is one sentence for a user: it names the parameter or the file,
/// its value, and what to do about it.
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
  /// The message is option, a blank, and reason, such as "min_coverage needs balls: it has no meaning at radius 0".
  /// Other members that the reason names stand in backticks, so that a program finds them, too.
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

/// The outcome of a call through an interface that must not throw, such as the PCL class.
class Status {
 public:
  Status() = default;
  Status(ErrorCode code, std::string message) : ok_(false), code_(code), message_(std::move(message)) {}
  bool ok() const noexcept { return ok_; }
  /// The code of the failure. It has no meaning if ok().
  ErrorCode code() const noexcept { return code_; }
  const std::string& message() const noexcept { return message_; }

 private:
  bool ok_ = true;
  ErrorCode code_ = ErrorCode::InvalidArgument;
  std::string message_;
};

}  // namespace kappa
