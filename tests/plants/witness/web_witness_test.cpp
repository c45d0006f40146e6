#include "tests/plants/web_line.hpp"
#include "tests/plants/witness/compare.hpp"
#include "tests/plants/witness/web_law.hpp"

namespace drycut::plants::witness {
namespace {

/// The elastic web, whose rolls have the speed that is told and at whose cut a force acts.
struct PulledWeb : WebLine {
  using WebLine::WebLine;
  ReferencePort rolls;  ///< volts: [m/s]
  double force = 0;

  template <class Plug>
  Plug& plug(const std::string&) {
    return rolls;
  }
  void process(double newton) { force = newton; }
  void step(double dt) {
    set("speed", rolls.volts);
    web.material().add_force(force);
    Machine::step(dt);
  }
  void record(Track& track) {
    track.motor.push_back(web.at_wheel().position);
    track.load.push_back(web.material().position);
  }
};

TEST(Witness, WebWithTension) {
  WebData data;
  data.strip.on = true;
  data.strip.guide_distance = 0.05;  // it pushes as well as it pulls
  data.lead = 0.3;
  data.drive.acceleration = 1000;  // the rolls have the speed that they are told
  const Motion motion{{{0.2, 1, 1},
                       {0.4, 1, 1, 150},  // the shear pulls
                       {0.7, 1, 2},
                       {0.9, 2, 2, -60},  // and pushes
                       {1.3, 2, 1.5, 30},
                       {1.6, 1.5, 1.5, 150},
                       {2.0, 1.5, 1}}};
  expect_witness<WebLaw>([&] { return std::make_unique<PulledWeb>(data); },
                         [&] { return std::make_unique<WebLaw>(data, motion); }, 2.5e-6, 1e-6,
                         {{"the wheel 10 mm on", [](WebLaw& law) { law.web.strip.wheel_distance = 0.69; }},
                          {"no damping", [](WebLaw& law) { law.web.strip.retardation = 0; }},
                          {"no wheel", [](WebLaw& law) { law.web.strip.wheel_mass = 0; }},
                          {"no web beyond the cut", [](WebLaw& law) { law.growing = 0; }},
                          {"another grip", [](WebLaw& law) { law.web.drive.damping *= 1.05; }}});
}

}  // namespace
}  // namespace drycut::plants::witness
