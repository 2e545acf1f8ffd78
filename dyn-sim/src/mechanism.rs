//! The dynamics behind a simulation: generated models, with gravity or without.

use dyn_platform::Platform;
use dyn_runtime::models::{Parameters, Uhp, Uhp2016};
use dyn_runtime::nalgebra::{Matrix6, Vector3, Vector6};
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, LegKinematics, Limits, MIN_ROD_ALIGNMENT, Monitor,
    PlatformState, Wrench, kernels,
};

use crate::rotation::rows;

/// The default platform file, whose model is compiled in.
const DEFAULT_PLATFORM: &str = include_str!("../../platforms/uhp_2016.toml");

/// What a simulation asks of a mechanism. Inputs and results in SI units and O axes.
pub trait Mechanism {
    /// v_p' under `actuator_force_n` (N, along the actuators' axes, on the movers).
    ///
    /// # Errors
    /// Poses that the legs do not reach; see [`Hexapod`].
    fn forward_dynamics(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        actuator_force_n: &Vector6<f64>,
    ) -> Result<Acceleration, Error>;

    /// The same within an integration step that began at a state which [`forward_dynamics`](Self::forward_dynamics)
    /// accepted: only what makes the result useless is refused.
    ///
    /// # Errors
    /// As above.
    fn forward_dynamics_within_step(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        actuator_force_n: &Vector6<f64>,
    ) -> Result<Acceleration, Error> {
        self.forward_dynamics(base, platform, actuator_force_n)
    }

    /// The actuator forces (N) that give the platform `acceleration`.
    ///
    /// # Errors
    /// Poses that the legs do not reach, singular poses; see [`Hexapod`].
    fn inverse_dynamics(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        acceleration: &Acceleration,
    ) -> Result<Vector6<f64>, Error>;

    /// Lengths, rates and directions of the legs; accelerations are those of a base and a platform without any.
    ///
    /// # Errors
    /// Poses that the legs do not reach; see [`Hexapod`].
    fn leg_kinematics(&self, base: &BaseMotion, platform: &PlatformState) -> Result<LegKinematics, Error>;

    /// Determinant of J_dp (m^3), zero at a singular pose; not a number out of reach.
    fn jacobian_determinant(&self, base: &BaseMotion, platform: &PlatformState) -> f64;

    /// What is left of `limits` in this state under these forces (N).
    ///
    /// # Errors
    /// Poses that the legs do not reach; see [`Hexapod`].
    fn monitor(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        actuator_force_n: &Vector6<f64>,
        limits: &Limits,
    ) -> Result<Monitor, Error>;
}

/// The generated functions that a simulation uses.
pub trait Functions:
    kernels::RodAlignment
    + kernels::LegKinematics
    + kernels::JacobianDp
    + kernels::ActuatorGeometry
    + kernels::InverseDynamics
    + kernels::ForwardDynamics
{
}

impl<M> Functions for M where
    M: kernels::RodAlignment
        + kernels::LegKinematics
        + kernels::JacobianDp
        + kernels::ActuatorGeometry
        + kernels::InverseDynamics
        + kernels::ForwardDynamics
{
}

/// A generated model under its own gravity, or under none.
///
/// Gravity enters the equations only through `r'' - g` of each body. So a model with gravity answers for a world
/// without it when accelerations are seen from a frame that falls with g: g is added to those that go in and
/// subtracted from those that come out. That is exact, and the baked model serves both worlds.
#[derive(Clone, Debug)]
pub struct Model<M> {
    hexapod: Hexapod<M>,
    fall: Vector3<f64>,
}

impl<M> Model<M> {
    /// Under the gravity that is part of `model`.
    pub fn with_gravity(model: M) -> Self {
        Self { hexapod: Hexapod::new(model), fall: Vector3::zeros() }
    }

    /// Weightless; `gravity` (m/s^2, O) is what is part of `model`.
    pub fn without_gravity(model: M, gravity: [f64; 3]) -> Self {
        Self { hexapod: Hexapod::new(model), fall: gravity.into() }
    }

    fn seen_falling(&self, acceleration: &Acceleration, sign: f64) -> Acceleration {
        Acceleration { linear_m_s2: acceleration.linear_m_s2 + self.fall * sign, ..*acceleration }
    }

    /// Base's motion as `self.hexapod` is to see it.
    fn falling_base(&self, base: &BaseMotion) -> BaseMotion {
        BaseMotion { acceleration: self.seen_falling(&base.acceleration, 1.0), ..*base }
    }
}

impl<M: Functions> Model<M> {
    fn rod_alignment(&self, base: &BaseMotion, platform: &PlatformState) -> [f64; 6] {
        let mut alignment = [0.0; 6];
        self.hexapod.model.rod_alignment(
            base.pose.position_m.as_ref(),
            &rows(&base.pose.rotation),
            platform.pose.position_m.as_ref(),
            &rows(&platform.pose.rotation),
            &mut alignment,
        );
        alignment
    }

    /// The unchecked function; where the legs do not reach or its result is not finite, the checked call, which knows
    /// why. Checking every input took a fifth of a simulation's time, and a simulation makes its rotations itself.
    fn forward_dynamics_if(
        &self,
        reached: bool,
        base: &BaseMotion,
        platform: &PlatformState,
        actuator_force_n: &Vector6<f64>,
    ) -> Result<Acceleration, Error> {
        if reached {
            let (seen, mut found) = (self.seen_falling(&base.acceleration, 1.0), [0.0; 6]);
            self.hexapod.model.forward_dynamics(
                base.pose.position_m.as_ref(),
                &rows(&base.pose.rotation),
                &six(&base.velocity.linear_m_s, &base.velocity.angular_rad_s),
                &six(&seen.linear_m_s2, &seen.angular_rad_s2),
                platform.pose.position_m.as_ref(),
                &rows(&platform.pose.rotation),
                &six(&platform.velocity.linear_m_s, &platform.velocity.angular_rad_s),
                actuator_force_n.as_ref(),
                &[0.0; 6],
                &mut found,
            );
            let [x, y, z, rx, ry, rz] = found;
            if (x + y + z + rx + ry + rz).is_finite() {
                let found = Acceleration {
                    linear_m_s2: Vector3::new(x, y, z),
                    angular_rad_s2: Vector3::new(rx, ry, rz),
                };
                return Ok(self.seen_falling(&found, -1.0));
            }
        }
        let base = self.falling_base(base);
        let found = self.hexapod.forward_dynamics(&base, platform, actuator_force_n, &Wrench::zero())?;
        Ok(self.seen_falling(&found, -1.0))
    }
}

impl<M: Functions> Mechanism for Model<M> {
    fn forward_dynamics(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        actuator_force_n: &Vector6<f64>,
    ) -> Result<Acceleration, Error> {
        let reached =
            self.rod_alignment(base, platform).iter().all(|alignment| *alignment >= MIN_ROD_ALIGNMENT);
        self.forward_dynamics_if(reached, base, platform, actuator_force_n)
    }

    fn forward_dynamics_within_step(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        actuator_force_n: &Vector6<f64>,
    ) -> Result<Acceleration, Error> {
        self.forward_dynamics_if(true, base, platform, actuator_force_n)
    }

    fn inverse_dynamics(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        acceleration: &Acceleration,
    ) -> Result<Vector6<f64>, Error> {
        let base = self.falling_base(base);
        let acceleration = self.seen_falling(acceleration, 1.0);
        self.hexapod.inverse_dynamics(&base, platform, &acceleration, &Wrench::zero())
    }

    fn leg_kinematics(&self, base: &BaseMotion, platform: &PlatformState) -> Result<LegKinematics, Error> {
        let still = BaseMotion { acceleration: Acceleration::zero(), ..*base };
        self.hexapod.leg_kinematics(&still, platform, &Acceleration::zero())
    }

    fn jacobian_determinant(&self, base: &BaseMotion, platform: &PlatformState) -> f64 {
        let mut jacobian = [[0.0; 6]; 6];
        self.hexapod.model.jacobian_dp(
            base.pose.position_m.as_ref(),
            &rows(&base.pose.rotation),
            platform.pose.position_m.as_ref(),
            &rows(&platform.pose.rotation),
            &mut jacobian,
        );
        // By columns, but a transpose has the same determinant.
        Matrix6::from(jacobian).determinant()
    }

    fn monitor(
        &self,
        base: &BaseMotion,
        platform: &PlatformState,
        actuator_force_n: &Vector6<f64>,
        limits: &Limits,
    ) -> Result<Monitor, Error> {
        self.hexapod.monitor(base, platform, actuator_force_n, limits)
    }
}

/// A linear and an angular part, as generated functions have them.
fn six(linear: &Vector3<f64>, angular: &Vector3<f64>) -> [f64; 6] {
    [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
}

/// The mechanism of a platform: the baked model where the numbers are those of the default platform, otherwise the
/// model that takes its parameters at run time. Beside it, which of the two.
///
/// # Panics
/// If its legs are of a type of which there is no generated model; scenarios with such a platform are refused.
pub fn of_platform(platform: &Platform, gravity_on: bool) -> (Box<dyn Mechanism>, &'static str) {
    let is_default = Platform::from_toml("platforms/uhp_2016.toml", DEFAULT_PLATFORM)
        .is_ok_and(|default| default.parameters == platform.parameters);
    let gravity = platform.parameters.gravity;
    let boxed = |model: Uhp| -> Box<dyn Mechanism> {
        if gravity_on {
            Box::new(Model::with_gravity(model))
        } else {
            Box::new(Model::without_gravity(model, gravity))
        }
    };
    match (is_default, gravity_on) {
        (true, true) => (Box::new(Model::with_gravity(Uhp2016)), "baked uhp_2016"),
        (true, false) => (Box::new(Model::without_gravity(Uhp2016, gravity)), "baked uhp_2016"),
        (false, _) => (boxed(run_time_model(platform)), "uhp with parameters at run time"),
    }
}

/// The run-time-parameter model with a platform's numbers.
pub fn run_time_model(platform: &Platform) -> Uhp {
    let parameters = Parameters::from_fn(|name, values| {
        let numbers = platform.parameter(name);
        values.copy_from_slice(&numbers.expect("platforms have every parameter of the models"));
    });
    Uhp { parameters }
}
