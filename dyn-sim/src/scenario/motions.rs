//! From the tables of a scenario to motions: harmonics, measured records, the free platform.

use std::ops::Range;
use std::path::Path;

use dyn_platform::{FileError, Platform, Refusal, read_text};
use dyn_runtime::nalgebra::{Vector3, Vector6};
use dyn_runtime::{PlatformState, Pose, Twist, rotation_vector};
use toml::Spanned;

use super::checks::{finite, positive};
use super::schema::{Body, Free, RawHarmonic, RelativeTo, Target};
use super::{Steering, csv};
use crate::excitation::Harmonic;
use crate::measured::Measured;
use crate::motion::{Angular, Motion};
use crate::rotation::from_rows;
use crate::simulate::Grid;

/// Harmonics of w' are turned into a rotation up to second order; beyond this sum of rotation amplitudes (rad) what is
/// left out, of third order, would exceed a millionth of the motion.
const LARGEST_SMALL_ROTATION: f64 = 1e-3;

/// A period has at least this many steps, or the integration means nothing.
const LEAST_STEPS_PER_PERIOD: f64 = 20.0;

/// What motions are read with.
pub(super) struct Reader<'a> {
    pub grid: Option<Grid>,
    pub folder: &'a Path,
    pub refusals: &'a mut Vec<Refusal>,
    pub notes: Vec<String>,
}

impl Reader<'_> {
    /// The base's motion about O's origin.
    pub fn base(&mut self, base: Option<&Spanned<Body>>) -> Result<Motion, FileError> {
        let mean = Pose::identity();
        match base {
            None => Ok(Motion::still(mean)),
            Some(body) => {
                let Body { csv, harmonic } = body.get_ref();
                self.motion("base", body.span(), csv.as_ref(), harmonic, mean)
            }
        }
    }

    /// The target's motion, about home.
    pub fn target(
        &mut self,
        target: &Spanned<Target>,
        platform: &Platform,
        base: &Motion,
    ) -> Result<Motion, FileError> {
        let Target { relative_to, position_m, csv, harmonic } = target.get_ref();
        let mut mean = home(platform);
        mean.position_m += self.vector("target.position_m", position_m.as_ref());
        let own = self.motion("target", target.span(), csv.as_ref(), harmonic, mean)?;
        Ok(match relative_to {
            RelativeTo::Inertial => own,
            RelativeTo::Base => Motion::Relative { carrier: Box::new(base.clone()), relative: Box::new(own) },
        })
    }

    /// The free platform's start and forces. It stands still relative to the base but for what is given.
    pub fn free(&mut self, free: &Free, platform: &Platform, base: &Motion) -> Steering {
        let start = base.at(0.0);
        let relative = home(platform);
        let turn = self.vector("free.rotation_rad", free.rotation_rad.as_ref());
        let pose = start.pose.compose(&Pose {
            position_m: relative.position_m + self.vector("free.position_m", free.position_m.as_ref()),
            rotation: rotation_vector::rotation(&turn) * relative.rotation,
        });
        let w = start.velocity.angular_rad_s;
        let arm = pose.position_m - start.pose.position_m;
        let turned = |v: Vector3<f64>| start.pose.rotation * v;
        let velocity = Twist {
            linear_m_s: start.velocity.linear_m_s
                + w.cross(&arm)
                + turned(self.vector("free.velocity_m_per_s", free.velocity_m_per_s.as_ref())),
            angular_rad_s: w + turned(
                self.vector("free.angular_velocity_rad_per_s", free.angular_velocity_rad_per_s.as_ref()),
            ),
        };
        let force = free.actuator_force_n.as_ref().map_or(Vector6::zeros(), |force| {
            Vector6::from_iterator(force.iter().map(|f| finite("free.actuator_force_n", f, self.refusals)))
        });
        Steering::Free(PlatformState { pose, velocity }, force)
    }

    fn motion(
        &mut self,
        table: &str,
        span: Range<usize>,
        csv: Option<&Spanned<String>>,
        harmonics: &[Spanned<RawHarmonic>],
        mean: Pose,
    ) -> Result<Motion, FileError> {
        match (csv, harmonics) {
            (Some(csv), []) => self.measured(table, csv, mean),
            (Some(csv), _) => {
                let what = format!("[{table}] has both a measured motion and harmonics");
                let help = format!("remove `csv`, or the [[{table}.harmonic]] tables");
                self.refusals.push(Refusal::new(csv.span(), "and [[harmonic]] as well", what, help));
                Ok(Motion::still(mean))
            }
            (None, _) => Ok(self.harmonic(table, span, harmonics, mean)),
        }
    }

    fn measured(&mut self, table: &str, csv: &Spanned<String>, mean: Pose) -> Result<Motion, FileError> {
        let path = self.folder.join(csv.get_ref());
        let help = "give its path, counted from the folder of the scenario file";
        let text = read_text(&path, "motion", help)?;
        let name = path.display().to_string();
        let record = csv::read(&text).map_err(|refusals| FileError::new(&name, text.as_str(), refusals))?;
        let duration = self.grid.map_or(0.0, |grid| grid.time(grid.steps));
        // Half a sample: times in the file are rounded.
        if duration > record.duration_s() + 0.5 * record.spacing_s {
            let what = format!(
                "the measured motion ends after {:.6} s, the scenario after {duration} s",
                record.duration_s()
            );
            self.refusals.push(Refusal::new(
                csv.span(),
                "too short",
                what,
                "shorten `duration_s`, or measure longer",
            ));
        }
        let measured = Measured::new(&record, mean);
        let bias = measured.bias();
        if bias.iter().any(|bias| *bias != 0.0) {
            let numbers: Vec<String> = bias.iter().map(|bias| format!("{bias:.3e}")).collect();
            self.notes.push(format!(
                "[{table}]: the means of {} were removed from its accelerations, m/s^2 and rad/s^2: [{}]",
                csv.get_ref(),
                numbers.join(", ")
            ));
        }
        Ok(Motion::Measured(Box::new(measured)))
    }

    fn harmonic(
        &mut self,
        table: &str,
        span: Range<usize>,
        harmonics: &[Spanned<RawHarmonic>],
        mean: Pose,
    ) -> Motion {
        let (mut linear, mut small, mut large) = (Vec::new(), Vec::new(), Vec::new());
        for spanned in harmonics {
            let raw = spanned.get_ref();
            let frequency_hz = self.frequency(&raw.frequency_hz);
            let phase = self.vector("linear_phase_rad", raw.linear_phase_rad.as_ref()).into();
            let by_acceleration = |amplitude: Vector3<f64>, phase| {
                Harmonic::from_acceleration(frequency_hz, amplitude.into(), phase)
            };
            let by_displacement = |amplitude: Vector3<f64>, phase_rad| Harmonic {
                frequency_hz,
                displacement: amplitude.into(),
                phase_rad,
            };
            match (&raw.linear_m_per_s2, &raw.linear_m) {
                (Some(a), None) => {
                    linear.push(by_acceleration(self.vector("linear_m_per_s2", Some(a)), phase))
                }
                (None, Some(x)) => linear.push(by_displacement(self.vector("linear_m", Some(x)), phase)),
                (None, None) => {}
                (Some(_), Some(x)) => self.twice(x[0].span(), "linear_m_per_s2", "linear_m"),
            }
            let phase = self.vector("angular_phase_rad", raw.angular_phase_rad.as_ref()).into();
            match (&raw.angular_rad_per_s2, &raw.rotation_rad) {
                (Some(a), None) => {
                    small.push(by_acceleration(self.vector("angular_rad_per_s2", Some(a)), phase));
                }
                (None, Some(phi)) => {
                    large.push(by_displacement(self.vector("rotation_rad", Some(phi)), phase))
                }
                (None, None) => {}
                (Some(_), Some(phi)) => self.twice(phi[0].span(), "angular_rad_per_s2", "rotation_rad"),
            }
        }
        let size: f64 = small.iter().map(|h: &Harmonic| Vector3::from(h.displacement).norm()).sum();
        if size > LARGEST_SMALL_ROTATION {
            let what = format!(
                "the angular accelerations of [{table}] turn it by up to {size:.3e} rad, and may turn it by \
                 {LARGEST_SMALL_ROTATION} rad: larger rotations do not follow from w' by harmonics"
            );
            let help =
                "give `rotation_rad`, amplitudes of the rotation vector, instead of `angular_rad_per_s2`";
            self.refusals.push(Refusal::new(span.clone(), "turns too far", what, help));
        }
        if !small.is_empty() && !large.is_empty() {
            let what = format!("[{table}] mixes `angular_rad_per_s2` and `rotation_rad`");
            let help = "give all its harmonics in one of the two ways";
            self.refusals.push(Refusal::new(span, "mixed", what, help));
        }
        let angular = if small.is_empty() { Angular::RotationVector(large) } else { Angular::Small(small) };
        Motion::Harmonic { mean, linear, angular }
    }

    fn twice(&mut self, at: Range<usize>, one: &str, other: &str) {
        let what = format!("a harmonic gives both `{one}` and `{other}`");
        self.refusals.push(Refusal::new(at, "given twice", what, format!("remove `{one}` or `{other}`")));
    }

    fn frequency(&mut self, frequency: &Spanned<f64>) -> f64 {
        let f = positive("frequency_hz", "frequency_hz = 40.0", frequency, self.refusals);
        if let Some(grid) = self.grid
            && f * grid.step_s * LEAST_STEPS_PER_PERIOD > 1.0
        {
            let what = format!("{f} Hz has {:.1} steps per period, too few", 1.0 / (f * grid.step_s));
            let help = format!("choose `step_s` of at most {:.2e}", 1.0 / (f * LEAST_STEPS_PER_PERIOD));
            self.refusals.push(Refusal::new(frequency.span(), "too fast for the step", what, help));
        }
        f
    }

    /// A vector; zero if absent.
    fn vector(&mut self, key: &str, vector: Option<&[Spanned<f64>; 3]>) -> Vector3<f64> {
        vector.map_or(Vector3::zeros(), |v| Vector3::from_fn(|i, _| finite(key, &v[i], self.refusals)))
    }
}

fn home(platform: &Platform) -> Pose {
    Pose { position_m: platform.home.position.into(), rotation: from_rows(&platform.home.rotation) }
}
