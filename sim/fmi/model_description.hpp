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
  std::string use = {};   ///< how an importer steps it, and in which units its values are: whole sentences
};

/// What of others is in an FMU, for who gives it away.
struct FmuContents {
  std::vector<std::string> licences;  ///< files beside index.html
  std::string own_licence;            ///< a sentence on Drycut's own library
  std::vector<std::string> files;     ///< of the user, by the names under which they were read
};

/// modelDescription.xml of either standard.
std::string model_description(Standard standard, const FmuHead& head,
                              const std::vector<FmiVariable>& variables);

/// documentation/index.html: the same table for people.
std::string documentation(Standard standard, const FmuHead& head, const std::vector<FmiVariable>& variables,
                          const FmuContents& contents);

}  // namespace drycut::sim::fmi
