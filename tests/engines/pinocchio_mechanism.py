"""The mechanism in Pinocchio.

Pinocchio's free-flyer speeds are linear and angular velocity in the body's own frame. Nothing here converts
them: `reduction.py` maps to the speeds [r'; w] in O through Pinocchio's own frame Jacobians and classical
accelerations.
"""

import numpy as np
import pinocchio as pin

from description import LEGS

ALIGNED = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


class PinocchioMechanism:
    name = "pinocchio"

    def __init__(self, description):
        self.description = description
        self.model = pin.Model()
        self.model.gravity = pin.Motion(description["gravity"], np.zeros(3))
        self.joints = {}
        self._add_joints()
        self._add_frames()
        self.set_massive(description.bodies)

    def _add_joints(self):
        model, description, at_parent = self.model, self.description, pin.SE3.Identity()
        self.joints["base"] = model.addJoint(0, pin.JointModelFreeFlyer(), at_parent, "base")
        self.slide_joints, self.hooke_joints = [], []
        for _, name, parent, joint, rotation, position in description.links():
            placement = pin.SE3(rotation, position)
            if joint == "slide":
                kind, joints = pin.JointModelPZ(), self.slide_joints
            else:
                kind = pin.JointModelUniversal(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
                joints = self.hooke_joints
            self.joints[name] = model.addJoint(self.joints[parent], kind, placement, name)
            joints.append(self.joints[name])
        self.joints["payload"] = model.addJoint(0, pin.JointModelFreeFlyer(), at_parent, "payload")

    def _add_frames(self):
        self.frames = {}
        for name, point in self.description.points.items():
            placement = pin.SE3(np.eye(3), point.position)
            frame = pin.Frame(f"point_{name}", self.joints[point.body], 0, placement, pin.FrameType.OP_FRAME)
            self.frames[name] = self.model.addFrame(frame)

    @property
    def speed_count(self):
        return self.model.nv

    @property
    def slide_speeds(self):
        """[6] indices of the prismatic speeds d'."""
        return np.array([self.model.idx_vs[joint] for joint in self.slide_joints])

    @property
    def leg_speeds(self):
        """[18] indices, per leg: prismatic, two Hooke speeds."""
        hooke = [self.model.idx_vs[joint] for joint in self.hooke_joints]
        return np.concatenate([[slide, first, first + 1] for slide, first in zip(self.slide_speeds, hooke)])

    def set_massive(self, names):
        """Gives the named bodies their mass and every other body none."""
        for name, joint in self.joints.items():
            body = self.description.bodies.get(name) if name in names else None
            self.model.inertias[joint] = (
                pin.Inertia(body.mass, body.com, body.inertia) if body else pin.Inertia.Zero()
            )
        self.data = self.model.createData()

    def set_base_inertia(self, mass, moment):
        """Gives the base a mass [kg] at its origin and an isotropic moment of inertia [kg m^2]."""
        self.model.inertias[self.joints["base"]] = pin.Inertia(mass, np.zeros(3), moment * np.eye(3))
        self.data = self.model.createData()

    def place(self, base, payload, legs):
        """Poses of base and payload, and [6][3] leg coordinates (d, two Hooke angles)."""
        q = pin.neutral(self.model)
        for name, pose in (("base", base), ("payload", payload)):
            first = self.model.idx_qs[self.joints[name]]
            q[first : first + 3] = pose.position
            q[first + 3 : first + 7] = pin.Quaternion(pose.rotation).normalized().coeffs()
        for i in LEGS:
            q[self.model.idx_qs[self.slide_joints[i]]] = legs[i][0]
            first = self.model.idx_qs[self.hooke_joints[i]]
            q[first : first + 2] = legs[i][1:]
        self.q, self.speeds = q, np.zeros(self.model.nv)
        self._update_positions()

    def _update_positions(self):
        pin.computeJointJacobians(self.model, self.data, self.q)
        pin.updateFramePlacements(self.model, self.data)

    def move(self, speeds):
        self.speeds = np.array(speeds)
        self._update_positions()
        self.accelerate(np.zeros(self.model.nv))

    def accelerate(self, acceleration):
        pin.forwardKinematics(self.model, self.data, self.q, self.speeds, acceleration)

    def position(self, point):
        return self.data.oMf[self.frames[point]].translation.copy()

    def rotation(self, point):
        """Rotation of the point's body frame, to O."""
        return self.data.oMf[self.frames[point]].rotation.copy()

    def jacobian(self, point):
        """[6][nv]: linear rows, then angular rows, O axes."""
        return pin.getFrameJacobian(self.model, self.data, self.frames[point], ALIGNED).copy()

    def velocity(self, point):
        """[6] linear, angular, O axes."""
        return pin.getFrameVelocity(self.model, self.data, self.frames[point], ALIGNED).vector.copy()

    def acceleration(self, point):
        """[6] second derivative of the point's position, angular acceleration, O axes."""
        return pin.getFrameClassicalAcceleration(
            self.model, self.data, self.frames[point], ALIGNED
        ).vector.copy()

    def mass_matrix(self):
        upper = np.triu(pin.crba(self.model, self.data, self.q))
        return upper + np.triu(upper, 1).T

    def joint_forces(self, acceleration, gravity):
        """[nv] forces for the acceleration at the present speeds, springs and dampers not included."""
        field = self.model.gravity.copy()
        if not gravity:
            self.model.gravity = pin.Motion.Zero()
        forces = pin.rnea(self.model, self.data, self.q, self.speeds, acceleration).copy()
        self.model.gravity = field
        return forces

    def gravity_forces(self):
        """[nv] gravity's share of `joint_forces`."""
        return pin.computeGeneralizedGravity(self.model, self.data, self.q).copy()

    def spring_forces(self):
        """[nv] joint forces of the springs: Hooke's law on d, as Pinocchio has no springs."""
        forces = np.zeros(self.model.nv)
        forces[self.slide_speeds] = -self.description["axial_stiffness"] * (
            self.slides() - self.description["rest_length"]
        )
        return forces

    def damping_forces(self):
        """[nv] joint forces of the viscous dampers, on Pinocchio's speed d'."""
        forces = np.zeros(self.model.nv)
        forces[self.slide_speeds] = -self.description["axial_damping"] * self.speeds[self.slide_speeds]
        return forces

    def wrench_forces(self, point, wrench):
        """[nv] joint forces equivalent to [force; moment] at a point, O axes."""
        return self.jacobian(point).T @ wrench

    def slides(self):
        """[6] prismatic coordinates d."""
        return np.array([self.q[self.model.idx_qs[joint]] for joint in self.slide_joints])

    def kinetic_energy(self):
        return pin.computeKineticEnergy(self.model, self.data, self.q, self.speeds)

    def potential_energy(self):
        stretch = self.slides() - self.description["rest_length"]
        springs = 0.5 * np.sum(self.description["axial_stiffness"] * stretch**2)
        return pin.computePotentialEnergy(self.model, self.data, self.q) + springs

    def momentum_rate(self, acceleration, about):
        """[6] rate of the mechanism's linear and angular momentum, the latter about a point fixed in O."""
        pin.computeCentroidalMomentumTimeVariation(self.model, self.data, self.q, self.speeds, acceleration)
        rate = self.data.dhg.vector.copy()
        rate[3:] += np.cross(self.data.com[0] - about, rate[:3])
        return rate

    def constrained_acceleration(self, forces):
        """[nv] from Pinocchio's own constrained forward dynamics (mu = 0), base free.

        Closures are 3D constraints between legs and payload, built and differentiated by Pinocchio itself.
        """
        models, datas = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
        for constraint in self._closures():
            models.append(constraint)
            datas.append(constraint.createData())
        pin.initConstraintDynamics(self.model, self.data, models, datas)
        settings = pin.ProximalSettings(1e-14, 0.0, 1)
        return pin.constraintDynamics(
            self.model, self.data, self.q, self.speeds, forces, models, datas, settings
        ).copy()

    def _closures(self):
        for i in LEGS:
            ends = [self.description.points[f"{name}_{i}"] for name in ("leg_end", "platform_point")]
            sides = [
                argument
                for end in ends
                for argument in (self.joints[end.body], pin.SE3(np.eye(3), end.position))
            ]
            yield pin.RigidConstraintModel(
                pin.ContactType.CONTACT_3D, self.model, *sides, pin.ReferenceFrame.LOCAL
            )
