// Runs a line from a program of its own: slows the web down after 5 s and looks at the pieces.
#include <drycut/simulation.hpp>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: embed SCENARIO\n";
    return 2;
  }
  try {
    drycut::Simulation line(argv[1], {{"plants.web.speed", "50 m/min"}});
    line.advance(5);
    line.write("web.speed", 30);
    line.advance(5);
    for (const auto& event : line.take_events())
      if (event.name == "cut") std::cout << event.time << " s: " << event.values.at("length") << " mm\n";
    std::cout << "knife at " << line.read("knife.angle") << ' ' << line.unit("knife.angle") << '\n';
  } catch (const drycut::BadInput& problems) {
    std::cerr << problems.what() << '\n';
    return 2;
  }
}
