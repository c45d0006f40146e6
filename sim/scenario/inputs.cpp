// inputs: channels of recordings that drive a line.
#include "sim/scenario/archive.hpp"

namespace drycut::sim::scenario {

void visit(Archive& archive, RecordedInput& input) {
  archive.in_line();
  archive.value({"recording", "a recording's YAML, as `drycut import` writes it"},
                path_form(input.recording));
  archive.require("recording", "name the recording's YAML: recording: scope.yaml");
  archive.value({"channel", "of the recording; else the one that has this name"}, form(input.channel));
  archive.value({"interpolate", "between two samples: straight on, or as it was; a switch holds"},
                choice_form({"linear", "hold"}, input.interpolate));
  archive.value({"after_end", "behind the last sample: it stays, or the run ends there"},
                choice_form({"hold", "stop"}, input.after_end));
  archive.judge([&input](MapReader& reader) {
    if (!reader.has("channel")) input.channel = input.name;
  });
}

}  // namespace drycut::sim::scenario
