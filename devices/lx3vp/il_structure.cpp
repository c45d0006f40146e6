#include "devices/lx3vp/il_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "devices/lx3vp/il_operands.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::il {

namespace {

constexpr std::size_t most_loops = 5;   // FX: FOR in each other
constexpr std::size_t most_joined = 8;  // FX: STL in a row
constexpr int end_label = 63;           // FX: P63 is END

/// Aims a jump or a call at its label; tells if there is none.
bool find_label(Step& step, const Labels& labels, int end_place, const TellLine& tell) {
  if (step.operands.empty() || step.operands[0].kind != OperandType::label) return false;
  const auto& name = step.operands[0];
  const auto found = labels.find(name.number);
  if (found != labels.end()) {
    step.target = static_cast<int>(found->second.place);
    return true;
  }
  if (name.number == end_label && step.op() == Op::cj) {
    step.target = end_place;
    return true;
  }
  tell("il.jump"_code, {name.line, name.column}, fmt::format("there is no label {}", to_string(name)),
       "give it a line of its own");
  return false;
}

bool is_aimed(const Step& step) { return step.op() == Op::cj || step.op() == Op::call; }

class Structure {
 public:
  Structure(IlProgram& program, const Labels& labels, const TellLine& tell)
      : steps_(program.steps),
        interrupts_(program.interrupts),
        labels_(labels),
        tell_(tell),
        places_(steps_.size()) {
    program.states.assign(states, false);
    states_ = &program.states;
  }

  void join() {
    for (place_ = 0; place_ < steps_.size(); ++place_) visit(steps_[place_]);
    if (!steps_.empty() && steps_.back().op() != Op::end) close_all("the end of the text");
    for (place_ = 0; place_ < steps_.size(); ++place_)
      if (is_aimed(steps_[place_])) aim(steps_[place_]);
    for (const auto& interrupt : interrupts_) check_interrupt(interrupt);
    for (const auto& step : steps_) check_requests(step);
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// What is around a step.
  struct Place {
    std::size_t loop = none;   ///< place of the FOR
    std::size_t state = none;  ///< place of the STL
    std::size_t part = 0;      ///< of the program: FEND, SRET and END end one
  };
  enum class Part {
    main,
    subroutine,  ///< it ends with SRET
    interrupts   ///< it ends with IRET
  };
  struct Master {
    int nesting = 0;
    const Step* step = nullptr;
  };

  void tell(Code code, const Step& step, std::string what, std::string remedy) {
    tell_(code, {step.line, step.column}, std::move(what), std::move(remedy));
  }

  void visit(Step& step) {
    step.depth = static_cast<int>(loops_.size());
    places_[place_] = {loops_.empty() ? none : loops_.back(), state_, parts_.size()};
    switch (step.op()) {
      case Op::for_:
        if (loops_.size() == most_loops)
          tell("il.structure"_code, step, fmt::format("FOR stands inside {} others", most_loops),
               fmt::format("no more than {} FORs in each other", most_loops));
        loops_.push_back(place_);
        break;
      case Op::next:
        end_loop(step);
        break;
      case Op::mc:
        begin_master(step);
        break;
      case Op::mcr:
        end_master(step);
        break;
      case Op::stl:
        begin_state(step);
        break;
      case Op::ret:
        refuse_in_loop(step);
        if (state_ == none)
          tell("il.structure"_code, step, "RET has no STL before it", "begin a step of a sequence with STL");
        end_state(place_);
        break;
      case Op::sret:
        if (parts_.empty())
          tell("il.structure"_code, step, "SRET stands in the main program", "put subroutines behind FEND");
        end_part(step, Part::subroutine);
        break;
      case Op::iret:
        if (parts_.empty())
          tell("il.structure"_code, step, "IRET stands in the main program",
               "put interrupt routines behind FEND");
        end_part(step, Part::interrupts);
        break;
      case Op::fend:
      case Op::end:
        end_part(step, Part::main);
        break;
      default:
        break;
    }
  }

  // Loops.

  void end_loop(Step& step) {
    if (loops_.empty())
      return tell("il.structure"_code, step, "NEXT has no FOR", "begin what is repeated with FOR");
    steps_[loops_.back()].target = static_cast<int>(place_);
    loops_.pop_back();
  }

  void refuse_in_loop(const Step& step) {
    if (loops_.empty()) return;
    tell("il.structure"_code, step,
         fmt::format("{} stands between FOR in line {} and its NEXT", step.spelling->text,
                     steps_[loops_.back()].line),
         "loops hold no master contacts and no steps of sequences");
  }

  // Master contacts.

  void refuse_in_state(const Step& step) {
    if (state_ != none)
      tell("il.structure"_code, step,
           fmt::format("{} stands inside the step {}", step.spelling->text, state_name()),
           "end the sequence with RET before");
  }

  void begin_master(const Step& step) {
    note_main_only();
    refuse_in_loop(step);
    refuse_in_state(step);
    if (step.operands.empty()) return;
    const auto& nesting = step.operands[0];
    if (!masters_.empty() && nesting.number <= masters_.back().nesting)
      tell("il.structure"_code, step,
           fmt::format("MC {} stands inside N{} of line {}", to_string(nesting), masters_.back().nesting,
                       masters_.back().step->line),
           "inner master contacts have the higher number");
    masters_.push_back({nesting.number, &step});
  }

  void end_master(const Step& step) {
    refuse_in_loop(step);
    refuse_in_state(step);
    if (step.operands.empty()) return;
    const auto& nesting = step.operands[0];
    const auto opens = std::find_if(masters_.begin(), masters_.end(),
                                    [&](const Master& master) { return master.nesting == nesting.number; });
    if (opens == masters_.end())
      return tell("il.structure"_code, step, fmt::format("MCR {0} has no MC {0}", to_string(nesting)),
                  "begin it with MC");
    masters_.erase(opens, masters_.end());
  }

  // Sequences.

  [[nodiscard]] std::string state_name() const { return to_string(steps_[state_].operands[0]); }

  void begin_state(Step& step) {
    refuse_in_loop(step);
    if (!masters_.empty())
      tell("il.structure"_code, step,
           fmt::format("STL stands inside MC of line {}", masters_.back().step->line),
           "end the master contact with MCR before");
    note_main_only();
    if (step.operands.empty()) return;
    const auto state = static_cast<std::size_t>(step.operands[0].number);
    if ((*states_)[state])
      tell("il.structure"_code, step, fmt::format("there is an STL {} already", to_string(step.operands[0])),
           "give each step of a sequence one STL");
    (*states_)[state] = true;
    const bool joins = state_ != none && place_ > 0 && steps_[place_ - 1].op() == Op::stl;
    if (!joins) {
      end_state(place_);
      state_ = place_;
      return;
    }
    auto& first = steps_[state_];
    if (first.operands.size() == most_joined)
      tell("il.structure"_code, step, fmt::format("more than {} STL in a row", most_joined),
           "join fewer steps of a sequence");
    first.operands.push_back(step.operands[0]);
    step.memory = -1;  // the first does the work
  }

  void end_state(std::size_t behind) {
    if (state_ != none) steps_[state_].target = static_cast<int>(behind);
    state_ = none;
  }

  // Parts of the program.

  void close_all(std::string_view where) {
    for (const auto loop : loops_)
      tell("il.structure"_code, steps_[loop], fmt::format("FOR has no NEXT before {}", where),
           "end what is repeated with NEXT");
    for (const auto& master : masters_)
      tell("il.structure"_code, *master.step,
           fmt::format("MC N{0} has no MCR N{0} before {1}", master.nesting, where),
           fmt::format("end it with MCR N{}", master.nesting));
    if (state_ != none)
      tell("il.structure"_code, steps_[state_],
           fmt::format("the sequence with {} has no RET before {}", state_name(), where),
           "end the last step of a sequence with RET");
    end_state(place_);
    loops_.clear();
    masters_.clear();
  }

  void note_main_only() {
    if (!parts_.empty() && main_only_ == none) main_only_ = place_;
  }

  void end_part(const Step& step, Part part) {
    if (part != Part::main && main_only_ != none)
      tell("il.structure"_code, steps_[main_only_],
           fmt::format("{} stands in {}", steps_[main_only_].spelling->text,
                       part == Part::subroutine ? "a subroutine" : "an interrupt routine"),
           "put master contacts and sequences into the main program");
    main_only_ = none;
    close_all(fmt::format("{} in line {}", step.spelling->text, step.line));
    parts_.push_back(part);
  }

  [[nodiscard]] Part kind_of(std::size_t part) const {
    return part < parts_.size() ? parts_[part] : Part::main;
  }

  // Interrupts.

  void check_interrupt(const InterruptRoutine& interrupt) {
    const Step& label = steps_[interrupt.place];
    const Place& place = places_[interrupt.place];
    if (kind_of(place.part) != Part::interrupts)
      tell("il.structure"_code, label, fmt::format("{} has no IRET behind it", to_string(label.operands[0])),
           "put interrupt routines behind FEND and end each with IRET");
    else if (place.loop != none)
      tell("il.structure"_code, label,
           fmt::format("{} stands between FOR in line {} and its NEXT", to_string(label.operands[0]),
                       steps_[place.loop].line),
           "begin an interrupt routine at its label");
  }

  /// A DHSCS asks for an interrupt.
  void check_requests(const Step& step) {
    if (step.op() != Op::hscs || step.operands.size() < 3) return;
    const auto& asked = step.operands[2];
    if (asked.kind != OperandType::interrupt || !is_counter_interrupt(asked.number)) return;
    for (const auto& interrupt : interrupts_)
      if (interrupt.number == asked.number) return;
    tell_("il.jump"_code, {asked.line, asked.column}, fmt::format("there is no label {}", to_string(asked)),
          "begin an interrupt routine with it, behind FEND");
  }

  // Jumps.

  void aim(Step& step) {
    const bool calls = step.op() == Op::call;
    if (!find_label(step, labels_, static_cast<int>(steps_.size()) - 1, tell_)) return;
    const auto& name = step.operands[0];
    const auto found = labels_.find(name.number);
    if (found == labels_.end()) return;  // P63
    const auto refuse = [&](Code code, std::string what, std::string remedy) {
      tell_(code, {name.line, name.column}, std::move(what), std::move(remedy));
    };
    const Place& from = places_[place_];
    const Place& to = places_[found->second.place];
    if (calls) {
      if (kind_of(to.part) != Part::subroutine)
        refuse("il.jump"_code,
               fmt::format("{} in line {} is no subroutine: it has no SRET", to_string(name),
                           found->second.line),
               "put it behind FEND and end it with SRET");
      else if (to.loop != none)
        refuse("il.jump"_code,
               fmt::format("{} stands between FOR in line {} and its NEXT", to_string(name),
                           steps_[to.loop].line),
               "call a subroutine at its beginning");
      return;
    }
    const bool to_subroutine = kind_of(to.part) == Part::subroutine;
    const bool of_subroutine = to_subroutine || kind_of(from.part) == Part::subroutine;
    if (kind_of(from.part) != kind_of(to.part) && of_subroutine)
      refuse("il.jump"_code, fmt::format("CJ jumps {} a subroutine", to_subroutine ? "into" : "out of"),
             to_subroutine ? "use CALL" : "leave it by SRET");
    else if (kind_of(from.part) != kind_of(to.part))
      refuse(
          "il.jump"_code,
          fmt::format("CJ jumps {} an interrupt routine",
                      kind_of(to.part) == Part::interrupts ? "into" : "out of"),
          kind_of(to.part) == Part::interrupts ? "it begins when its interrupt comes" : "leave it by IRET");
    else if (!is_around(to.loop, place_))
      refuse("il.jump"_code,
             fmt::format("CJ jumps between FOR in line {} and its NEXT", steps_[to.loop].line),
             "begin the loop at its FOR");
    else if (from.state != to.state)
      refuse("il.jump"_code,
             fmt::format("CJ jumps {} a step of a sequence", to.state == none ? "out of" : "into"),
             "go on to another step with SET");
  }

  /// Whether the loop that begins at `loop` is around a place.
  [[nodiscard]] bool is_around(std::size_t loop, std::size_t place) const {
    return loop == none || (place > loop && place <= static_cast<std::size_t>(steps_[loop].target));
  }

  std::vector<Step>& steps_;
  const std::vector<InterruptRoutine>& interrupts_;
  const Labels& labels_;
  const TellLine& tell_;
  std::vector<Place> places_;
  std::vector<bool>* states_ = nullptr;
  std::size_t place_ = 0;
  std::vector<std::size_t> loops_;  ///< places of the FORs around
  std::vector<Master> masters_;
  std::size_t state_ = none;      ///< place of the STL around
  std::size_t main_only_ = none;  ///< place of the first STL or MC in this part, behind the first FEND
  std::vector<Part> parts_;
};

}  // namespace

void find_labels(IlProgram& program, const Labels& labels, const TellLine& tell) {
  for (auto& step : program.steps)
    if (is_aimed(step)) find_label(step, labels, 0, tell);
}

void join_structure(IlProgram& program, const Labels& labels, const TellLine& tell) {
  Structure(program, labels, tell).join();
}

}  // namespace drycut::devices::lx3vp::il
