// Forward dynamics of the mechanism by Pinocchio's constrainedDynamics: base, payload, movers and rods as bodies, the six rods
// closed onto the payload by 3D constraints, the base's motion prescribed by a 6D constraint.
//
// The mechanism is that of tests/engines/pinocchio_mechanism.py. What Pinocchio takes instead of our inputs (joint coordinates
// and speeds) is worked out by `pinocchio_prepare`, outside what is measured; forces of springs, dampers, actuators and the
// external wrench, and the base's acceleration, belong to the measured call.

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <pinocchio/algorithm/constrained-dynamics.hpp>
#include <pinocchio/multibody.hpp>

namespace {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
constexpr int kLegs = 6;

Vector3 vector3(const double* numbers) { return Eigen::Map<const Vector3>(numbers); }

Matrix3 matrix3(const double* row_major) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_major);
}

// Parameters of one leg in the order of `benches/src/pinocchio.rs`.
struct LegNumbers {
  double base_point[3], axis[3], platform_point[3];
  double rod_length, rod_mass, rod_inertia, rod_com_fraction, mover_mass, mover_offset, rest_length, stiffness, damping;
};

struct Numbers {
  LegNumbers legs[kLegs];
  double payload_mass, payload_com[3], payload_inertia[9], gravity[3];
};

// A state as `benches/src/states.rs` has it.
struct State {
  double base_position[3], base_rotation[9], base_velocity[6], base_acceleration[6];
  double platform_position[3], platform_rotation[9], platform_velocity[6], platform_acceleration[6];
  double actuator_force[kLegs], external_wrench[6];
};

struct Prepared {
  Eigen::VectorXd coordinates, speeds;
};

struct Peer {
  Numbers numbers;
  pinocchio::Model model;
  pinocchio::Data data;
  pinocchio::JointIndex base, payload, slide[kLegs], hooke[kLegs];
  Matrix3 mount[kLegs];
  std::vector<pinocchio::RigidConstraintModel, Eigen::aligned_allocator<pinocchio::RigidConstraintModel>> constraints;
  std::vector<pinocchio::RigidConstraintData, Eigen::aligned_allocator<pinocchio::RigidConstraintData>> constraint_data;
  pinocchio::ProximalSettings settings{1e-14, 0.0, 1};
  std::vector<Prepared> prepared;
  Eigen::VectorXd forces;

  explicit Peer(const Numbers& given) : numbers(given) {
    using pinocchio::SE3;
    base = model.addJoint(0, pinocchio::JointModelFreeFlyer(), SE3::Identity(), "base");
    // The prescribed base needs a regular inertia; its size has no influence.
    model.inertias[base] = pinocchio::Inertia(1.0, Vector3::Zero(), Matrix3::Identity());
    for (int i = 0; i < kLegs; ++i) {
      const LegNumbers& leg = numbers.legs[i];
      mount[i] = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), vector3(leg.axis)).toRotationMatrix();
      slide[i] = model.addJoint(base, pinocchio::JointModelPZ(), SE3(mount[i], vector3(leg.base_point)), "slide");
      hooke[i] = model.addJoint(slide[i], pinocchio::JointModelUniversal(Vector3::UnitX(), Vector3::UnitY()),
                                SE3::Identity(), "hooke");
      model.inertias[slide[i]] =
          pinocchio::Inertia(leg.mover_mass, Vector3(0, 0, -leg.mover_offset), Matrix3::Zero());
      const Vector3 across(leg.rod_inertia, leg.rod_inertia, 0.0);
      model.inertias[hooke[i]] = pinocchio::Inertia(
          leg.rod_mass, Vector3(0, 0, leg.rod_com_fraction * leg.rod_length), Matrix3(across.asDiagonal()));
    }
    payload = model.addJoint(0, pinocchio::JointModelFreeFlyer(), SE3::Identity(), "payload");
    model.inertias[payload] =
        pinocchio::Inertia(numbers.payload_mass, vector3(numbers.payload_com), matrix3(numbers.payload_inertia));
    model.gravity = pinocchio::Motion(vector3(numbers.gravity), Vector3::Zero());
    constraints.emplace_back(pinocchio::CONTACT_6D, model, base, SE3::Identity(), pinocchio::LOCAL);
    for (int i = 0; i < kLegs; ++i) {
      const LegNumbers& leg = numbers.legs[i];
      constraints.emplace_back(pinocchio::CONTACT_3D, model, hooke[i],
                               SE3(Matrix3::Identity(), Vector3(0, 0, leg.rod_length)), payload,
                               SE3(Matrix3::Identity(), vector3(leg.platform_point)), pinocchio::LOCAL);
    }
    for (const auto& constraint : constraints) constraint_data.push_back(constraint.createData());
    data = pinocchio::Data(model);
    pinocchio::initConstraintDynamics(model, data, constraints, constraint_data);
    forces = Eigen::VectorXd::Zero(model.nv);
  }

  void place_free(pinocchio::JointIndex joint, const double* position, const double* rotation, const double* velocity,
                  Prepared& result) const {
    const Matrix3 r = matrix3(rotation);
    result.coordinates.segment<3>(model.joints[joint].idx_q()) = vector3(position);
    result.coordinates.segment<4>(model.joints[joint].idx_q() + 3) = Eigen::Quaterniond(r).normalized().coeffs();
    result.speeds.segment<3>(model.joints[joint].idx_v()) = r.transpose() * vector3(velocity);
    result.speeds.segment<3>(model.joints[joint].idx_v() + 3) = r.transpose() * vector3(velocity + 3);
  }

  // Coordinates and speeds of a closed mechanism: (18), (30) and the Hooke joint's two angles of the rod's direction.
  Prepared prepare(const State& state) const {
    Prepared result{Eigen::VectorXd::Zero(model.nq), Eigen::VectorXd::Zero(model.nv)};
    place_free(base, state.base_position, state.base_rotation, state.base_velocity, result);
    place_free(payload, state.platform_position, state.platform_rotation, state.platform_velocity, result);
    const Matrix3 rb = matrix3(state.base_rotation), rp = matrix3(state.platform_rotation);
    for (int i = 0; i < kLegs; ++i) {
      const LegNumbers& leg = numbers.legs[i];
      // Everything in the mount's frame, whose z is the actuator axis.
      const Matrix3 to_mount = mount[i].transpose() * rb.transpose();
      const Vector3 lever = rp * vector3(leg.platform_point);
      const Vector3 arm = vector3(state.platform_position) + lever - vector3(state.base_position);
      const Vector3 x = to_mount * (arm - rb * vector3(leg.base_point));
      const Vector3 velocity = vector3(state.platform_velocity) + vector3(state.platform_velocity + 3).cross(lever) -
                               vector3(state.base_velocity) - vector3(state.base_velocity + 3).cross(arm);
      const Vector3 rate = to_mount * velocity;
      const double h = std::sqrt(leg.rod_length * leg.rod_length - x.head<2>().squaredNorm());
      const double length_rate = rate.z() + x.head<2>().dot(rate.head<2>()) / h;
      const Vector3 u = Vector3(x.x(), x.y(), h) / leg.rod_length;
      const Vector3 turn = (rate - Vector3(0, 0, length_rate)) / leg.rod_length;
      // u = (sin b, -sin a cos b, cos a cos b).
      const double a = std::atan2(-u.y(), u.z()), b = std::asin(u.x());
      const double b_rate = turn.x() / std::cos(b);
      const double a_rate = -(turn.y() * std::cos(a) + turn.z() * std::sin(a)) / std::cos(b);
      result.coordinates[model.joints[slide[i]].idx_q()] = x.z() - h;
      result.coordinates.segment<2>(model.joints[hooke[i]].idx_q()) << a, b;
      result.speeds[model.joints[slide[i]].idx_v()] = length_rate;
      result.speeds.segment<2>(model.joints[hooke[i]].idx_v()) << a_rate, b_rate;
    }
    return result;
  }

  void forward_dynamics(const State& state, const Prepared& at, double* acceleration) {
    for (int i = 0; i < kLegs; ++i) {
      const LegNumbers& leg = numbers.legs[i];
      const double length = at.coordinates[model.joints[slide[i]].idx_q()];
      const int speed = model.joints[slide[i]].idx_v();
      forces[speed] = state.actuator_force[i] - leg.stiffness * (length - leg.rest_length) - leg.damping * at.speeds[speed];
    }
    const int first = model.joints[payload].idx_v();
    const Matrix3 rp = matrix3(state.platform_rotation), rb = matrix3(state.base_rotation);
    const Vector3 force = rp.transpose() * vector3(state.external_wrench);
    forces.segment<3>(first) = force;
    forces.segment<3>(first + 3) =
        rp.transpose() * vector3(state.external_wrench + 3) + vector3(numbers.payload_com).cross(force);
    // Spatial acceleration in the base's own axes: the origin's own acceleration less w x v.
    const int base_first = model.joints[base].idx_v();
    const Vector3 v = at.speeds.segment<3>(base_first), w = at.speeds.segment<3>(base_first + 3);
    auto& desired = constraint_data[0].contact_acceleration_desired;
    desired.linear() = rb.transpose() * vector3(state.base_acceleration) - w.cross(v);
    desired.angular() = rb.transpose() * vector3(state.base_acceleration + 3);

    const auto& result = pinocchio::constraintDynamics(model, data, at.coordinates, at.speeds, forces, constraints,
                                                       constraint_data, settings);
    const Vector3 vp = at.speeds.segment<3>(first), wp = at.speeds.segment<3>(first + 3);
    Eigen::Map<Vector3>(acceleration).noalias() = rp * (result.segment<3>(first) + wp.cross(vp));
    Eigen::Map<Vector3>(acceleration + 3).noalias() = rp * result.segment<3>(first + 3);
  }
};

}  // namespace

extern "C" {

// A new mechanism for `count` states; released by `pinocchio_free`.
void* pinocchio_new(const double* numbers, const double* states, size_t count) {
  auto peer = std::make_unique<Peer>(*reinterpret_cast<const Numbers*>(numbers));
  const auto* first = reinterpret_cast<const State*>(states);
  for (size_t k = 0; k < count; ++k) peer->prepared.push_back(peer->prepare(first[k]));
  return peer.release();
}

void pinocchio_free(void* peer) { delete static_cast<Peer*>(peer); }

// Platform acceleration at `state`, which is the one with this index of those given to `pinocchio_new`.
void pinocchio_forward_dynamics(void* peer, const double* state, size_t index, double* acceleration) {
  auto* self = static_cast<Peer*>(peer);
  self->forward_dynamics(*reinterpret_cast<const State*>(state), self->prepared[index], acceleration);
}
}
