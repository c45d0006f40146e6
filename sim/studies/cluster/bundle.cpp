#include "sim/studies/cluster/bundle.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "sim/loop/fingerprint.hpp"

namespace drycut::sim::cluster {

namespace {

/// This program, to the byte.
std::string program() {
  loop::Fingerprint hash;
  hash.add_program();
  return fmt::format("drycut {} ({:016x})", DRYCUT_VERSION, hash.value());
}

/// The last digits of the mathematical functions: they hang on the C library and on the kind of processor.
std::string arithmetic() {
  loop::Fingerprint hash;
  constexpr int samples = 256;
  for (int i = 1; i <= samples; ++i) {
    const volatile double opaque = 0.37 * i;  // computed when it runs, not by the compiler
    const double x = opaque;
    for (const double y : std::array{std::sin(x), std::cos(x), std::tan(x), std::exp(x / 9), std::log(x),
                                     std::pow(x, 1.7), std::atan2(x, 3.0), std::hypot(x, 0.7)})
      hash.add(fmt::format("{:x}", std::bit_cast<std::uint64_t>(y)));
  }
  return fmt::format("{:016x}", hash.value());
}

std::string this_machine() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "a machine";
}

}  // namespace

std::string bundle_of(const std::string& kind, const std::string& question, const FileSet& files) {
  auto staged = Json::object();
  for (const auto& [name, file] : files.files)
    staged[name] = {static_cast<int>(file.state), Json::binary({file.bytes.begin(), file.bytes.end()})};
  const Json bundle = {{"program", program()}, {"arithmetic", arithmetic()},
                       {"kind", kind},         {"question", question},
                       {"files", staged},      {"folders", files.folders}};
  const auto bytes = Json::to_cbor(bundle);
  return {bytes.begin(), bytes.end()};
}

std::string name_of_bundle(std::string_view bundle) {
  loop::Fingerprint hash;
  hash.add(bundle);
  return fmt::format("{:016x}", hash.value());
}

Bundle read_bundle(std::string_view bytes, FileSet& files) try {
  const auto all = Json::from_cbor(bytes);
  for (const auto& [name, file] : all.at("files").items()) {
    const auto& content = file.at(1).get_binary();
    files.files[name] = {static_cast<FileSet::State>(file.at(0).get<int>()),
                         {content.begin(), content.end()}};
  }
  files.folders = all.at("folders").get<decltype(files.folders)>();
  files.seal();
  Bundle bundle{all.at("kind").get<std::string>(), all.at("question").get<std::string>(), ""};
  const auto asked_by = all.at("program").get<std::string>();
  if (asked_by != program())
    bundle.refused = fmt::format("{} has {}, the study is {}'s; install the same there", this_machine(),
                                 program(), asked_by);
  else if (all.at("arithmetic").get<std::string>() != arithmetic())
    bundle.refused = fmt::format(
        "{} computes other last digits of sin, exp, pow: another C library or kind of processor; the result "
        "would not be the same bytes as here",
        this_machine());
  return bundle;
} catch (const Json::exception& error) {
  throw std::runtime_error(fmt::format("it is no bundle of work: {}", error.what()));
}

}  // namespace drycut::sim::cluster
