#include "plants/motor_load.hpp"

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

}  // namespace drycut::plants
