#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/problem.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/studies/design/sheet.hpp"

namespace drycut::sim::studies {

/// Ways of a pulse that somebody gave, and the options that give them.
struct GivenPulses {
  std::optional<PulseWay> master = {};  ///< --master-pulse
  std::optional<PulseWay> slave = {};   ///< --slave-pulse
};

/// What plays a designed table in a scene: two texts for files beside the table's.
struct CamScene {
  std::filesystem::path file;            ///< "knife.yaml" of "knife.csv"
  std::string scenario;                  ///< extends the scene, has the table, and a check that it is played
  std::filesystem::path registers_file;  ///< LX3VP: "knife_registers.csv"; else ""
  std::string registers;                 ///< LX3VP: DECAM's block with the table, word by word; else ""
};

/// What a scene says of the machine to `device`, over what is given: the way of its pulses, from the
/// transducers that are wired; of MC_CamIn, where the scene's own table has the cut. What is given and is not
/// the scene's is a problem of its option, as is a job for another machine, and a scene that plays no cam.
DesignAxes scene_axes(const scenario::Scenario& scene, const std::string& device, const DesignJob& job,
                      const GivenPulses& given, Problems& problems);

/// How controllers take a table that they do not make themselves:
/// CAMMING4: the axis' rows before power-up; SYSTEM slZone is the row of the synchronous way, of which 0
/// says that the program makes its own cam. LX3VP: the registers before power-up, with the rows in the
/// register in which ECAMTBX answers; 0 in it says that there is none yet. MC_CamIn: in place of the scene's
/// table, with its id; the program's zoneBegins and zoneEnds, if it has them, are where it is
/// synchronous; what the scene sets of MasterScaling and SlaveScaling is 1, for the table has the job's size.
/// A scene of another controller, or whose program takes no table, is a problem of `--scene`.
std::optional<CamScene> cam_scene(const DesignSheet& sheet, const scenario::Scenario& scene,
                                  const std::filesystem::path& table, Problems& problems);

}  // namespace drycut::sim::studies
