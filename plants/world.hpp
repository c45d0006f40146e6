#pragma once
#include <memory>

namespace drycut::plants {

/// The rigid bodies of a scenario: a double-precision Bullet world, stepped by a fixed step without collision
/// detection. Parts with one degree of freedom are guided by linear and angular factors (design §4).
/// Built afresh for each run; bodies are stepped in the order in which they were added.
class World {
 public:
  World();
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  void step(double h);

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace drycut::plants
