#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/record/record.hpp"
#include "sim/record/recording.hpp"
#include "sim/record/trace_files.hpp"

namespace drycut::sim::record {

/// A run as MCAP, for Foxglove and PlotJuggler (docs/records.md; the format: mcap.dev/spec). A topic a source
/// of channels, "/knife" with angle, motor.torque; a topic a kind of event that has values, "/knife/cut"; all
/// events as foxglove.Log on "/events". Messages are JSON with a JSON schema, in chunks that zstd compresses.
/// Time zero is epoch 0. Throws std::runtime_error when something cannot be written.
class McapFile : public Observer {
 public:
  /// `recording` has all its channels and outlives this.
  McapFile(const Recording& recording, const std::filesystem::path& file, const About& about);
  /// The present values of the recording's channels.
  void sample(Time time) override;
  void happened(const RecordedEvent& event) override;
  /// The file has its index.
  void finish() override;

 private:
  /// A channel, or what the next parts of channels' names stand in.
  struct Node {
    std::string part;  ///< of the channels' names
    std::string name;  ///< as JSON has it
    std::string unit;
    const double* slot = nullptr;
    std::vector<Node> inside;
  };
  struct Topic {
    std::string schema;   ///< the record's body
    std::string channel;  ///< likewise
    std::uint64_t messages = 0;
    std::string index;  ///< of its messages in this chunk: time and place
  };
  struct Chunk {  ///< the one that is being filled
    std::string records;
    Time begin = 0;
    Time end = 0;
    std::uint64_t messages = 0;
  };

  void add_channel(const Recording::Column& column);
  std::uint16_t add_topic(const std::string& topic, const std::string& schema_name,
                          const std::string& json_schema);
  void add_message(std::uint16_t topic, Time time, const std::string& json);
  void put_chunk();
  void put(const std::string& records);
  static void append_json(const Node& node, std::string& json);

  GrowingFile file_;
  std::uint64_t size_ = 0;   ///< of the file so far
  std::uint32_t check_ = 0;  ///< CRC of it
  std::vector<Node> sources_;
  std::vector<std::uint16_t> source_topics_;           ///< theirs
  std::map<std::string, std::uint16_t> event_topics_;  ///< by "/knife/cut"
  std::uint16_t log_ = 0;                              ///< topic of all events
  std::vector<Topic> topics_;                          ///< numbered from 1 on
  Chunk chunk_;
  std::string chunk_indexes_;
  std::string metadata_index_;
  std::uint32_t chunks_ = 0;
  std::uint64_t messages_ = 0;
  Time begin_ = 0;
  Time end_ = 0;
};

}  // namespace drycut::sim::record
