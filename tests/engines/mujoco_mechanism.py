"""The mechanism in MuJoCo.

MuJoCo's free-joint speeds are the frame origin's velocity in world axes and the angular velocity in body
axes. Nothing here converts them: `reduction.py` maps to the speeds [r'; w] in O through MuJoCo's own site
Jacobians and site accelerations. MuJoCo's contact and constraint solver is never used.
"""

import mujoco
import numpy as np

from description import LEGS


class MujocoMechanism:
    name = "mujoco"

    def __init__(self, description):
        self.description = description
        self.model = self._compile()
        self.data = mujoco.MjData(self.model)
        self.sites = {name: self._id(mujoco.mjtObj.mjOBJ_SITE, name) for name in description.points}
        self.body_ids = {
            name: self._id(mujoco.mjtObj.mjOBJ_BODY, name) for name in ("base", *description.bodies)
        }
        self.joints = {name: self._id(mujoco.mjtObj.mjOBJ_JOINT, name) for name in self._joint_names()}
        self.set_massive(description.bodies)

    def _compile(self):
        # The compiler fixes the sparsity of the mass matrix by inertial frames, so these must be true
        # already here; it also wants positive masses and moments: `set_massive` puts the true ones in, zeros
        # included.
        description, spec = self.description, mujoco.MjSpec()
        spec.option.gravity = description["gravity"]
        base = self._add_body(spec.worldbody, "base")
        base.add_freejoint(name="base")
        payload = self._add_body(spec.worldbody, "payload")
        payload.add_freejoint(name="payload")
        bodies = {"base": base, "payload": payload}
        for i, name, parent, joint, rotation, position in description.links():
            turn = np.zeros(4)
            mujoco.mju_mat2Quat(turn, rotation.flatten())
            bodies[name] = self._add_body(bodies[parent], name, pos=position, quat=turn)
            if joint == "slide":
                self._add_slide(bodies[name], i)
            else:
                bodies[name].add_joint(name=f"hooke_first_{i}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[1, 0, 0])
                bodies[name].add_joint(name=f"hooke_second_{i}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0])
        for name, point in description.points.items():
            bodies[point.body].add_site(name=name, pos=point.position)
        return spec.compile()

    def _add_slide(self, body, i):
        slide = body.add_joint(name=f"slide_{i}", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
        slide.springref = self.description["rest_length"][i]
        slide.stiffness[0] = self.description["axial_stiffness"][i]
        slide.damping[0] = self.description["axial_damping"][i]

    def _add_body(self, parent, name, **placement):
        body = parent.add_body(
            name=name, mass=1.0, inertia=[1.0, 1.0, 1.0], explicitinertial=True, **placement
        )
        if name in self.description.bodies:
            body.ipos = self.description.bodies[name].com
            body.iquat = _principal(self.description.bodies[name].inertia)[1]
        return body

    @staticmethod
    def _joint_names():
        legs = [f"{kind}_{i}" for i in LEGS for kind in ("slide", "hooke_first", "hooke_second")]
        return ["base", "payload", *legs]

    def _id(self, kind, name):
        return mujoco.mj_name2id(self.model, kind, name)

    @property
    def speed_count(self):
        return self.model.nv

    @property
    def slide_speeds(self):
        """[6] indices of the prismatic speeds d'."""
        return np.array([self.model.jnt_dofadr[self.joints[f"slide_{i}"]] for i in LEGS])

    @property
    def leg_speeds(self):
        """[18] indices, per leg: prismatic, two Hooke speeds."""
        return np.array([self.model.jnt_dofadr[self.joints[name]] for name in self._joint_names()[2:]])

    def set_massive(self, names):
        """Gives the named bodies their mass and every other body none."""
        model = self.model
        model.body_mass[:], model.body_inertia[:] = 0.0, 0.0
        for name in names:
            body, index = self.description.bodies[name], self.body_ids[name]
            model.body_mass[index], model.body_inertia[index] = body.mass, _principal(body.inertia)[0]
        # Subtree masses; these only choose the reference point of MuJoCo's internal sums.
        total = model.body_mass.copy()
        for index in range(model.nbody - 1, 0, -1):
            total[model.body_parentid[index]] += total[index]
        model.body_subtreemass[:] = total

    def place(self, base, payload, legs):
        """Poses of base and payload, and [6][3] leg coordinates (d, two Hooke angles)."""
        q = self.data.qpos
        for name, pose in (("base", base), ("payload", payload)):
            first = self.model.jnt_qposadr[self.joints[name]]
            turn = np.zeros(4)
            mujoco.mju_mat2Quat(turn, pose.rotation.flatten())
            q[first : first + 3], q[first + 3 : first + 7] = pose.position, turn
        for i in LEGS:
            for name, coordinate in zip(("slide", "hooke_first", "hooke_second"), legs[i]):
                q[self.model.jnt_qposadr[self.joints[f"{name}_{i}"]]] = coordinate
        self.move(np.zeros(self.model.nv))

    def move(self, speeds):
        self.data.qvel[:] = speeds
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_comVel(self.model, self.data)
        self.accelerate(np.zeros(self.model.nv))

    def accelerate(self, acceleration):
        # Without the field, MuJoCo's body accelerations are inertial ones.
        field = self.model.opt.gravity.copy()
        self.model.opt.gravity[:] = 0.0
        self.data.qacc[:] = acceleration
        mujoco.mj_rnePostConstraint(self.model, self.data)
        self.model.opt.gravity[:] = field

    def position(self, point):
        return self.data.site_xpos[self.sites[point]].copy()

    def rotation(self, point):
        """Rotation of the point's body frame, to O."""
        return self.data.site_xmat[self.sites[point]].reshape(3, 3).copy()

    def jacobian(self, point):
        """[6][nv]: linear rows, then angular rows, O axes."""
        linear, angular = np.zeros((3, self.model.nv)), np.zeros((3, self.model.nv))
        mujoco.mj_jacSite(self.model, self.data, linear, angular, self.sites[point])
        return np.vstack([linear, angular])

    def velocity(self, point):
        """[6] linear, angular, O axes."""
        return self._object_motion(mujoco.mj_objectVelocity, point)

    def acceleration(self, point):
        """[6] second derivative of the point's position, angular acceleration, O axes."""
        return self._object_motion(mujoco.mj_objectAcceleration, point)

    def _object_motion(self, query, point):
        motion = np.zeros(6)
        query(self.model, self.data, mujoco.mjtObj.mjOBJ_SITE, self.sites[point], motion, 0)
        return np.concatenate([motion[3:], motion[:3]])

    def mass_matrix(self):
        matrix = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_makeM(self.model, self.data)
        mujoco.mj_fullM(self.model, self.data, matrix)
        return matrix

    def joint_forces(self, acceleration, gravity):
        """[nv] forces for the acceleration at the present speeds, springs and dampers not included."""
        field = self.model.opt.gravity.copy()
        if not gravity:
            self.model.opt.gravity[:] = 0.0
        self.data.qacc[:] = acceleration
        forces = np.zeros(self.model.nv)
        mujoco.mj_rne(self.model, self.data, 1, forces)
        self.model.opt.gravity[:] = field
        return forces

    def gravity_forces(self):
        """[nv] gravity's share of `joint_forces`."""
        speeds = self.data.qvel.copy()
        self.move(np.zeros(self.model.nv))
        forces = self.joint_forces(np.zeros(self.model.nv), gravity=True)
        self.move(speeds)
        return forces

    def spring_forces(self):
        """[nv] joint forces of MuJoCo's joint springs."""
        mujoco.mj_passive(self.model, self.data)
        return self.data.qfrc_spring.copy()

    def damping_forces(self):
        """[nv] joint forces of MuJoCo's joint dampers."""
        mujoco.mj_passive(self.model, self.data)
        return self.data.qfrc_damper.copy()

    def wrench_forces(self, point, wrench):
        """[nv] joint forces equivalent to [force; moment] at a point, O axes."""
        forces = np.zeros(self.model.nv)
        body = self.model.site_bodyid[self.sites[point]]
        mujoco.mj_applyFT(self.model, self.data, wrench[:3], wrench[3:], self.position(point), body, forces)
        return forces

    def slides(self):
        """[6] prismatic coordinates d."""
        return np.array([self.data.qpos[self.model.jnt_qposadr[self.joints[f"slide_{i}"]]] for i in LEGS])

    def kinetic_energy(self):
        mujoco.mj_makeM(self.model, self.data)
        mujoco.mj_energyVel(self.model, self.data)
        return self.data.energy[1]

    def potential_energy(self):
        mujoco.mj_energyPos(self.model, self.data)
        return self.data.energy[0]


def _principal(inertia):
    """Principal moments and the quaternion of their axes.

    MuJoCo's compiler could find them, but stops at 1e-12.
    """
    moments, axes = np.linalg.eigh(inertia)
    axes[:, 2] *= np.sign(np.linalg.det(axes))
    turn = np.zeros(4)
    mujoco.mju_mat2Quat(turn, axes.flatten())
    return moments, turn
