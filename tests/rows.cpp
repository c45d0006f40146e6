// rows SCENE...: runs each scenario to its end and prints, ten times a second, all that can be read of it, in
// hexadecimal. Every build of Drycut, by any compiler, prints the same.
#include <cstdio>
#include <drycut/simulation.hpp>

int main(int count, char** scenes) {
  try {
    for (int i = 1; i < count; ++i) {
      drycut::Simulation line(scenes[i]);
      std::printf("%s\n", scenes[i]);
      while (line.time() < line.duration()) {
        line.advance(0.1);
        for (const auto& name : line.names()) {
          std::printf("%s %a\n", name.c_str(), line.read(name));
        }
      }
    }
  } catch (const std::exception& wrong) {
    std::fprintf(stderr, "%s\n", wrong.what());
    return 1;
  }
}
