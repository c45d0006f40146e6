#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "tests/bench/mechanism.hpp"

namespace drycut::bench {

namespace {

std::unique_ptr<btRigidBody> make_body(btDiscreteDynamicsWorld& world, btCollisionShape& shape, double mass,
                                       double inertia, double x) {
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, btVector3(inertia, inertia, inertia));
  info.m_startWorldTransform.setIdentity();
  info.m_startWorldTransform.setOrigin(btVector3(x, 0, 0));
  auto body = std::make_unique<btRigidBody>(info);
  body->setActivationState(DISABLE_DEACTIVATION);
  world.addRigidBody(body.get());
  return body;
}

}  // namespace

double run_bullet(const Mechanism& m, std::int64_t steps) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, 0));
  btSphereShape shape(0.01);
  const auto motor = make_body(world, shape, 10, m.motor_inertia, 0);
  const auto drum = make_body(world, shape, 90, m.drum_inertia, 1);
  const auto web = make_body(world, shape, m.web_mass, 1, 2);
  const btVector3 axis(0, 0, 1);
  btHingeConstraint motor_hinge(*motor, btVector3(0, 0, 0), axis);
  btHingeConstraint drum_hinge(*drum, btVector3(0, 0, 0), axis);
  btSliderConstraint web_slider(*web, btTransform::getIdentity(), true);
  web_slider.setLowerLinLimit(1);  // lower above upper: free
  web_slider.setUpperLinLimit(-1);
  web->setLinearVelocity(btVector3(1, 0, 0));
  world.addConstraint(&motor_hinge);
  world.addConstraint(&drum_hinge);
  world.addConstraint(&web_slider);

  double motor_angle = 0;
  double drum_angle = 0;
  for (std::int64_t i = 0; i < steps; ++i) {
    const double motor_speed = motor->getAngularVelocity().z();
    const double drum_speed = drum->getAngularVelocity().z();
    const double twist = motor_angle / m.ratio - drum_angle;
    const double gear = m.stiffness * twist + m.damping * (motor_speed / m.ratio - drum_speed);
    motor->applyTorque(btVector3(0, 0, m.torque - gear / m.ratio));
    drum->applyTorque(btVector3(0, 0, gear - m.friction * drum_speed));
    world.stepSimulation(m.step, 0, m.step);
    motor_angle += motor->getAngularVelocity().z() * m.step;
    drum_angle += drum->getAngularVelocity().z() * m.step;
  }
  const double result = drum->getAngularVelocity().z();
  world.removeConstraint(&motor_hinge);
  world.removeConstraint(&drum_hinge);
  world.removeConstraint(&web_slider);
  for (const auto* body : {&motor, &drum, &web}) world.removeRigidBody(body->get());
  return result;
}

}  // namespace drycut::bench
