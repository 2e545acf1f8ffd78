//! Generated functions take any scalar: single precision, and numbers side by side.

use std::ops::{Add, Div, Mul, Neg, Sub};

use dyn_runtime::float::Scalar;
use dyn_runtime::models::{Parameters, Uhp2016, uhp, uhp_2016};
use dyn_runtime::nalgebra::{Matrix3, Vector3};
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, PlatformState, Pose, Real, Twist, Wrench, kernels,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Two numbers that are computed with at once, the way SIMD lanes are.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Pair([f64; 2]);

macro_rules! lane_by_lane {
    ($($operator:ident $function:ident)*) => {$(
        impl $operator for Pair {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Self([self.0[0].$function(other.0[0]), self.0[1].$function(other.0[1])])
            }
        }
    )*};
}
lane_by_lane! { Add add Sub sub Mul mul Div div }

impl Neg for Pair {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|lane| -lane))
    }
}

impl Scalar for Pair {
    fn constant(value: f64) -> Self {
        Self([value; 2])
    }

    fn square_root(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    fn multiply_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    fn solve_general<const N: usize>(matrix: &[[Self; N]; N], right_hand_side: &[Self; N]) -> [Self; N] {
        let [first, second] = [0, 1].map(|lane| {
            let matrix = matrix.map(|row| row.map(|element| element.0[lane]));
            f64::solve_general(&matrix, &right_hand_side.map(|element| element.0[lane]))
        });
        std::array::from_fn(|row| Self([first[row], second[row]]))
    }

    fn unless_wrong<const N: usize>(
        attempt: &[Self; N],
        residuals: &[Self; N],
        squares: &[Self; N],
        matrix: &[[Self; N]; N],
        right_hand_side: &[Self; N],
    ) -> [Self; N] {
        let [first, second] = [0, 1].map(|lane| {
            let [attempt, residuals, squares, right_hand_side] =
                [attempt, residuals, squares, right_hand_side].map(|numbers| numbers.map(|x| x.0[lane]));
            let matrix = matrix.map(|row| row.map(|x| x.0[lane]));
            f64::unless_wrong(&attempt, &residuals, &squares, &matrix, &right_hand_side)
        });
        std::array::from_fn(|row| Self([first[row], second[row]]))
    }
}

/// A base in motion and a platform near home above it.
struct Motion {
    base: BaseMotion,
    platform: PlatformState,
    acceleration: Acceleration,
    wrench: Wrench,
}

fn motion(random: &mut Pcg64) -> Motion {
    let mut vector = |size: f64| Vector3::from_fn(|_, _| random.random_range(-size..size));
    let mut pose = |position_m: f64, angle_rad: f64| {
        Pose::from_paper_angles(vector(position_m), vector(angle_rad).into())
    };
    let base = pose(0.5, 0.3);
    let mut relative = pose(0.01, 0.03);
    relative.position_m.z += 0.382;
    let mut twist = || Twist { linear_m_s: vector(1.0), angular_rad_s: vector(1.0) };
    let (base_velocity, velocity) = (twist(), twist());
    let mut acceleration = || Acceleration { linear_m_s2: vector(5.0), angular_rad_s2: vector(5.0) };
    let (base_acceleration, acceleration) = (acceleration(), acceleration());
    Motion {
        base: BaseMotion { pose: base, velocity: base_velocity, acceleration: base_acceleration },
        platform: PlatformState { pose: base.compose(&relative), velocity },
        acceleration,
        wrench: Wrench { force_n: vector(20.0), moment_n_m: vector(2.0) },
    }
}

fn rows(pose: &Pose) -> [[f64; 3]; 3] {
    pose.rotation.matrix().transpose().into()
}

/// The numbers of two motions side by side, in the order in which inverse dynamics takes them.
fn side_by_side<const N: usize>(motions: &[Motion; 2], numbers: impl Fn(&Motion) -> [f64; N]) -> [Pair; N] {
    let [first, second] = [numbers(&motions[0]), numbers(&motions[1])];
    std::array::from_fn(|k| Pair([first[k], second[k]]))
}

fn rows_side_by_side(motions: &[Motion; 2], pose: impl Fn(&Motion) -> Pose) -> [[Pair; 3]; 3] {
    let [first, second] = [rows(&pose(&motions[0])), rows(&pose(&motions[1]))];
    std::array::from_fn(|r| std::array::from_fn(|c| Pair([first[r][c], second[r][c]])))
}

/// Calls a generated function with `Pair` on two motions at once, and twice with `f64`: same bits.
#[test]
fn lanes_have_the_bits_of_single_numbers() {
    let mut random = Pcg64::seed_from_u64(1);
    let baked = Parameters::from_fn(fill);
    let paired = Parameters::from_fn(|name, slots: &mut [Pair]| {
        let mut numbers = vec![0.0; slots.len()];
        fill(name, &mut numbers);
        slots.iter_mut().zip(numbers).for_each(|(slot, number)| *slot = Pair([number; 2]));
    });
    for _ in 0..100 {
        let motions = [motion(&mut random), motion(&mut random)];
        let inputs = (
            side_by_side(&motions, |m| m.base.pose.position_m.into()),
            rows_side_by_side(&motions, |m| m.base.pose),
            side_by_side(&motions, |m| m.base.velocity.to_vector().into()),
            side_by_side(&motions, |m| m.base.acceleration.to_vector().into()),
            side_by_side(&motions, |m| m.platform.pose.position_m.into()),
            rows_side_by_side(&motions, |m| m.platform.pose),
            side_by_side(&motions, |m| m.platform.velocity.to_vector().into()),
            side_by_side(&motions, |m| m.acceleration.to_vector().into()),
            side_by_side(&motions, |m| m.wrench.to_vector().into()),
        );
        let (rb, b, vb, ab, rp, p, vp, ap, w) = &inputs;
        let mut in_pairs = [[Pair([0.0; 2]); 6]; 2];
        uhp_2016::inverse_dynamics(rb, b, vb, ab, rp, p, vp, ap, w, &mut in_pairs[0]);
        uhp::inverse_dynamics(&paired, rb, b, vb, ab, rp, p, vp, ap, w, &mut in_pairs[1]);
        for (lane, m) in motions.iter().enumerate() {
            let position = |pose: &Pose| <[f64; 3]>::from(pose.position_m);
            let (rb, b) = (position(&m.base.pose), rows(&m.base.pose));
            let (rp, p) = (position(&m.platform.pose), rows(&m.platform.pose));
            let vb: [f64; 6] = m.base.velocity.to_vector().into();
            let ab: [f64; 6] = m.base.acceleration.to_vector().into();
            let vp: [f64; 6] = m.platform.velocity.to_vector().into();
            let ap: [f64; 6] = m.acceleration.to_vector().into();
            let w: [f64; 6] = m.wrench.to_vector().into();
            let mut alone = [[0.0; 6]; 2];
            uhp_2016::inverse_dynamics(&rb, &b, &vb, &ab, &rp, &p, &vp, &ap, &w, &mut alone[0]);
            uhp::inverse_dynamics(&baked, &rb, &b, &vb, &ab, &rp, &p, &vp, &ap, &w, &mut alone[1]);
            assert_eq!(in_pairs.map(|forces| forces.map(|force| force.0[lane])), alone);
        }
    }
}

/// Numbers near those of the paper's platform.
fn fill(name: &str, slots: &mut [f64]) {
    let leg = |k: usize, at: f64| {
        let side = if k.is_multiple_of(2) { at } else { -at };
        (side + 120.0 * (k / 2) as f64).to_radians().sin_cos()
    };
    let vectors = |slots: &mut [f64], radius: f64, at: f64| {
        for (k, vector) in slots.chunks_mut(3).enumerate() {
            let (sin, cos) = leg(k, at);
            vector.copy_from_slice(&[radius * cos, radius * sin, 0.0]);
        }
    };
    match name {
        "base_point" => vectors(slots, 0.18, 43.0),
        "platform_point" => vectors(slots, 0.12, 15.0),
        "actuator_axis" => {
            slots.iter_mut().enumerate().for_each(|(k, x)| *x = f64::from(u8::from(k % 3 == 2)))
        }
        "payload_com" => slots.copy_from_slice(&[0.0, 0.0, 0.031]),
        "payload_inertia" => slots.copy_from_slice(&[0.025, 0.0, 0.0, 0.0, 0.025, 0.0, 0.0, 0.0, 0.035]),
        "gravity" => slots.copy_from_slice(&[0.0, 0.0, -9.81]),
        _ => slots.fill(match name {
            "rod_length" => 0.206,
            "rod_mass" => 1.024,
            "rod_inertia" => 1.024 * 0.206 * 0.206 / 12.0,
            "rod_com_fraction" => 0.5,
            "mover_mass" => 0.611,
            "mover_offset" => 0.05,
            "rest_length" => 0.198,
            "axial_stiffness" => 21_555.9,
            "axial_damping" => 0.0,
            "payload_mass" => 6.092,
            unknown => panic!("parameter `{unknown}`"),
        }),
    }
}

/// The same motion in single precision; the rotations are rounded.
fn rounded(m: &Motion) -> (BaseMotion<f32>, PlatformState<f32>, Acceleration<f32>, Wrench<f32>) {
    let vector = |v: Vector3<f64>| v.map(|x| x as f32);
    let pose = |pose: &Pose| {
        let matrix: Matrix3<f32> = pose.rotation.matrix().map(|x| x as f32);
        Pose::from_rotation_matrix(vector(pose.position_m), &matrix).expect("a rounded rotation passes")
    };
    let twist =
        |t: &Twist| Twist { linear_m_s: vector(t.linear_m_s), angular_rad_s: vector(t.angular_rad_s) };
    let acceleration = |a: &Acceleration| Acceleration {
        linear_m_s2: vector(a.linear_m_s2),
        angular_rad_s2: vector(a.angular_rad_s2),
    };
    (
        BaseMotion {
            pose: pose(&m.base.pose),
            velocity: twist(&m.base.velocity),
            acceleration: acceleration(&m.base.acceleration),
        },
        PlatformState { pose: pose(&m.platform.pose), velocity: twist(&m.platform.velocity) },
        acceleration(&m.acceleration),
        Wrench { force_n: vector(m.wrench.force_n), moment_n_m: vector(m.wrench.moment_n_m) },
    )
}

/// Rounding errors of 6e-8 in pose and forces, multiplied by springs (1e5 N/m in all) and by the conditioning.
#[test]
fn single_precision_agrees_with_double() {
    let (double, single) = (Hexapod::new(Uhp2016), Hexapod::single_precision(Uhp2016));
    let mut random = Pcg64::seed_from_u64(2);
    let mut worst = [0.0_f64; 2];
    for _ in 0..1000 {
        let m = motion(&mut random);
        let (base, platform, acceleration, wrench) = rounded(&m);
        let expected = double.inverse_dynamics(&m.base, &m.platform, &m.acceleration, &m.wrench).unwrap();
        let forces = single.inverse_dynamics(&base, &platform, &acceleration, &wrench).unwrap();
        let error = (forces.map(f64::from) - expected).amax() / expected.amax();
        worst[0] = worst[0].max(error);
        let expected = double.mass_matrix_p(&m.base, &m.platform).unwrap();
        let mass = single.mass_matrix_p(&base, &platform).unwrap();
        worst[1] = worst[1].max((mass.map(f64::from) - expected).amax() / expected.amax());
    }
    assert!(worst[0] < 1e-4 && worst[0] > 1e-8, "forces {:e}", worst[0]);
    assert!(worst[1] < 2e-6 && worst[1] > 1e-9, "masses {:e}", worst[1]);
}

/// Each type of number has its own thresholds.
#[test]
fn thresholds_belong_to_the_precision() {
    struct Aligned;
    impl<T: Real> kernels::RodAlignment<T> for Aligned {
        fn rod_alignment(
            &self,
            _: &[T; 3],
            _: &[[T; 3]; 3],
            _: &[T; 3],
            _: &[[T; 3]; 3],
            alignment: &mut [T; 6],
        ) {
            *alignment = [T::constant(1.0); 6];
            alignment[3] = T::constant(1e-3);
        }
    }
    impl<T: Real> kernels::JacobianDp<T> for Aligned {
        fn jacobian_dp(&self, _: &[T; 3], _: &[[T; 3]; 3], _: &[T; 3], _: &[[T; 3]; 3], _: &mut [[T; 6]; 6]) {
        }
    }
    fn at_rest<T: Real>() -> (BaseMotion<T>, PlatformState<T>) {
        (BaseMotion::at_rest(Pose::identity()), PlatformState::at_rest(Pose::identity()))
    }
    let (base, platform) = at_rest();
    assert!(Hexapod::new(Aligned).jacobian_dp(&base, &platform).is_ok());
    let (base, platform) = at_rest();
    let refused = Hexapod::single_precision(Aligned).jacobian_dp(&base, &platform);
    assert_eq!(refused, Err(Error::RodPerpendicular { leg: 3 }));

    let skewed = |by: f64| Matrix3::new(1.0, by, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    for (by, double, single) in [(5e-7, true, true), (5e-6, false, true), (5e-5, false, false)] {
        let matrix = skewed(by);
        assert_eq!(Pose::from_rotation_matrix(Vector3::zeros(), &matrix).is_ok(), double, "{by}");
        let matrix = matrix.map(|x| x as f32);
        assert_eq!(Pose::from_rotation_matrix(Vector3::zeros(), &matrix).is_ok(), single, "{by}");
    }
}
