// Commands, writes, movements and power cuts in any order at the QMOVE's devices.
#include "tests/fuzz/device_commands.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  const auto finding =
      fuzz::play_device_commands({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  if (!finding.empty()) fuzz::broken(finding);
}

}  // namespace drycut
