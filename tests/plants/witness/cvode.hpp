#pragma once
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace drycut::plants::witness {

/// Equations of motion y' = f(t, y) that are smooth but for their switches: friction that holds or slides, a
/// contact that is open or closed. Each switch stands still while the solver steps.
class Equations {
 public:
  Equations() = default;
  virtual ~Equations() = default;
  Equations(const Equations&) = delete;
  Equations& operator=(const Equations&) = delete;

  /// The state at the start.
  [[nodiscard]] virtual std::vector<double> start() const = 0;
  virtual void slope(double t, std::span<const double> y, std::span<double> dy) const = 0;
  /// How many switches there are.
  [[nodiscard]] virtual int switches() const = 0;
  /// A number a switch, below 0 while it stands right: where it rises through 0 the switch acts.
  virtual void watch(double t, std::span<const double> y, std::span<double> g) const = 0;
  virtual void act(double t, std::span<double> y, int which) = 0;
};

/// CVODE of SUNDIALS: Adams' method of variable order and step, which finds the place of each switch and
/// starts anew behind it. Throws std::runtime_error where it cannot go on.
class Cvode {
 public:
  /// `tolerance`: of a step, relative; absolute a tenth of it in m, rad, m/s, rad/s, N m.
  Cvode(Equations& equations, double tolerance) : equations_(equations), found_(equations.switches()) {
    const std::vector<double> start = equations.start();
    SUNContext_Create(nullptr, &context_);
    y_ = N_VNew_Serial(static_cast<sunindextype>(start.size()), context_);
    std::copy(start.begin(), start.end(), state().begin());
    solver_ = CVodeCreate(CV_ADAMS, context_);
    need(CVodeInit(solver_, slope, 0, y_));
    need(CVodeSStolerances(solver_, tolerance, tolerance / 10));
    iteration_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
    need(CVodeSetNonlinearSolver(solver_, iteration_));
    need(CVodeSetUserData(solver_, &equations_));
    need(CVodeSetMaxNumSteps(solver_, 10'000'000));
    need(CVodeSetMaxStep(solver_, longest_step));
    if (!found_.empty()) {
      need(CVodeRootInit(solver_, equations.switches(), watch));
      std::vector<int> rising(found_.size(), 1);
      need(CVodeSetRootDirection(solver_, rising.data()));
    }
    need(CVodeSetNoInactiveRootWarn(solver_));
    restart();
  }
  ~Cvode() {
    CVodeFree(&solver_);
    SUNNonlinSolFree(iteration_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  [[nodiscard]] std::span<double> state() const {
    return {N_VGetArrayPointer(y_), static_cast<std::size_t>(N_VGetLength(y_))};
  }

  /// Goes on to `t` [s]; switches on the way act.
  void run_to(double t) {
    while (now_ < t - hair) {
      need(CVodeSetStopTime(solver_, t));
      const int flag = CVode(solver_, t, y_, &now_, CV_NORMAL);
      need(flag);
      if (flag != CV_ROOT_RETURN) continue;
      need(CVodeGetRootInfo(solver_, found_.data()));
      for (std::size_t i = 0; i < found_.size(); ++i)
        if (found_[i] != 0) act(static_cast<int>(i));
      restart();
    }
  }
  /// Something outside of the state has changed, a force or a slope of the reference.
  void restart() {
    std::vector<double> g(found_.size());
    for (bool settled = false; !settled;) {
      equations_.watch(now_, state(), g);
      const auto wrong = std::find_if(g.begin(), g.end(), [](double number) { return number > 0; });
      settled = wrong == g.end();
      if (!settled) act(static_cast<int>(wrong - g.begin()));
    }
    need(CVodeReInit(solver_, now_, y_));
  }

 private:
  // In free flight the solver would step over a short contact [s].
  static constexpr double longest_step = 2e-4;
  static constexpr double hair = 1e-12;          // [s]
  static constexpr int most_switching = 100000;  // more is chatter

  void act(int which) {
    if (++switched_ > most_switching)
      throw std::runtime_error("switch " + std::to_string(which) + " chatters at " + std::to_string(now_));
    equations_.act(now_, state(), which);
  }
  static void need(int flag) {
    if (flag >= 0) return;
    char* name = CVodeGetReturnFlagName(flag);
    const std::string text = name;
    std::free(name);  // NOLINT: CVODE allocates it
    throw std::runtime_error(text);
  }

  static std::span<double> values(N_Vector v) {
    return {N_VGetArrayPointer(v), static_cast<std::size_t>(N_VGetLength(v))};
  }
  static int slope(double t, N_Vector y, N_Vector dy, void* equations) {
    static_cast<const Equations*>(equations)->slope(t, values(y), values(dy));
    return 0;
  }
  static int watch(double t, N_Vector y, double* g, void* equations) {
    const auto& all = *static_cast<const Equations*>(equations);
    all.watch(t, values(y), {g, static_cast<std::size_t>(all.switches())});
    return 0;
  }

  Equations& equations_;
  std::vector<int> found_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
  void* solver_ = nullptr;
  SUNNonlinearSolver iteration_ = nullptr;
  double now_ = 0;
  int switched_ = 0;
};

}  // namespace drycut::plants::witness
