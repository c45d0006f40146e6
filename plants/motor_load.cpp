#include "plants/motor_load.hpp"

#include "base/state_archive.hpp"

namespace drycut::plants {

void TellsMotorLoad::keep(const MotorLoad& load) {
  constexpr std::size_t most_kept = 100'000;
  auto& samples = kept_->samples;
  if (samples.size() == 2 * most_kept) {
    samples.erase(samples.begin(), samples.begin() + most_kept);
    kept_->left_out += most_kept;
  }
  samples.push_back({static_cast<float>(load.torque), static_cast<float>(load.acceleration),
                     static_cast<float>(load.friction), static_cast<float>(load.load),
                     static_cast<float>(load.gravity), static_cast<float>(load.speed)});
}

void TellsMotorLoad::Sample::visit(StateArchive& archive) {
  STATE(archive, torque, acceleration, friction, load, gravity, speed);
}
void TellsMotorLoad::Kept::visit(StateArchive& archive) { STATE(archive, samples, left_out); }
void TellsMotorLoad::visit_motor_loads(StateArchive& archive) { STATE(archive, kept_); }

}  // namespace drycut::plants
