#include "plants/world.hpp"

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <cassert>
#include <stdexcept>
#include <vector>

#include "base/state_archive.hpp"
#include "base/units.hpp"
#include "plants/exact_sum.hpp"
#include "plants/random.hpp"

namespace drycut::plants {

namespace {

// Bullet clamps the rotation of one step to an eighth of a turn (ANGULAR_MOTION_THRESHOLD); a shaft that is
// faster would silently be slowed down.
constexpr double max_rotation = std::numbers::pi / 4;
constexpr double max_slide_speed = 1e4;  // [m/s]: nothing on a line is this fast unless it diverged

void set_inertia_of(btRigidBody& body, double inertia) {
  body.setMassProps(1, btVector3(inertia, inertia, inertia));
  body.updateInertiaTensor();
}
void set_mass_of(btRigidBody& body, double mass) { body.setMassProps(mass, btVector3(0, 0, 0)); }

// Bullet's bodies get speed and force from ours in every step: what it keeps itself are inertias. Where a
// body is stands in ours; Bullet's pose is made of it when somebody looks.

struct ShaftBody {
  Shaft state;
  std::string name;
  std::unique_ptr<btRigidBody> body;

  void visit(StateArchive& archive) {
    state.visit(archive);
    if (archive.restores()) set_inertia_of(*body, state.inertia);
  }
  void pose() const {
    body->getWorldTransform().setRotation(btQuaternion(btVector3(0, 0, 1), units::turn * state.part));
  }
};
struct SlideBody {
  Slide state;
  std::string name;
  std::unique_ptr<btRigidBody> body;
  btVector3 axis;
  double weight = 0;  // along the axis [N]

  void visit(StateArchive& archive) {
    state.visit(archive);
    STATE(archive, weight);
    if (archive.restores()) set_mass_of(*body, state.mass);
  }
  void pose() const { body->getWorldTransform().setOrigin(axis * state.position); }
};

/// Bullet's world without its collision pass: guided bodies cannot meet, so broad phase, islands, constraint
/// solver and activation are left out. The step is Bullet's own integration of force to speed.
class GuidedWorld : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
  std::vector<std::unique_ptr<ShaftBody>> shafts;
  std::vector<std::unique_ptr<SlideBody>> slides;
  std::vector<std::unique_ptr<SlideBody>> slow_slides;
  bool slow_too = false;
  const std::string* failed = nullptr;  // body that left the range of the integrator
  double failed_speed = 0;

  // Guided parts cannot meet: no broad phase, where thousands of boxes in one place would end in a chain.
  void addCollisionObject(btCollisionObject* object, int /*group*/, int /*mask*/) override {
    object->setWorldArrayIndex(m_collisionObjects.size());
    m_collisionObjects.push_back(object);
  }

  void internalSingleStepSimulation(btScalar h) override {
    // All forces first: Bullet reads in other pieces what was written, which takes long when it is written
    // just before.
    for (const auto& s : shafts) load(*s);
    for (const auto& s : slides)
      if (s->state.awake) load(*s);
    for (const auto& s : shafts) turn(*s, h);
    for (const auto& s : slides)
      if (s->state.awake) move(*s, h);
    if (slow_too)
      for (const auto& s : slow_slides) {
        if (!s->state.awake) continue;
        load(*s);
        move(*s, h * World::slow_steps);
      }
  }

 private:
  static void load(ShaftBody& s) {
    s.body->setAngularVelocity(btVector3(0, 0, s.state.speed));
    s.body->applyTorque(btVector3(0, 0, s.state.torque));
  }
  static void load(SlideBody& s) {
    s.body->setLinearVelocity(s.axis * s.state.speed);
    s.body->applyCentralForce(s.axis * (s.state.force + s.weight));
  }

  void turn(ShaftBody& s, btScalar h) {
    Shaft& state = s.state;
    btRigidBody& body = *s.body;
    body.integrateVelocities(h);
    body.clearForces();
    const double speed = body.getAngularVelocity().z();
    if (!(std::abs(speed) * h < max_rotation)) {
      fail(s.name, speed);
      return;
    }
    state.torque = 0;
    state.speed_before = state.speed;
    state.speed = speed;
    state.turns_before = state.turns;
    state.part_before = state.part;
    state.part += speed * h / (2 * std::numbers::pi);
    if (state.part >= 1) {
      state.part -= 1;
      ++state.turns;
    } else if (state.part < 0) {
      state.part += 1;
      --state.turns;
      if (state.part >= 1) {  // a part of -1e-17 rounds up to a whole turn
        state.part = 0;
        ++state.turns;
      }
    }
  }

  void move(SlideBody& s, btScalar h) {
    Slide& state = s.state;
    btRigidBody& body = *s.body;
    body.integrateVelocities(h);
    body.clearForces();
    const double speed = body.getLinearVelocity().dot(s.axis);
    if (!(std::abs(speed) < max_slide_speed)) {
      fail(s.name, speed);
      return;
    }
    state.force = 0;
    state.speed_before = state.speed;
    state.speed = speed;
    state.position_before = state.position;
    const double way = speed * h + state.remainder;
    state.position += way;
    state.remainder = rounded_off(state.position_before, way, state.position);
  }

  void fail(const std::string& name, double speed) {
    if (failed != nullptr) return;
    failed = &name;
    failed_speed = speed;
  }
};

template <class Body>
Pose pose_of(const Body& body) {
  body.pose();
  const btTransform& t = body.body->getWorldTransform();
  const btQuaternion q = t.getRotation();
  return {{t.getOrigin().x(), t.getOrigin().y(), t.getOrigin().z()}, {q.x(), q.y(), q.z(), q.w()}};
}

/// Nothing collides here: no room for the contacts of thousands, which each run would have to clear first.
btDefaultCollisionConstructionInfo without_contacts() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 1;
  info.m_defaultMaxCollisionAlgorithmPoolSize = 1;
  return info;
}

}  // namespace

struct World::Bodies {
  explicit Bodies(std::uint64_t world_seed) : seed(world_seed) {}
  std::uint64_t seed;
  std::vector<std::pair<std::string, std::uint64_t>> sources;
  btDefaultCollisionConfiguration configuration{without_contacts()};
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btEmptyShape no_shape;
  GuidedWorld world{&dispatcher, &broadphase, &solver, &configuration};

  std::unique_ptr<btRigidBody> make_body(double mass, const btVector3& inertia) {
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &no_shape, inertia);
    auto body = std::make_unique<btRigidBody>(info);
    body->setSleepingThresholds(0, 0);
    body->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(body.get(), 0, 0);
    return body;
  }
  ~Bodies() {
    while (world.getNumCollisionObjects() > 0)
      world.removeCollisionObject(world.getCollisionObjectArray()[world.getNumCollisionObjects() - 1]);
  }
};

World::World(std::uint64_t seed) : bodies_(std::make_unique<Bodies>(seed)) {
  bodies_->world.getDispatchInfo().m_deterministicOverlappingPairs = true;
  bodies_->world.setGravity(btVector3(0, 0, 0));
}

World::~World() = default;

Shaft& World::add_shaft(const ShaftDefinition& definition) {
  assert(definition.inertia > 0);
  const double j = definition.inertia;
  ShaftBody& s = *bodies_->world.shafts.emplace_back(std::make_unique<ShaftBody>());
  s.name = definition.name;
  s.body = bodies_->make_body(1, btVector3(j, j, j));
  s.body->setLinearFactor(btVector3(0, 0, 0));
  s.body->setAngularFactor(btVector3(0, 0, 1));
  const double whole = std::floor(definition.revolutions);
  s.state.inertia = j;
  s.state.speed = s.state.speed_before = definition.speed;
  s.state.turns = s.state.turns_before = static_cast<std::int64_t>(whole);
  s.state.part = s.state.part_before = definition.revolutions - whole;
  return s.state;
}

Slide& World::add_slide(const SlideDefinition& definition) {
  assert(definition.mass > 0);
  auto& list = definition.slow ? bodies_->world.slow_slides : bodies_->world.slides;
  SlideBody& s = *list.emplace_back(std::make_unique<SlideBody>());
  s.name = definition.name;
  s.axis = btVector3(definition.axis[0], definition.axis[1], definition.axis[2]);
  s.weight = definition.gravity ? definition.mass * -units::gravity * definition.axis[1] : 0;
  s.body = bodies_->make_body(definition.mass, btVector3(0, 0, 0));
  s.body->setAngularFactor(btVector3(0, 0, 0));
  s.state.mass = definition.mass;
  s.state.speed = s.state.speed_before = definition.speed;
  s.state.position = s.state.position_before = definition.position;
  return s.state;
}

void World::set_mass(Slide& slide, double mass) {
  assert(mass > 0);
  for (auto* list : {&bodies_->world.slides, &bodies_->world.slow_slides})
    for (const auto& s : *list) {
      if (&s->state != &slide) continue;
      s->weight *= mass / s->state.mass;
      s->state.mass = mass;
      set_mass_of(*s->body, mass);
      return;
    }
  throw std::invalid_argument("World::set_mass: a slide of another world");
}

void World::set_inertia(Shaft& shaft, double inertia) {
  assert(inertia > 0);
  for (const auto& s : bodies_->world.shafts) {
    if (&s->state != &shaft) continue;
    shaft.inertia = inertia;
    set_inertia_of(*s->body, inertia);
    return;
  }
  throw std::invalid_argument("World::set_inertia: a shaft of another world");
}

void World::step(double h) {
  if (!failure_.empty()) return;
  GuidedWorld& world = bodies_->world;
  world.slow_too = slow_due();
  since_slow_ = world.slow_too ? 0 : since_slow_ + 1;
  world.internalSingleStepSimulation(h);
  if (world.failed != nullptr)
    failure_ = fmt::format(
        "{}: a speed of {:.4g} (rad/s or m/s) cannot be followed with a step of {:g} us; look for an "
        "unstable "
        "loop, a missing limit or too long a step",
        *world.failed, world.failed_speed, h * 1e6);
}

void Shaft::visit(StateArchive& archive) {
  STATE(archive, inertia, torque, speed, speed_before, turns, part, turns_before, part_before);
}

void Slide::visit(StateArchive& archive) {
  STATE(archive, mass, force, speed, speed_before, position, position_before, remainder, awake);
}

void World::visit(StateArchive& archive) {
  GuidedWorld& world = bodies_->world;
  int number = 0;  // two knives have bodies of the same names
  const auto visit_all = [&](auto& bodies) {
    for (auto& body : bodies) archive.named(fmt::format("{} {}", ++number, body->name), *body);
  };
  visit_all(world.shafts);
  visit_all(world.slides);
  visit_all(world.slow_slides);
  STATE(archive, since_slow_, failure_);
  if (archive.restores()) world.failed = nullptr;
}

Random World::random(std::string_view source) {
  std::uint64_t occurrence = 0;
  for (auto& [name, count] : bodies_->sources)
    if (name == source) return Random(bodies_->seed, source, ++count);
  bodies_->sources.emplace_back(source, occurrence);
  return Random(bodies_->seed, source, occurrence);
}

Pose World::pose(const Shaft& shaft) const {
  for (const auto& s : bodies_->world.shafts)
    if (&s->state == &shaft) return pose_of(*s);
  throw std::invalid_argument("World::pose: a shaft of another world");
}

Pose World::pose(const Slide& slide) const {
  for (auto* list : {&bodies_->world.slides, &bodies_->world.slow_slides})
    for (const auto& s : *list)
      if (&s->state == &slide) return pose_of(*s);
  throw std::invalid_argument("World::pose: a slide of another world");
}

}  // namespace drycut::plants
