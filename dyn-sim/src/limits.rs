//! The limits of a platform file that a simulated motion exceeds without being stopped by it: force, rate, joint angles.
//! (Lengths stop a motion, see [`crate::stop`].)

use dyn_platform::{Limit, Platform};
use dyn_runtime::{BaseMotion, Error, Limits, Monitor, PlatformState, Pose, Quantity};

use crate::mechanism::Mechanism;
use crate::outcome::Series;
use crate::rotation::from_rows;
use crate::simulate::Drive;

/// A quantity as a warning tells of it.
struct Told {
    quantity: Quantity,
    /// "leg 3 ..."
    does: &'static str,
    unit: &'static str,
    /// Its limits in the platform file.
    limit: fn(&Platform) -> Limit,
    /// The key there.
    key: &'static str,
}

const TOLD: [Told; 4] = [
    Told {
        quantity: Quantity::ActuatorForce,
        does: "needs",
        unit: "N",
        limit: |platform| platform.limits.maximum_force,
        key: "maximum_force_n",
    },
    Told {
        quantity: Quantity::ActuatorVelocity,
        does: "moves at",
        unit: "m/s",
        limit: |platform| platform.limits.maximum_velocity,
        key: "maximum_velocity_m_per_s",
    },
    Told {
        quantity: Quantity::HookeJointAngle,
        does: "turns its Hooke joint by",
        unit: "rad",
        limit: |platform| platform.limits.maximum_hooke_joint_angle,
        key: "maximum_hooke_joint_angle_rad",
    },
    Told {
        quantity: Quantity::PlatformJointAngle,
        does: "turns its joint on the platform by",
        unit: "rad",
        limit: |platform| platform.limits.maximum_platform_joint_angle,
        key: "maximum_platform_joint_angle_rad",
    },
];

/// One sentence for each kind of limit that the simulated motion exceeds: when for the first time, and the worst of it.
pub fn exceeded(
    platform: &Platform,
    mechanism: &dyn Mechanism,
    drive: &Drive,
    series: &Series,
) -> Vec<String> {
    let limited: Vec<&Told> =
        TOLD.iter().filter(|told| (told.limit)(platform).iter().any(Option::is_some)).collect();
    if limited.is_empty() {
        return Vec::new();
    }
    // Every sample, and home, is within reach, or there would be no such platform or the motion had stopped before.
    let Ok(limits) = of_platform(platform, mechanism) else { return Vec::new() };
    let monitors: Vec<(f64, Monitor)> = (0..series.len())
        .filter_map(|k| {
            let (base, force) = (drive.base.get(2 * k)?, drive.actuator_force_n.get(2 * k)?);
            let monitor = mechanism.monitor(base, &series.state(k), force, &limits).ok()?;
            Some((series.time_s[k], monitor))
        })
        .collect();
    limited.into_iter().filter_map(|told| told.sentence(platform, &monitors)).collect()
}

impl Told {
    fn sentence(&self, platform: &Platform, monitors: &[(f64, Monitor)]) -> Option<String> {
        let margins = monitors.iter().map(|(time, monitor)| (*time, monitor.margins[self.quantity as usize]));
        let beyond: Vec<_> = margins.filter(|(_, margin)| margin.margin < 0.0).collect();
        let (first, _) = beyond.first()?;
        let (time, worst) = beyond.iter().min_by(|(_, a), (_, b)| a.margin.total_cmp(&b.margin))?;
        let leg = worst.leg?;
        let limit = (self.limit)(platform)[leg]?;
        let (Self { does, unit, key, .. }, value) = (self, limit - worst.margin);
        Some(format!(
            "leg {} (index {leg}) {does} {value:.4} {unit} at {time:.6} s, beyond its limit of {limit} {unit} (`{key}`); a \
             limit of this kind is exceeded from {first:.6} s on",
            leg + 1
        ))
    }
}

/// The platform file's limits, but for those of lengths.
///
/// # Errors
/// A home pose that the legs do not reach.
pub fn of_platform(platform: &Platform, mechanism: &dyn Mechanism) -> Result<Limits, Error> {
    let home =
        Pose { position_m: platform.home.position.into(), rotation: from_rows(&platform.home.rotation) };
    let base = BaseMotion::at_rest(Pose::identity());
    let at_home = mechanism.leg_kinematics(&base, &PlatformState::at_rest(home))?;
    let to_platform = home.rotation.inverse();
    let given = |limit: Limit| limit.map(|value| value.unwrap_or(f64::INFINITY));
    let file = &platform.limits;
    Ok(Limits {
        maximum_velocity_m_s: given(file.maximum_velocity),
        maximum_force_n: given(file.maximum_force),
        maximum_hooke_joint_angle_rad: given(file.maximum_hooke_joint_angle),
        maximum_platform_joint_angle_rad: given(file.maximum_platform_joint_angle),
        home_direction_in_base: at_home.rod_direction.map(Into::into),
        home_direction_in_platform: at_home.rod_direction.map(|u| (to_platform * u).into()),
        ..Limits::none()
    })
}
