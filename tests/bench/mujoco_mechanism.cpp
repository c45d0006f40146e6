#ifdef DRYCUT_WITH_MUJOCO
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cstring>
#include <stdexcept>

#include "tests/bench/mechanism.hpp"

namespace drycut::bench {

double run_mujoco(const Mechanism& m, std::int64_t steps) {
  const auto text = fmt::format(
      R"(<mujoco><option timestep="{}" gravity="0 0 0" integrator="Euler"><flag contact="disable" constraint="disable"/></option>
      <worldbody>
        <body name="motor"><joint name="motor" type="hinge" axis="0 0 1"/><inertial pos="0 0 0" mass="10" diaginertia="{} {} {}"/></body>
        <body name="drum"><joint name="drum" type="hinge" axis="0 0 1"/><inertial pos="0 0 0" mass="90" diaginertia="{} {} {}"/></body>
        <body name="web"><joint name="web" type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="{}" diaginertia="1 1 1"/></body>
      </worldbody></mujoco>)",
      m.step, m.motor_inertia, m.motor_inertia, m.motor_inertia, m.drum_inertia, m.drum_inertia,
      m.drum_inertia, m.web_mass);
  mjVFS vfs;
  mj_defaultVFS(&vfs);
  mj_makeEmptyFileVFS(&vfs, "line.xml", static_cast<int>(text.size()) + 1);
  std::memcpy(vfs.filedata[0], text.c_str(), text.size() + 1);
  char error[500] = "";
  mjModel* model = mj_loadXML("line.xml", &vfs, error, sizeof error);
  mj_deleteVFS(&vfs);
  if (model == nullptr) throw std::runtime_error(error);
  mjData* data = mj_makeData(model);
  data->qvel[2] = 1;
  for (std::int64_t i = 0; i < steps; ++i) {
    const double twist = data->qpos[0] / m.ratio - data->qpos[1];
    const double gear = m.stiffness * twist + m.damping * (data->qvel[0] / m.ratio - data->qvel[1]);
    data->qfrc_applied[0] = m.torque - gear / m.ratio;
    data->qfrc_applied[1] = gear - m.friction * data->qvel[1];
    mj_step(model, data);
  }
  const double result = data->qvel[1];
  mj_deleteData(data);
  mj_deleteModel(model);
  return result;
}

}  // namespace drycut::bench
#endif
