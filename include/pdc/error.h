#pragma once

#include <exception>
#include <stdexcept>

namespace pdc {

/// A file, a scene or a request that cannot be served. The message is one line: what, the offending value, the limit.
/// Thrown before parallel work starts wherever that can be known; a caller's mistake in code throws
/// std::invalid_argument instead.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work was stopped on request (see Monitor). Nothing was written and no partial result exists.
class Cancelled : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace pdc
