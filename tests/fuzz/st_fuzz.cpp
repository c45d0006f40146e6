// Structured Text, behind a kernel with two axes.
#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/program.hpp"
#include "devices/plcopen/st/runtime.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  namespace plcopen = devices::plcopen;
  Problems problems;
  const auto program = plcopen::st::compile(text, "f.st", problems);
  fuzz::expect_placed(problems, text);
  if (!problems.empty()) return;
  plcopen::MotionKernel kernel;
  kernel.add_axis("Web", plcopen::AxisParameters{});
  kernel.add_axis("Knife", plcopen::AxisParameters{});
  for (const auto& external : program.externals())
    if (external.name != "Web" && external.name != "Knife") return;
  plcopen::st::Runtime runtime(program, kernel);
  constexpr std::int64_t scan_ns = 2'000'000;
  for (int i = 0; i < 10; ++i) {
    kernel.cycle();
    runtime.scan(i * scan_ns);
  }
  const auto symbols = runtime.symbols();
  double sum = 0;  // what every name reads
  for (std::size_t i = 0; i < symbols.size(); ++i) sum += runtime.read(i);
  static_cast<void>(sum);
}

}  // namespace drycut
