"""The mechanism in Exudyn: rigid bodies, joints, springs and loads. No equation of motion.

    base          no mass; its six coordinates are constrained to the prescribed motion
    base -- mover i      prismatic along the actuator axis a_i; spring and damper between b_i and the Hooke joint
    mover i -- rod i     Hooke: x of the mover's frame stays square to y of the rod's
    rod i -- platform    spherical (the universal joint's three rotations)
    platform      free

The mover is a point mass: its guide turns it with the base. The rod has transverse inertia only; Exudyn accepts zero
about its own axis, where the Hooke joint leaves no freedom. The actuator force acts on the mover along a_i; what it
does to the base is of no account, since the base's motion is given.

Every body's own axes are those of O at the start, so its rotation coordinates start at zero, far from the
singularity of three angles. Joint frames and mass properties are turned into these axes here.
"""

from dataclasses import dataclass

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np

LEGS = range(6)
NO_OFFSET = np.zeros(3)
POINT_MASS = np.zeros((3, 3))


@dataclass(frozen=True)
class Pose:
    """Position [m] and rotation matrix of a frame, to O."""

    position: np.ndarray
    rotation: np.ndarray


@dataclass(frozen=True)
class Placement:
    """Frames at the start: B, P, and per leg the mover's and the rod's.

    Both of a leg's frames have their origin at the Hooke joint; z along the actuator axis, and along the rod.
    """

    base: Pose
    platform: Pose
    movers: list
    rods: list


class Body:
    """An Exudyn rigid body whose frame stands at `pose` at the start. Points are given in that frame, m."""

    def __init__(self, system, pose, mass=0.0, com=NO_OFFSET, inertia=POINT_MASS, gravity=None):
        self.system, self.pose = system, pose
        com = pose.rotation @ com
        about_origin = pose.rotation @ inertia @ pose.rotation.T + mass * (com @ com * np.eye(3) - np.outer(com, com))
        x, y, z = about_origin
        self.node = system.AddNode(items.NodeRigidBodyRxyz(referenceCoordinates=[*pose.position, 0.0, 0.0, 0.0]))
        self.number = system.AddObject(
            items.ObjectRigidBody(
                nodeNumber=self.node,
                mass=mass,
                centerOfMass=com,
                inertia=[x[0], y[1], z[2], y[2], x[2], x[1]],
            )
        )
        if gravity is not None:
            marker = system.AddMarker(items.MarkerBodyMass(bodyNumber=self.number))
            system.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=gravity))

    def marker(self, point=NO_OFFSET, axes=None):
        """Marker at the point; its axes, for a joint frame, as they stand at the start (columns, O)."""
        place = exu.HT(rotation=np.eye(3) if axes is None else axes, translation=self.pose.rotation @ np.array(point))
        return self.system.AddMarker(items.MarkerBodyRigid(bodyNumber=self.number, localHT=place))

    def sensor(self, quantity):
        return self.system.AddSensor(
            items.SensorBody(bodyNumber=self.number, outputVariableType=quantity, storeInternal=True)
        )

    def present_pose(self):
        """Pose of the frame in the state that Exudyn holds as current."""
        variable = exu.OutputVariableType
        position = self.system.GetObjectOutputBody(self.number, variable.Position)
        turned = self.system.GetObjectOutputBody(self.number, variable.RotationMatrix)
        return Pose(np.array(position), np.array(turned).reshape(3, 3) @ self.pose.rotation)


class Mechanism:
    """The assembled system.

    `parameters`: a resolved platform's, as arrays. `gravity`: m/s^2, O; zero for none.
    """

    def __init__(self, parameters, placement, gravity):
        self.parameters = parameters
        self.container = exu.SystemContainer()
        self.system = self.container.AddSystem()
        self.base = Body(self.system, placement.base)
        self.platform = Body(
            self.system,
            placement.platform,
            float(parameters["payload_mass"]),
            parameters["payload_com"],
            parameters["payload_inertia"],
            gravity,
        )
        self.movers, self.rods, self.springs, self.actuators = [], [], [], []
        for i in LEGS:
            self._add_leg(i, placement.movers[i], placement.rods[i], gravity)
        self._add_guide()
        self._add_sensors()
        self.system.Assemble()

    def _add_leg(self, i, mover_pose, rod_pose, gravity):
        p = {name: value[i] for name, value in self.parameters.items() if np.shape(value)[:1] == (len(LEGS),)}
        transverse = p["rod_inertia"]
        rod_com = np.array([0.0, 0.0, p["rod_com_fraction"] * p["rod_length"]])
        mover_com = np.array([0.0, 0.0, -p["mover_offset"]])
        mover = Body(self.system, mover_pose, p["mover_mass"], mover_com, POINT_MASS, gravity)
        rod = Body(self.system, rod_pose, p["rod_mass"], rod_com, np.diag([transverse, transverse, 0.0]), gravity)
        axes = mover_pose.rotation
        on_base, on_mover = self.base.marker(p["base_point"], axes), mover.marker(axes=axes)
        self.system.AddObject(items.GenericJoint(markerNumbers=[on_base, on_mover], constrainedAxes=[1, 1, 0, 1, 1, 1]))
        on_rod = rod.marker(axes=rod_pose.rotation)
        self.system.AddObject(items.GenericJoint(markerNumbers=[on_mover, on_rod], constrainedAxes=[1, 1, 1, 0, 0, 1]))
        ends = [rod.marker([0.0, 0.0, p["rod_length"]]), self.platform.marker(p["platform_point"])]
        self.system.AddObject(items.SphericalJoint(markerNumbers=ends))
        along = np.diag([0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
        spring = items.RigidBodySpringDamper(
            markerNumbers=[on_base, on_mover],
            stiffness=p["axial_stiffness"] * along,
            damping=p["axial_damping"] * along,
            offset=[0.0, 0.0, p["rest_length"], 0.0, 0.0, 0.0],
        )
        self.springs.append(self.system.AddObject(spring))
        force = items.LoadForceVector(markerNumber=mover.marker(), loadVector=NO_OFFSET, bodyFixed=True)
        self.actuators.append((self.system.AddLoad(force), axes[:, 2]))
        self.movers.append(mover)
        self.rods.append(rod)

    def _add_guide(self):
        ground = self.system.AddNode(items.NodePointGround())
        fixed = self.system.AddMarker(items.MarkerNodeCoordinates(nodeNumber=ground))
        moving = self.system.AddMarker(items.MarkerNodeCoordinates(nodeNumber=self.base.node))
        self.guide = self.system.AddObject(
            items.CoordinateVectorConstraint(
                markerNumbers=[fixed, moving],
                scalingMarker0=np.zeros((6, 0)),
                scalingMarker1=np.eye(6),
                offset=np.zeros(6),
                velocityLevel=True,
            )
        )

    def _add_sensors(self):
        variable = exu.OutputVariableType
        self.platform_sensors = {
            "position": self.platform.sensor(variable.Position),
            "rotation": self.platform.sensor(variable.RotationMatrix),
            "velocity": self.platform.sensor(variable.Velocity),
            "angular_velocity": self.platform.sensor(variable.AngularVelocity),
            "acceleration": self.platform.sensor(variable.Acceleration),
            "angular_acceleration": self.platform.sensor(variable.AngularAcceleration),
        }
        self.length_sensors = [
            self.system.AddSensor(
                items.SensorObject(
                    objectNumber=spring, outputVariableType=variable.DisplacementLocal, storeInternal=True
                )
            )
            for spring in self.springs
        ]

    def set_base_rates(self, rates):
        """Prescribes the rates of the base's coordinates, [6]."""
        self.system.SetObjectParameter(self.guide, "offset", rates)

    def set_actuator_forces(self, forces):
        """[6] N, on the movers along +a_i."""
        for (load, axis), force in zip(self.actuators, forces):
            self.system.SetLoadParameter(load, "loadVector", force * axis)

    def coordinates_of(self, body):
        """Slice of the body's six coordinates in the system's."""
        first = self.system.GetNodeODE2Index(body.node)
        return slice(first, first + 6)
