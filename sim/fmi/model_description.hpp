#pragma once
#include <string>
#include <vector>

#include "sim/fmi/machine/fmi_model.hpp"

namespace drycut::sim::fmi {

enum class Standard { fmi2, fmi3 };

/// What the description says beside the variables.
struct FmuHead {
  std::string identifier;  ///< of the model: a name in C
  std::string title;
  std::string token;
  double step = 0;        ///< [s]
  double stop = 0;        ///< [s]
  std::string what = {};  ///< "The machine of a Drycut line without its controller"
};

/// modelDescription.xml of either standard.
std::string model_description(Standard standard, const FmuHead& head,
                              const std::vector<FmiVariable>& variables);

/// documentation/index.html: the same table for people. `licences`: files beside it.
std::string documentation(Standard standard, const FmuHead& head, const std::vector<FmiVariable>& variables,
                          const std::vector<std::string>& licences);

}  // namespace drycut::sim::fmi
