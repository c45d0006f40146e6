#pragma once
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/file.hpp"
#include "sim/fmi/machine/fmi_model.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::fmi {

/// A line as an FMU carries it, resources/line.cbor: its scenario with all files that reading it takes, and
/// what the command line has set. The loop's own reader reads them again where the FMU is used.
struct CarriedLine {
  std::string made_by;   ///< version of drycut, and sum of the library
  std::string scenario;  ///< its file, one of `files`
  std::vector<scenario::Override> set;
  std::map<std::string, FileSet::File> files;
  std::map<std::string, std::vector<std::string>> folders;
};

/// As CBOR; the same line gives the same bytes.
std::string line_bytes(const CarriedLine& line);
/// Back from there. Throws std::exception if it is none.
CarriedLine read_line(std::string_view bytes);

/// A parameter that is a value of the scenario: what an override is made of.
struct LineParameter {
  std::string path;  ///< "variables.length", "plants.knife.circumference"
  std::string unit;  ///< "" = pure number, switch or word
  FmiVariable::Type type;
};

/// The line of an FMU.
class LineSource : public FmiSource {
 public:
  /// Throws Refusal with all that is wrong with it.
  explicit LineSource(CarriedLine line);
  [[nodiscard]] Time step() const override { return step_; }
  [[nodiscard]] std::unique_ptr<FmiModel> build(const FmiModel::Given& given) const override;

 private:
  CarriedLine line_;
  Time step_ = 0;
  std::map<std::uint32_t, LineParameter> parameters_;
};

}  // namespace drycut::sim::fmi
