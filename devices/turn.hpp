#pragma once
#include <cstdint>

namespace drycut::devices {

/// A device's part in an output that several devices may name: they take turns with REGON and REGOFF and must
/// never drive it at once (001 1.4.1, 002 1.3.1). The output keeps `driver`, who holds it.
class Turn {
 public:
  /// The device drives the output in this sample. True once if another one does too: in two samples on end,
  /// since a turn that changes hands within one is in order.
  bool take(const void*& driver) {
    if (driver == nullptr) driver = this;
    contested_ = driver == this ? 0 : contested_ + 1;
    return contested_ == 2;
  }
  /// Leaves the output to the others.
  void release(const void*& driver) {
    if (driver == this) driver = nullptr;
    contested_ = 0;
  }

 private:
  std::int64_t contested_ = 0;  ///< samples on end in which another device was there too
};

}  // namespace drycut::devices
