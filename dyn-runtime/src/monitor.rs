//! How far a state is from what actuators, joints and the layout allow.

use nalgebra::{Vector3, Vector6};

use crate::arrays::AllFinite;
use crate::check::{self, finite, finite_result};
use crate::error::{Error, Input};
use crate::float::{atan2, sqrt};
use crate::hexapod::{Hexapod, arrays};
use crate::kernels;
use crate::real::Real;
use crate::state::{BaseMotion, PlatformState};

/// A quantity with a limit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Quantity {
    /// d, m.
    ActuatorLength,
    /// d', m/s.
    ActuatorVelocity,
    /// F, N.
    ActuatorForce,
    /// Angle between rod and its direction at home, in base axes, rad.
    HookeJointAngle,
    /// Angle between rod and its direction at home, in platform axes, rad.
    PlatformJointAngle,
    /// [`jacobian_condition_bound`](crate::jacobian_condition_bound), a lower bound of the reciprocal condition, of all legs together.
    Conditioning,
}

/// What actuators and joints may do, the leg first. An infinite limit is none; [`none`](Self::none) has no other. A generated
/// model gives those of its platform file: [`Uhp2016::limits`](crate::models::Uhp2016::limits).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits<T = f64> {
    /// Shortest d, m.
    pub minimum_length_m: [T; 6],
    /// Longest d, m.
    pub maximum_length_m: [T; 6],
    /// Highest |d'|, m/s.
    pub maximum_velocity_m_s: [T; 6],
    /// Largest |F|, N.
    pub maximum_force_n: [T; 6],
    /// Largest angle between the rod and its direction at home, both in base axes, rad.
    pub maximum_hooke_joint_angle_rad: [T; 6],
    /// Largest angle between the rod and its direction at home, both in platform axes, rad.
    pub maximum_platform_joint_angle_rad: [T; 6],
    /// Direction of the rod at home, B, length 1. Counts where an angle at the Hooke joint is limited.
    pub home_direction_in_base: [[T; 3]; 6],
    /// Direction of the rod at home, P, length 1. Counts where an angle at the platform joint is limited.
    pub home_direction_in_platform: [[T; 3]; 6],
    /// Least [`jacobian_condition_bound`](crate::jacobian_condition_bound), without unit; negative infinity is none. The bound is
    /// several times smaller than the reciprocal condition, and that is below 1 even for J_dp of an ideal layout, so that usual
    /// demands on a condition number refuse every pose: look at the margin at home with a limit of 0, and choose well below it.
    pub minimum_condition_bound: T,
}

/// How far one quantity is from its limit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Margin<T = f64> {
    /// The quantity.
    pub quantity: Quantity,
    /// Index, 0 to 5, of the leg that is nearest to its limit (or farthest beyond); none for conditioning.
    pub leg: Option<usize>,
    /// Distance to the limit in the quantity's unit, negative beyond it, infinite without limit.
    pub margin: T,
}

/// The least margin of every quantity.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Monitor<T = f64> {
    /// One for each [`Quantity`], in that order.
    pub margins: [Margin<T>; 6],
}

impl Quantity {
    /// In words, and the unit with a space before it.
    pub(crate) fn name_and_unit(self) -> (&'static str, &'static str) {
        match self {
            Self::ActuatorLength => ("actuator length", " m"),
            Self::ActuatorVelocity => ("actuator velocity", " m/s"),
            Self::ActuatorForce => ("actuator force", " N"),
            Self::HookeJointAngle => ("angle at the Hooke joint", " rad"),
            Self::PlatformJointAngle => ("angle at the platform joint", " rad"),
            Self::Conditioning => ("conditioning of J_dp", ""),
        }
    }
}

impl<T: Real> Limits<T> {
    /// No limit at all, to be filled in.
    pub fn none() -> Self {
        let infinite = T::constant(f64::INFINITY);
        let upright = [[T::zero(), T::zero(), T::one()]; 6];
        Self {
            minimum_length_m: [-infinite; 6],
            maximum_length_m: [infinite; 6],
            maximum_velocity_m_s: [infinite; 6],
            maximum_force_n: [infinite; 6],
            maximum_hooke_joint_angle_rad: [infinite; 6],
            maximum_platform_joint_angle_rad: [infinite; 6],
            home_direction_in_base: upright,
            home_direction_in_platform: upright,
            minimum_condition_bound: -infinite,
        }
    }

    /// Every limit is a number or infinite, and every limited angle has a direction to be counted from.
    fn are_limits(&self) -> Result<(), Error> {
        let is_nan = |limit: &T| limit.partial_cmp(limit).is_none();
        let bounds = [
            (Quantity::ActuatorLength, &self.minimum_length_m),
            (Quantity::ActuatorLength, &self.maximum_length_m),
            (Quantity::ActuatorVelocity, &self.maximum_velocity_m_s),
            (Quantity::ActuatorForce, &self.maximum_force_n),
            (Quantity::HookeJointAngle, &self.maximum_hooke_joint_angle_rad),
            (Quantity::PlatformJointAngle, &self.maximum_platform_joint_angle_rad),
        ];
        for (quantity, limit) in bounds {
            if let Some(leg) = limit.iter().position(is_nan) {
                return Err(Error::InvalidLimit { quantity, leg: Some(leg) });
            }
        }
        if is_nan(&self.minimum_condition_bound) {
            return Err(Error::InvalidLimit { quantity: Quantity::Conditioning, leg: None });
        }
        let angles = [
            (Quantity::HookeJointAngle, &self.maximum_hooke_joint_angle_rad, &self.home_direction_in_base),
            (
                Quantity::PlatformJointAngle,
                &self.maximum_platform_joint_angle_rad,
                &self.home_direction_in_platform,
            ),
        ];
        for (quantity, limit, home) in angles {
            let is_lost = |(limit, direction): (&T, &[T; 3])| {
                let square = direction.iter().fold(T::zero(), |sum, x| sum + *x * *x);
                limit.is_finite() && !(square > T::zero() && square.is_finite())
            };
            if let Some(leg) = limit.iter().zip(home).position(is_lost) {
                return Err(Error::InvalidLimit { quantity, leg: Some(leg) });
            }
        }
        Ok(())
    }
}

impl<T: Real> Monitor<T> {
    /// Whether every quantity is within its limit. Margins that [`Hexapod::monitor`] gives are numbers or infinite.
    ///
    /// # Errors
    /// [`Error::BeyondLimit`] for the first quantity that is not, with its worst leg.
    pub fn check(&self) -> Result<(), Error> {
        // A margin that is not a number is not within anything.
        match self.margins.iter().find(|margin| !(T::zero()..).contains(&margin.margin)) {
            None => Ok(()),
            Some(&Margin { quantity, leg, margin }) => {
                Err(Error::BeyondLimit { quantity, leg, margin: margin.to_f64() })
            }
        }
    }
}

impl<M: kernels::RodAlignment<T>, T: Real> Hexapod<M, T> {
    /// Margins of stroke, rate, force, joint angles and conditioning. Depends on poses and velocities;
    /// `actuator_force_n` are the forces to be judged, N.
    ///
    /// A state beyond its limits is a valid answer here, whose [`Monitor::check`] is an error. `actuator_force_n` are best the forces
    /// that the coils give, [`Currents::actuator_force_n`](crate::current::Currents::actuator_force_n).
    ///
    /// # Errors
    /// See [`Hexapod`]; besides, [`Error::InvalidLimit`] for a limit that is NaN, and for an angle that is limited where its
    /// direction at home is 0 or not finite.
    ///
    /// ```
    /// use dyn_runtime::nalgebra::{Vector3, Vector6};
    /// use dyn_runtime::{BaseMotion, Error, Hexapod, Limits, PlatformState, Pose, Quantity, models::Uhp2016};
    ///
    /// let base = BaseMotion::at_rest(Pose::identity());
    /// let low = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.377), [0.0; 3]);
    /// let limits = Limits { minimum_length_m: [0.195; 6], maximum_force_n: [50.0; 6], ..Limits::none() };
    /// let monitor =
    ///     Hexapod::new(Uhp2016).monitor(&base, &PlatformState::at_rest(low), &Vector6::repeat(30.0), &limits)?;
    /// assert_eq!(monitor.margins[Quantity::ActuatorForce as usize].margin, 20.0);
    /// assert!(matches!(monitor.check(), Err(Error::BeyondLimit { quantity: Quantity::ActuatorLength, .. })));
    /// # Ok::<(), dyn_runtime::Error>(())
    /// ```
    pub fn monitor(
        &self,
        base: &BaseMotion<T>,
        platform: &PlatformState<T>,
        actuator_force_n: &Vector6<T>,
        limits: &Limits<T>,
    ) -> Result<Monitor<T>, Error>
    where
        M: kernels::LegKinematics<T> + kernels::JacobianDp<T>,
    {
        limits.are_limits()?;
        let forces: [T; 6] = finite(Input::ActuatorForce, (*actuator_force_n).into())?;
        let (b, p) = arrays(base, platform);
        self.check_states(&b, &p)?;
        let [mut lengths, mut velocities, mut accelerations] = [[T::zero(); 6]; 3];
        let [mut directions, mut hooke_joints, mut platform_joints, mut rates] = [[[T::zero(); 3]; 6]; 4];
        let mut jacobian_dp = [[T::zero(); 6]; 6];
        let rest = [T::zero(); 6];
        self.model.leg_kinematics(
            &b.position,
            &b.rotation,
            &b.velocity,
            &rest,
            &p.position,
            &p.rotation,
            &p.velocity,
            &rest,
            &mut lengths,
            &mut velocities,
            &mut accelerations,
            &mut directions,
            &mut hooke_joints,
            &mut platform_joints,
            &mut rates,
        );
        self.model.jacobian_dp(&b.position, &b.rotation, &p.position, &p.rotation, &mut jacobian_dp);
        finite_result(
            [lengths, velocities].all_finite() & directions.all_finite() & jacobian_dp.all_finite(),
        )?;
        let (to_base, to_platform) = (base.pose.rotation.transpose(), platform.pose.rotation.transpose());
        let at_base = |leg: usize| to_base * Vector3::from(directions[leg]);
        let at_platform = |leg: usize| to_platform * Vector3::from(directions[leg]);

        let stroke = |leg: usize| {
            (lengths[leg] - limits.minimum_length_m[leg]).min(limits.maximum_length_m[leg] - lengths[leg])
        };
        let least = |quantity, margin: &dyn Fn(usize) -> T| {
            let mut worst = Margin { quantity, leg: Some(0), margin: margin(0) };
            for leg in 1..6 {
                let margin = margin(leg);
                if margin < worst.margin {
                    worst = Margin { quantity, leg: Some(leg), margin };
                }
            }
            worst
        };
        let angle = |limit: &[T; 6], leg: usize, home: &[[T; 3]; 6], now: Vector3<T>| {
            // Without limit the home direction may be anything.
            if limit[leg].is_finite() {
                limit[leg] - angle_between(&Vector3::from(home[leg]), &now)
            } else {
                limit[leg]
            }
        };
        let bound = check::jacobian_condition_bound(&jacobian_dp);
        // Of a singular J_dp the bound may be no number; it holds nothing then.
        let bound = if bound.is_finite() { bound } else { T::zero() };
        let conditioning = bound - limits.minimum_condition_bound;
        Ok(Monitor {
            margins: [
                least(Quantity::ActuatorLength, &stroke),
                least(Quantity::ActuatorVelocity, &|leg| {
                    limits.maximum_velocity_m_s[leg] - velocities[leg].abs()
                }),
                least(Quantity::ActuatorForce, &|leg| limits.maximum_force_n[leg] - forces[leg].abs()),
                least(Quantity::HookeJointAngle, &|leg| {
                    angle(
                        &limits.maximum_hooke_joint_angle_rad,
                        leg,
                        &limits.home_direction_in_base,
                        at_base(leg),
                    )
                }),
                least(Quantity::PlatformJointAngle, &|leg| {
                    let home = &limits.home_direction_in_platform;
                    angle(&limits.maximum_platform_joint_angle_rad, leg, home, at_platform(leg))
                }),
                Margin { quantity: Quantity::Conditioning, leg: None, margin: conditioning },
            ],
        })
    }
}

/// Angle between two directions, rad, exact to rounding for small ones too.
fn angle_between<T: Real>(one: &Vector3<T>, other: &Vector3<T>) -> T {
    let across = one.cross(other);
    atan2(sqrt(across.dot(&across)), one.dot(other))
}
