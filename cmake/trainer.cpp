// Runs scenarios to their end, one after the other: what make release learns from how the loop branches.
#include <drycut/simulation.hpp>
#include <iostream>

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) {
      drycut::Simulation line(argv[i]);
      line.advance(line.duration());
    }
  } catch (const std::exception& wrong) {
    std::cerr << wrong.what() << '\n';
    return 1;
  }
}
