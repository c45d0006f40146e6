#pragma once
#include <ostream>
#include <string>
#include <vector>

// The pages that are looked at in a browser, and the calls that make them.
namespace drycut::report_pages {

/// Words of a call; "OUT" stands for the test's folder, "SCENES" for scenes/.
using Call = std::vector<std::string>;

inline Call run(const std::string& scene, const std::string& duration, const Call& more = {}) {
  Call words = {"run", "SCENES/" + scene + ".yaml", "--out", "OUT"};
  const Call short_and_small = {"scene.duration=" + duration, "pictures.frames.every=1 s",
                                "pictures.frames.size=320x180"};
  for (const auto& assignment : short_and_small) words.insert(words.end(), {"--set", assignment});
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct Page {
  std::string name;
  std::vector<Call> calls;
  std::string report;  ///< below OUT
  std::string trace;   ///< whose values its cursor must tell, "" = not of one run
  bool live = true;    ///< has plots to zoom
};
inline void PrintTo(const Page& page, std::ostream* out) { *out << page.name; }

inline Page scene(const std::string& name, const std::string& duration, const Call& more = {}) {
  return {name, {run(name, duration, more)}, name + "/report.html", name + "/trace.csv"};
}

/// One for each plant, one with everything a report can hold, and the pages that are not of one run.
inline std::vector<Page> pages() {
  const Call plain = {"--no-pictures"};
  auto faster = run("rotary_knife_short", "3 s", {"--no-pictures", "--set", "plants.web.speed=50 m/min"});
  faster[3] = "OUT/faster";
  return {
      scene("rotary_knife", "5 s"),
      scene("rotary_knife_fault", "6500 ms", {"--set", "pictures.frames.every=800 ms"}),
      scene("flying_saw", "12 s", {"--set", "pictures.frames.every=3 s"}),
      scene("fly_cut", "5 s"),
      scene("backlash_motor_encoder", "3 s"),
      scene("press_learning", "5 s"),
      scene("circular", "4 s"),
      scene("wire_guide", "4 s"),
      {"compare",
       {run("rotary_knife_short", "3 s", plain),
        faster,
        run("rotary_knife_lx3vp", "3 s", plain),
        {"compare", "OUT/rotary_knife_short", "OUT/faster/rotary_knife_short", "OUT/rotary_knife_lx3vp",
         "--out", "OUT/compared"}},
       "compared/report.html",
       ""},
      {"bode",
       {{"bode", "SCENES/rotary_knife_short.yaml", "--at", "2", "--out", "OUT/bode"}},
       "bode/report.html",
       "",
       false},
      {"tune",
       {{"tune", "SCENES/rotary_knife_short.yaml", "--from", "2 s", "--set", "scene.duration=3 s", "--vary",
         "controller.qmove.set.AxisX.pgain=1..100", "--minimise", "rms(AxisX.follerr)", "--budget", "6",
         "--ignore-checks", "--out", "OUT/tune"}},
       "tune/report.html",
       "",
       false},
      {"sweep",
       {{"sweep", "SCENES/rotary_knife_short.yaml", "--set", "scene.duration=4 s", "--over",
         "plants.web.speed=40..240 m/min:5", "--out", "OUT/sweep"}},
       "sweep/report.html",
       ""},
      {"envelope",
       {{"envelope", "SCENES/envelope/rotary_knife_camming4.yaml", "--over", "variables.length=600,900 mm",
         "--find-max", "variables.speed=20..200 m/min:40", "--out", "OUT/envelope"}},
       "envelope/report.html",
       ""},
      {"size",
       {{"size", "SCENES/rotary_knife_lx3vp.yaml", "--motors", "HG-SR52,HG-SR102", "--gears", "4..8:3",
         "--inertia-ratio", "15", "--out", "OUT/size"}},
       "size/report.html",
       ""},
  };
}

}  // namespace drycut::report_pages
