#include "tumble.h"

#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <random>

#include "base/point_ops.h"

namespace medial_vk::bench {
namespace {

constexpr double kSide = 10;  // of the solid in Bullet, as the source scales its models

btVector3 vector_of(const Point& p) {
  return {static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2])};
}

/// Bullet computes in float; a rotation is made from its quaternion in double, so that it is one.
Pose pose_of(const btTransform& transform) {
  const btQuaternion turn = transform.getRotation();
  double w = turn.w(), x = turn.x(), y = turn.y(), z = turn.z();
  const double norm = std::sqrt(w * w + x * x + y * y + z * z);
  w /= norm, x /= norm, y /= norm, z /= norm;
  const btVector3& at = transform.getOrigin();
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}},
          {at.x(), at.y(), at.z()}};
}

Pose inverse_of(const Pose& pose) {
  Pose inverse;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) inverse.rotation[i][j] = pose.rotation[j][i];
  }
  inverse.shift = -1 * (inverse * pose.shift);
  return inverse;
}

/// The balls as one rigid shape, about its centre of mass and along its principal axes.
class Compound {
 public:
  Compound(std::span<const Ball> balls, const Point& middle, double scale) {
    std::vector<btScalar> masses;
    btCompoundShape in_frame_of_solid;
    for (const Ball& ball : balls) {
      spheres_.push_back(std::make_unique<btSphereShape>(static_cast<btScalar>(scale * ball.radius)));
      const btTransform at(btQuaternion::getIdentity(), vector_of(scale * (ball.centre - middle)));
      in_frame_of_solid.addChildShape(at, spheres_.back().get());
      masses.push_back(static_cast<btScalar>(std::pow(scale * ball.radius, 3)));
    }
    btVector3 inertia;
    in_frame_of_solid.calculatePrincipalAxisTransform(masses.data(), principal_, inertia);
    double sum = 0;
    for (const btScalar mass : masses) sum += mass;
    inertia_ = inertia / static_cast<btScalar>(sum);  // of mass 1
    for (int i = 0; i < in_frame_of_solid.getNumChildShapes(); ++i) {
      shape_.addChildShape(principal_.inverse() * in_frame_of_solid.getChildTransform(i),
                           in_frame_of_solid.getChildShape(i));
    }
  }

  btCompoundShape* shape() { return &shape_; }
  const btVector3& inertia() const { return inertia_; }
  /// From the frame of the shape to that of the solid, about its middle.
  const btTransform& principal() const { return principal_; }

 private:
  std::vector<std::unique_ptr<btSphereShape>> spheres_;
  btCompoundShape shape_;
  btTransform principal_;
  btVector3 inertia_;
};

/// A cube around the origin, and bodies in it.
class World {
 public:
  explicit World(double half) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const btScalar toward : {btScalar{-1}, btScalar{1}}) {
        btVector3 inwards(0, 0, 0);
        inwards[axis] = -toward;
        walls_.push_back(std::make_unique<btStaticPlaneShape>(inwards, static_cast<btScalar>(-half)));
        add({0, nullptr, walls_.back().get()});
      }
    }
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  btRigidBody& add(Compound& compound, const btTransform& at) {
    btRigidBody& body = add({1, nullptr, compound.shape(), compound.inertia()});
    body.setWorldTransform(at);
    body.setInterpolationWorldTransform(at);
    body.setActivationState(DISABLE_DEACTIVATION);
    return body;
  }

  void step(const btVector3& gravity) {
    world_.setGravity(gravity);
    world_.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
  }

 private:
  btRigidBody& add(btRigidBody::btRigidBodyConstructionInfo info) {
    info.m_restitution = btScalar(0.8);
    info.m_friction = btScalar(0.3);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world_.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btStaticPlaneShape>> walls_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

btVector3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<> normal;
  const Point d = {normal(random), normal(random), normal(random)};
  return vector_of((1 / length(d)) * d);
}

}  // namespace

std::vector<Pose> tumble(std::span<const Ball> balls, const Point& middle, double side, std::size_t frames) {
  const double scale = kSide / side;
  Compound compound(balls, middle, scale);
  World world(1.2 * kSide);
  const auto at = [&](double x) {
    return btTransform(btQuaternion::getIdentity(), vector_of({x, 0, 0})) * compound.principal();
  };
  btRigidBody& a = world.add(compound, at(-0.6 * kSide));
  btRigidBody& b = world.add(compound, at(0.6 * kSide));
  const Pose from_shape = inverse_of(pose_of(compound.principal()));  // of the solid, about its middle
  std::mt19937_64 random(1);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < frames; ++i) {
    world.step(btScalar(9.81 * kSide) * random_direction(random));
    Pose pose = inverse_of(pose_of(a.getWorldTransform()) * from_shape) * (pose_of(b.getWorldTransform()) * from_shape);
    const Point turned = Pose{pose.rotation, {0, 0, 0}} * middle;
    pose.shift = (1 / scale) * pose.shift + middle - turned;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace medial_vk::bench
