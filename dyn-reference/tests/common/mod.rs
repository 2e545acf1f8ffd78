//! Platforms, random states, exact rigid motions, finite differences and comparisons shared by the tests.

#![allow(dead_code, reason = "each test binary uses its own part")]

use std::array::from_fn;
use std::f64::consts::PI;

use dyn_reference::{LegType, Parameters, Payload, RigidBodyMotion, State, rod_alignment, uhp, ups};
use nalgebra::{Matrix3, Rotation3, SMatrix, Vector3, Vector6};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// A platform with its home pose relative to the base.
pub struct Case<L = uhp::Leg> {
    pub name: &'static str,
    pub parameters: Parameters<L>,
    pub home_position: Vector3<f64>,
    pub home_rotation: Matrix3<f64>,
}

/// Table 1 of the paper. What the table leaves open (inertia, mover offset, rod inertia) is chosen here.
pub fn table_1() -> Case {
    let point = |radius: f64, degrees: f64| {
        let angle = degrees * PI / 180.0;
        Vector3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    let (rod_mass_kg, rod_length_m) = (1.024, 0.206);
    let legs = from_fn(|i| {
        let centre = 120.0 * (i / 2) as f64;
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        uhp::Leg {
            base_point_m: point(0.180, centre + side * 43.0),
            actuator_axis: Vector3::z(),
            platform_point_m: point(0.120, centre + side * 15.0),
            rod_length_m,
            rod_mass_kg,
            rod_inertia_kg_m2: rod_mass_kg * rod_length_m * rod_length_m / 12.0,
            rod_com_fraction: 0.5,
            mover_mass_kg: 0.611,
            mover_offset_m: 0.05,
            rest_length_m: 0.198,
            axial_stiffness_n_m: 21_555.9,
            axial_damping_n_s_m: 0.0,
        }
    });
    let payload = Payload {
        mass_kg: 6.092,
        com_m: Vector3::new(0.0, 0.0, 0.031),
        inertia_kg_m2: Matrix3::from_diagonal(&Vector3::new(0.025, 0.025, 0.035)),
    };
    Case {
        name: "table 1",
        parameters: Parameters { legs, payload, gravity_m_s2: Vector3::new(0.0, 0.0, -9.81) },
        home_position: Vector3::new(0.0, 0.0, 0.382),
        home_rotation: Matrix3::identity(),
    }
}

/// A platform without any symmetry, in which no parameter has a value that could hide a term.
pub fn ugly() -> Case {
    let mut case = table_1();
    let tilts = [[0.11, -0.07], [-0.05, 0.13], [0.09, 0.10], [-0.12, -0.03], [0.04, -0.14], [-0.08, 0.06]];
    for (i, leg) in case.parameters.legs.iter_mut().enumerate() {
        let x = i as f64;
        leg.base_point_m +=
            Vector3::new(0.013 * (1.0 + x).sin(), -0.011 * (2.0 * x).cos(), 0.017 * (3.0 * x).sin());
        leg.platform_point_m +=
            Vector3::new(0.009 * (5.0 * x).cos(), 0.012 * (4.0 * x + 1.0).sin(), 0.014 * (x + 2.0).cos());
        leg.actuator_axis = Vector3::new(tilts[i][0], tilts[i][1], 1.0).normalize();
        leg.rod_length_m *= 1.0 + 0.03 * x;
        leg.rod_mass_kg = 0.4 + 0.25 * x;
        leg.rod_com_fraction = 0.2 + 0.11 * x;
        leg.rod_inertia_kg_m2 = 0.002 + 0.001 * x;
        leg.mover_mass_kg = 0.9 - 0.12 * x;
        leg.mover_offset_m = -0.03 + 0.025 * x;
        leg.rest_length_m = 0.15 + 0.012 * x;
        leg.axial_stiffness_n_m = 9_000.0 + 3_500.0 * x;
        leg.axial_damping_n_s_m = 20.0 + 13.0 * x;
    }
    case.parameters.payload = Payload {
        mass_kg: 4.3,
        com_m: Vector3::new(0.041, -0.027, 0.063),
        inertia_kg_m2: Matrix3::new(0.031, 0.004, -0.006, 0.004, 0.022, 0.005, -0.006, 0.005, 0.041),
    };
    case.parameters.gravity_m_s2 = Vector3::new(2.1, -3.7, -8.4);
    case.name = "ugly";
    case.home_rotation = Rotation3::new(Vector3::new(0.06, -0.04, 0.1)).into_inner();
    case
}

/// Legs of the paper.
pub fn uhp_cases() -> [Case; 2] {
    [table_1(), ugly()]
}

/// Gough-Stewart legs between the same joints: alike, and all different, with centres of mass beyond the leg's ends.
pub fn ups_cases() -> [Case<ups::Leg>; 2] {
    [(table_1(), "gough", 0.0), (ugly(), "ugly gough", 1.0)].map(|(case, name, spread)| {
        let legs = from_fn(|i| {
            let (leg, x) = (&case.parameters.legs[i], spread * i as f64);
            ups::Leg {
                base_point_m: leg.base_point_m,
                platform_point_m: leg.platform_point_m,
                lower_mass_kg: 1.3 + 0.2 * x,
                lower_com_distance_m: 0.11 - 0.04 * x,
                lower_inertia_kg_m2: 0.006 + 0.002 * x,
                upper_mass_kg: 0.7 + 0.13 * x,
                upper_com_distance_m: 0.15 + 0.06 * x,
                upper_inertia_kg_m2: 0.004 + 0.001 * x,
                rest_length_m: 0.39 + 0.01 * x,
                axial_stiffness_n_m: leg.axial_stiffness_n_m,
                axial_damping_n_s_m: leg.axial_damping_n_s_m,
            }
        });
        let Parameters { payload, gravity_m_s2, .. } = case.parameters;
        Case {
            name,
            parameters: Parameters { legs, payload, gravity_m_s2 },
            home_position: case.home_position,
            home_rotation: case.home_rotation,
        }
    })
}

pub fn random(seed: u64) -> Pcg64 {
    Pcg64::seed_from_u64(seed)
}

pub fn vector<const N: usize>(random: &mut Pcg64, bound: f64) -> SMatrix<f64, N, 1> {
    SMatrix::from_fn(|_, _| random.random_range(-bound..bound))
}

/// A base turned by about 1 rad in any direction, the platform anywhere the legs reach without coming close
/// to singular, both with velocities of several m/s and rad/s independent of each other, accelerations and
/// forces to match.
pub fn random_state<L: LegType>(case: &Case<L>, random: &mut Pcg64) -> State {
    loop {
        let base_rotation = Rotation3::new(vector(random, 1.2)).into_inner();
        let base_position = vector(random, 1.0);
        let relative = Rotation3::new(vector(random, 0.25)).into_inner();
        let place = case.home_position + vector::<3>(random, 0.03);
        let mut state = State {
            base: RigidBodyMotion::at_rest(base_position, base_rotation),
            platform: RigidBodyMotion::at_rest(
                base_position + base_rotation * place,
                base_rotation * relative * case.home_rotation,
            ),
            actuator_force_n: vector(random, 200.0),
            external_wrench: vector(random, 50.0),
            reference_velocity: SMatrix::zeros(),
        };
        for body in [&mut state.base, &mut state.platform] {
            body.velocity = vector(random, 3.0);
            body.acceleration = vector(random, 20.0);
        }
        if rod_alignment(&case.parameters, &state).min() > 0.2 {
            return state;
        }
    }
}

/// Runs `check` on `count` random states of each platform.
pub fn random_states<L: LegType>(
    seed: u64,
    count: usize,
    cases: [Case<L>; 2],
    mut check: impl FnMut(&Case<L>, &State),
) {
    for case in cases {
        let mut random = random(seed);
        for _ in 0..count {
            let state = random_state(&case, &mut random);
            check(&case, &state);
        }
    }
}

/// [`random_states`] of the platforms of every leg type. A macro, because one closure has one type of leg.
macro_rules! for_random_states {
    ($seed:expr, $count:expr, $check:expr $(,)?) => {{
        $crate::common::random_states($seed, $count, $crate::common::uhp_cases(), $check);
        $crate::common::random_states($seed, $count, $crate::common::ups_cases(), $check);
    }};
}

/// The body `time` seconds later on a smooth motion through `now` with its velocity and acceleration.
///
/// The origin moves with constant acceleration. The rotation is a product of three exponentials about fixed
/// axes, `R = exp(q1 e1) exp(q2 e2) exp(q3 e3) R_0` with quadratic `q(t)`, so that `R`, `w` and `w'` are
/// exact at every time; the initial `q'` and `q''` are those that give the required `w` and `w'`.
pub fn moved(now: &RigidBodyMotion, time: f64) -> RigidBodyMotion {
    let axis: [Vector3<f64>; 3] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let rate = now.angular_velocity();
    let carried = |turns: [Matrix3<f64>; 2], rate: &Vector3<f64>, second: &Vector3<f64>| {
        let parts = [
            (axis[0], rate[0], second[0]),
            (turns[0] * axis[1], rate[1], second[1]),
            (turns[0] * turns[1] * axis[2], rate[2], second[2]),
        ];
        let (mut w, mut w_rate) = (Vector3::zeros(), Vector3::zeros());
        for (direction, rate, second) in parts {
            // The direction is carried along by the rotations before it, whose angular velocity is w so far.
            w_rate += second * direction + rate * w.cross(&direction);
            w += rate * direction;
        }
        (w, w_rate)
    };
    let identity = Matrix3::identity();
    let (_, unaccelerated) = carried([identity, identity], &rate, &Vector3::zeros());
    let second = now.angular_acceleration() - unaccelerated;

    let angle = rate * time + second * (0.5 * time * time);
    let turn = |i: usize| Rotation3::new(axis[i] * angle[i]).into_inner();
    let (w, w_rate) = carried([turn(0), turn(1)], &(rate + second * time), &second);

    let acceleration = now.linear_acceleration();
    RigidBodyMotion {
        position_m: now.position_m + now.linear_velocity() * time + acceleration * (0.5 * time * time),
        rotation: turn(0) * turn(1) * turn(2) * now.rotation,
        velocity: twist(&(now.linear_velocity() + acceleration * time), &w),
        acceleration: twist(&acceleration, &w_rate),
    }
}

/// Base and platform `time` seconds later, forces unchanged.
pub fn moved_state(now: &State, time: f64) -> State {
    State { base: moved(&now.base, time), platform: moved(&now.platform, time), ..*now }
}

/// The body displaced by `step` times the unit twist `direction`, at unchanged velocity and acceleration.
pub fn displaced(body: &RigidBodyMotion, direction: usize, step: f64) -> RigidBodyMotion {
    let mut result = *body;
    if direction < 3 {
        result.position_m[direction] += step;
    } else {
        let mut turn = Vector3::zeros();
        turn[direction - 3] = step;
        result.rotation = Rotation3::new(turn).into_inner() * body.rotation;
    }
    result
}

pub fn twist(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

pub fn unit(i: usize) -> Vector6<f64> {
    Vector6::ith(i, 1.0)
}

/// Step of time derivatives, s.
///
/// The nearest singularity of a motion is where a leg loses reach: `random_state` leaves about 0.04 m, 7 ms
/// at 6 m/s. The sixth-order stencil truncates at 36 (h / 7 ms)^6 = 5e-12 and rounds at 4e-16 m / h = 1e-11
/// m/s.
pub const TIME_STEP: f64 = 5e-5;

/// Step of derivatives by pose, m and rad: truncation 36 (h / 0.04 m)^6 = 2e-12, rounding 4e-16 m / h =
/// 2e-12.
pub const POSE_STEP: f64 = 2.5e-4;

/// Relative tolerance of derivatives by [`TIME_STEP`] or [`POSE_STEP`]: ten times their truncation and
/// rounding.
pub const DIFFERENCES: f64 = 1e-10;

/// First derivative at zero by sixth-order central differences.
pub fn derivative<const R: usize, const C: usize>(
    step: f64,
    function: impl Fn(f64) -> SMatrix<f64, R, C>,
) -> SMatrix<f64, R, C> {
    let difference = |n: f64| function(n * step) - function(-n * step);
    (difference(1.0) * 0.75 - difference(2.0) * 0.15 + difference(3.0) * (1.0 / 60.0)) / step
}

/// Compares and remembers the worst relative error. Run with `--nocapture` to see it.
pub struct Worst {
    what: &'static str,
    error: f64,
}

impl Worst {
    pub fn new(what: &'static str) -> Self {
        Self { what, error: 0.0 }
    }

    /// Error of `found` against `expected` in the Frobenius norm, relative to `scale`.
    pub fn compare<const R: usize, const C: usize>(
        &mut self,
        found: &SMatrix<f64, R, C>,
        expected: &SMatrix<f64, R, C>,
        scale: f64,
    ) {
        self.scalar((found - expected).norm(), 0.0, scale);
    }

    pub fn scalar(&mut self, found: f64, expected: f64, scale: f64) {
        let error = (found - expected).abs() / scale;
        // A NaN must not pass for a small error.
        self.error = if error.is_nan() { f64::INFINITY } else { self.error.max(error) };
    }

    pub fn within(self, tolerance: f64) {
        let Self { what, error } = self;
        println!("{what}: worst error {error:.1e}, tolerance {tolerance:.0e}");
        assert!(error <= tolerance, "{what}: worst error {error:.3e} exceeds {tolerance:.1e}");
    }
}
