#pragma once
#include <functional>
#include <string>
#include <vector>

namespace drycut::sim::loop {

struct PlayedCam;

/// What speaks against a cam that a run played.
struct CamDoubt {
  std::string text;      ///< "cam of AxisX, sector 4: ..."
  bool is_slip = false;  ///< the device stops or passes a limit, however slow the master is
};

/// Who judges cams: the rooms above the loop do.
using CamJudge = std::function<std::vector<CamDoubt>(const std::vector<PlayedCam>& played)>;

}  // namespace drycut::sim::loop
