#pragma once

#include <string>
#include <thread>

namespace pdc {

/// A line on standard error, for a person, while something runs that cannot say how far it is, such as reading a file.
/// It says what is being done and for how long. It is drawn only on a terminal and only after a second, and wiped when
/// the object goes out of scope.
class BusySign {
 public:
  /// `wanted` false, or standard error not being a terminal, makes a sign that never draws.
  BusySign(bool wanted, std::string what);
  ~BusySign();
  BusySign(const BusySign&) = delete;
  BusySign& operator=(const BusySign&) = delete;

 private:
  std::jthread mThread;
};

}  // namespace pdc
