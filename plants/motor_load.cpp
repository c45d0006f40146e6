#include "plants/motor_load.hpp"

#include "base/state_archive.hpp"

namespace drycut::plants {

void TellsMotorLoad::Kept::take(const Sample& sample) {
  if (samples.size() == 2 * fewest) {
    samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(fewest));
    left_out += fewest;
  }
  samples.push_back(sample);
}

void TellsMotorLoad::keep(const MotorLoad& load) {
  kept_->take({static_cast<float>(load.torque), static_cast<float>(load.acceleration),
               static_cast<float>(load.friction), static_cast<float>(load.load),
               static_cast<float>(load.gravity), static_cast<float>(load.speed)});
}

// Samples that are left out are gone for good.
void TellsMotorLoad::Kept::shorten(std::size_t size) {
  if (size == 0) left_out = 0;
  samples.resize(size > left_out ? size - left_out : 0);
}

void TellsMotorLoad::Kept::entries(StateArchive& archive, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    Sample sample{};
    if (!archive.restores() && i >= left_out) sample = samples[i - left_out];
    STATE(archive, sample.torque, sample.acceleration, sample.friction, sample.load, sample.gravity,
          sample.speed);
    if (archive.restores()) take(sample);
  }
}

}  // namespace drycut::plants
