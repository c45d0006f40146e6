#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/recordings/dialect.hpp"

namespace drycut::sim::recordings {

/// Who wrote the file.
enum class Format { twincat, mr_configurator2, rigol, siglent, halsampler, csv };
/// As a recording's YAML names them, in the order of Format.
const std::vector<std::string>& format_names();

inline constexpr std::size_t none = static_cast<std::size_t>(-1);

/// What the header of a file says of a column.
struct ExportColumn {
  std::string name;             ///< "" = it has none
  std::string unit = {};        ///< as the file has it: "V", "%", "1/min"; "" = it does not say
  std::size_t time = none;      ///< the column with its time, where the format has one beside it
  bool is_time = false;         ///< it is a time, in `unit`
  bool counts_samples = false;  ///< it is the number of the sample
  bool is_unused = false;       ///< the tool recorded nothing there
  std::string remark = {};      ///< what the header says of it besides, or leaves open
};

/// What stands above the data, understood.
struct ExportHead {
  Format format = Format::csv;
  Dialect dialect = {};
  int first_line = 1;  ///< of the data
  std::vector<ExportColumn> columns = {};
  std::optional<double> interval = {};  ///< between two samples [s]
  double start = 0;                     ///< of the first sample [s]
  int width = 0;                        ///< cells of the first line of data
};

/// What a recording's YAML says of the text; the rest is guessed.
struct Given : GivenSigns {
  std::optional<Format> format = {};
};

/// A header's name without the unit behind it: "Torque" of "Torque [N m]", "M" of "M / Nm".
std::string_view name_alone(std::string_view header);

/// Understands the beginning of a file. `fault` says why not; the result is not to be used then.
ExportHead head_of(const FirstLines& beginning, const Given& given, std::optional<HeadFault>& fault);

}  // namespace drycut::sim::recordings
