#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "plants/elastic_strip.hpp"
#include "plants/line_drive.hpp"
#include "plants/measuring_wheel.hpp"
#include "plants/outfeed.hpp"
#include "plants/plant.hpp"
#include "plants/print_marks.hpp"
#include "plants/section.hpp"

namespace drycut::plants {

/// Parameters of `type: web`.
struct WebData {
  std::string section = "strip";   ///< strip, tube
  std::string material = "board";  ///< whose values the next ones are, where they are not given
  double thickness = 1e-3;         ///< of the strip or of the tube's wall [m]
  double width = 0.3;              ///< of the strip; outer diameter of the tube [m]
  double density = 700;            ///< [kg/m3]
  double shear_strength = 5e6;     ///< mean over the blade's length [Pa]
  double mass = 20;  ///< of what moves with the web: strip between the stands and driven rolls [kg]
  double lead = 0;   ///< web beyond the cut at the start [m]
  LineDriveData drive;
  ElasticStripData strip;
  MeasuringWheelData wheel;
  PrintMarkData marks;
  OutfeedData outfeed;

  [[nodiscard]] Section cross_section() const { return {width, thickness, section == "tube"}; }
  [[nodiscard]] StripSprings springs() const { return {strip, cross_section(), density}; }
  /// Least mass that what cuts the web has to do with [kg].
  [[nodiscard]] double mass_at_cut() const { return strip.on ? springs().cut_mass : mass; }
};

/// The web, strip or tube: material that a line drive pulls past a measuring wheel and a cut to an outfeed
/// belt. Along the line x; a fixed cut is at x = 0. What cuts it acts on `material` and calls separate().
///
/// A place on the material is named by its mark: the travel of the web at which it passes x = 0.
///
/// Event `held_back` (force, speed, set_speed) once the line drive has stood at its largest force for 20 ms
/// while the web ran at less than 95 % of the speed that the drive gives; again after the drive has left its
/// limit.
///
/// An elastic web (strip.on) is three bodies, at puller, wheel and cut; `material` is that at the cut. Event
/// `slack` (loop) when more of it than strip.loop_limit lies in loops, until it is straight again.
class Web : public Plant {
 public:
  Web(const WebData& data, World& world);

  void drive(double h) override;
  void sense(double h) override;
  void visit(StateArchive& archive) override;
  std::vector<Port> ports() override;
  [[nodiscard]] std::optional<PlugScale> scale_of(std::string_view port) const override;
  std::vector<Channel> channels() override;
  std::vector<Setting> settings() override;
  std::vector<Fault> faults() override;
  std::vector<EventType> event_types() override;
  std::vector<Recurrence> recurrences() override;
  std::vector<Part> parts() override;
  void callouts(std::vector<Callout>& out) override;
  Parameters live_parameters() override;
  void parameters_changed() override;

  [[nodiscard]] const WebData& data() const { return data_; }
  [[nodiscard]] Slide& material() { return material_; }
  /// The web where the measuring wheel runs on it: of a rigid one the same.
  [[nodiscard]] const Slide& at_wheel() const { return strip_ ? strip_->wheel() : material_; }
  [[nodiscard]] const Outfeed& outfeed() const { return outfeed_; }
  [[nodiscard]] const PrintMarks& marks() const { return marks_; }
  /// Cuts the web off at x = 0 at `fraction` of the last step; the piece goes to the outfeed belt. Returns
  /// its length [m]: the travel since the last cut, of the first piece since the lead end.
  double separate(double fraction);
  /// The same at the place `mark`, for a cut that travels.
  double separate(double fraction, double mark);

  // For stations further down the line, which cut what has come to them: the web or a piece. A mark is here
  // the position of that body less the place of the cut [m].

  /// What lies at `x` > 0 now [m], null where nothing does.
  [[nodiscard]] Slide* lying_at(double x);
  /// What a cut of `what` at a mark makes of it.
  struct Severed {
    double length;  ///< of the piece in front of the cut [m]
    double rest;    ///< of the piece behind it, 0 for the web [m]
  };
  [[nodiscard]] Severed sever_at(const Slide& what, double mark) const;
  /// Makes it; `drop`: the piece in front is scrap.
  void sever(Slide& what, double fraction, double mark, bool drop);
  /// A station takes this stretch of the line behind x = 0 [m]: the outfeed belt leaves it free.
  void make_room(double from, double to);
  /// Travel since the start at `fraction` of the last step [m].
  [[nodiscard]] double travel(double fraction) const;
  /// How far the last cut lies behind the nearest printed mark, where there are marks [m].
  [[nodiscard]] double register_error() const { return marks_.behind_mark(last_cut_); }

 private:
  struct Picture;
  void sense_strip(double h);
  void watch_drive(double h);
  // How far the web reaches beyond the cut, and where printed marks are on what is seen of it [m].
  [[nodiscard]] double overhang() const;
  [[nodiscard]] std::vector<double> prints_in_sight() const;

  WebData data_;
  World& world_;
  Slide& material_;  // position: travel since the start
  LineDrive drive_;
  MeasuringWheel wheel_;
  PrintMarks marks_;
  Outfeed outfeed_;
  std::optional<ElasticStrip> strip_;
  bool slack_ = false;  // reported
  double held_ = 0;     // how long the web has been held back against the line drive [s]
  double h_ = 0;        // of the last step [s]
  double lead_end_;     // mark of the present lead end [m]
  double last_cut_;     // mark of it [m]
  int pieces_ = 0;
  int scraps_ = 0;
  double scrap_length_ = 0;                       // [m]
  std::vector<std::pair<double, double>> rooms_;  // of stations behind x = 0, in their order [m]
};

Parameters web_parameters(WebData& data);

class WebDefinition : public PlantDefinition {
 public:
  WebData data;
  Parameters parameters() override { return web_parameters(data); }
  std::vector<Objection> objections(double h) override;
  std::unique_ptr<Plant> build(World& world, const std::function<Plant*(std::string_view)>& find) override;
};

}  // namespace drycut::plants
