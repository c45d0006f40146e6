#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "renders/plots.hpp"
#include "renders/report.hpp"
#include "renders/scene3d.hpp"
#include "sim/cams/page.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/output_folder.hpp"
#include "sim/report/gallery_plots.hpp"

namespace drycut::sim::report {

// From what was recorded to what is shown: fills the structs of renders/.

/// What becomes of panels that are 0 all the time.
enum class Flat { left_out, kept };
/// The plots that the scenario asks for; where it asks for none, one with the recorded channels, a panel a
/// unit. Those of motors need the drives of the machine.
std::vector<renders::Plot> plots_of(const scenario::Scenario& scenario, const record::Recording& recording,
                                    const MachineFacts& machine = {}, Flat flat = Flat::left_out);
/// Takes panels out that are 0 all the time in all of these plots, which have the same ones, but for the last
/// one, and names them in the first plot's title.
void leave_out_flat(std::span<renders::Plot> alike);
/// What the spectra that the scenario asks for tell, a line each.
std::vector<std::string> findings_of(const scenario::Scenario& scenario, const record::Recording& recording,
                                     const MachineFacts& machine);

/// Picture files made for a report.
struct Drawn {
  std::vector<std::filesystem::path> frames;  ///< one a snapshot
  std::filesystem::path video;                ///< "" = none
  std::filesystem::path poster;               ///< the frame that stands for it
};

/// The cams that the run played, or held ready; of a PLCopen controller that played none its tables.
std::vector<cams::CamPage> cams_of(const scenario::Scenario& scenario, const loop::Simulation& simulation);

/// The report's sections of the cams; takes their figures, which come last, out of `plots`.
std::vector<renders::ReportSection> cam_sections(const std::vector<cams::CamPage>& cams,
                                                 std::vector<renders::ReportFigure>& plots);

/// The report but for its plots and the sections of cams.
renders::Report report_of(const scenario::Scenario& scenario, loop::Simulation& simulation,
                          const record::Outcome& outcome, const Drawn& drawn);

/// What is drawn of a run.
inline const std::vector<std::string> picture_files = {"report.html", "film.mp4", "filmstrip.png",
                                                       "frames/",     "plots/",   "cams/"};
/// Everything that is drawn of a run and its `film`: frames/, film.mp4, filmstrip.png, plots/, cams/ and
/// report.html in `folder`. Returns what is left out because a helper program is missing, and what to
/// install; "" = nothing. `progress` is told what is being done and which share of it is. Throws
/// std::runtime_error if something cannot be drawn or written.
std::string write_pictures(const scenario::Scenario& scenario, loop::Simulation& simulation,
                           const renders::Film& film, const record::Outcome& outcome, OutputFolder& folder,
                           int threads, const std::function<void(const char*, double)>& progress);

}  // namespace drycut::sim::report
