//! The numbers of checked calls: double or single precision, with the thresholds that belong to each.

use nalgebra::RealField;

use crate::float::Scalar;
use crate::trigonometry;
use crate::triple::{self, Call};

/// The number type of [`Hexapod`](crate::Hexapod) and its states: `f64` or `f32`.
///
/// A threshold is where results lose their meaning. In single precision that is earlier, because fewer digits
/// can be lost.
pub trait Real: RealField + Scalar + Copy + Default + sealed::Sealed {
    /// Largest element of `|R^T R - 1|` that passes as a rotation.
    ///
    /// `f64`: 1e-6, ten times the rounding of single precision, so that a matrix measured or stored in f32
    /// passes. Results are wrong relatively by more than the matrix is, forces by an order of magnitude more: they hang on
    /// small differences, such as the springs' from their rest lengths. More is a matrix integrated without care, or
    /// not a rotation at all. `f32`: 1e-5, because the product itself is rounded to 4e-7 there, and a product of a few
    /// rotations to more.
    const MAX_ROTATION_DEVIATION: Self;

    /// Least `(u.a)^2` of a leg.
    ///
    /// `f64`: 1e-4, the rod within 0.57 degrees of perpendicular to its actuator. There the rod carries a
    /// hundred times the actuator's force, the actuator moves a hundred times as fast as the platform joint,
    /// and relative errors of the geometry grow ten thousand times, rounding errors to about 1e-12.
    /// Mechanisms stop long before; so this refuses nothing but numerical nonsense. `f32`: 1e-2, 5.7 degrees,
    /// where they grow a hundred times, rounding errors to about 1e-5.
    const MIN_ROD_ALIGNMENT: Self;

    /// Least reciprocal condition of J_dp for which forces are computed.
    ///
    /// `f64`: 1e-6. Below, an error of the pose of a millionth of the platform's size changes the forces by as
    /// much as they are, and of sixteen digits ten are left. `f32`: 1e-4; of seven digits three are left. The
    /// paper's platform at home stands far above both, by orders of magnitude:
    /// [`jacobian_reciprocal_condition`](crate::jacobian_reciprocal_condition) gives the number.
    const MIN_RECIPROCAL_CONDITION: Self;

    /// Platform and base farther apart than this along an axis of O are out of any leg's reach; far above it,
    /// the squares of distances are infinite.
    const OVERFLOWING_DISTANCE_M: Self;

    /// Largest difference of a length, m, that forward kinematics leaves: `f64` 1e-12, `f32` 5e-7; some units in the last
    /// place of the distances that lengths are made of. It is absolute: for platforms some ten times the
    /// paper's size (rods of 2 m) rounding in `f32` is larger, so that forward kinematics may end with
    /// [`Error::NoConvergence`](crate::Error::NoConvergence) at the pose itself.
    const LENGTH_RESIDUAL_M: Self;

    /// Least `|cos c2|` at which the paper's angles have rates, [`angles::angle_rates`](crate::angles::angle_rates).
    ///
    /// `f64`: 1e-6, `c2` farther than 1e-6 rad from `+-pi/2`; nearer, an error of the angles of 1e-6 rad changes
    /// the rates by as much as they are. `f32`: 1e-4, because the cosine itself is wrong by 1e-7 there.
    const MIN_COS_C2: Self;

    /// Largest `|cos c2|` at which [`angles::from_rotation`](crate::angles::from_rotation) takes the angles for
    /// locked, and `c3` for 0: a few units in the last place of 1.
    const LOCKED_COS_C2: Self;

    /// Sine and cosine of an angle in radians, in this order; NaN where it is not finite. Within 0.85 units in the last place,
    /// and the same bits on every host and in every build. Sine is exactly odd, cosine exactly even.
    fn sine_cosine(self) -> (Self, Self);

    /// [`sine_cosine`](Self::sine_cosine) of three angles: the same bits, on processors with AVX2 in one go.
    fn sine_cosines(angles: [Self; 3]) -> [(Self, Self); 3];

    /// Angle of the point (x, self) in radians, `-pi` to `pi`; 0 for 0 and x = 0; libm's on every host.
    fn arc_tangent(self, x: Self) -> Self;

    /// Makes a call in the registers that suit three of these numbers, if the processor has such: [`triple::run`].
    #[doc(hidden)]
    fn run<C: Call<Self>>(call: C);

    /// The same number in double precision, as errors report it.
    fn to_f64(self) -> f64;
}

mod sealed {
    /// Thresholds and tests exist for these types only.
    pub trait Sealed {}

    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

impl Real for f64 {
    const MAX_ROTATION_DEVIATION: Self = 1e-6;
    const MIN_ROD_ALIGNMENT: Self = 1e-4;
    const MIN_RECIPROCAL_CONDITION: Self = 1e-6;
    const OVERFLOWING_DISTANCE_M: Self = 1e100;
    const LENGTH_RESIDUAL_M: Self = 1e-12;
    const MIN_COS_C2: Self = 1e-6;
    const LOCKED_COS_C2: Self = 1e-15;

    #[inline]
    fn sine_cosine(self) -> (Self, Self) {
        trigonometry::of_one(self)
    }

    #[inline]
    fn sine_cosines(angles: [Self; 3]) -> [(Self, Self); 3] {
        trigonometry::of_three(&angles)
    }

    fn arc_tangent(self, x: Self) -> Self {
        libm::atan2(self, x)
    }

    #[inline(always)]
    fn run<C: Call<Self>>(call: C) {
        triple::run(call);
    }

    fn to_f64(self) -> f64 {
        self
    }
}

impl Real for f32 {
    const MAX_ROTATION_DEVIATION: Self = 1e-5;
    const MIN_ROD_ALIGNMENT: Self = 1e-2;
    const MIN_RECIPROCAL_CONDITION: Self = 1e-4;
    const OVERFLOWING_DISTANCE_M: Self = 1e12;
    const LENGTH_RESIDUAL_M: Self = 5e-7;
    const MIN_COS_C2: Self = 1e-4;
    const LOCKED_COS_C2: Self = 5e-7;

    #[inline]
    fn sine_cosine(self) -> (Self, Self) {
        trigonometry::of_one(self)
    }

    #[inline]
    fn sine_cosines(angles: [Self; 3]) -> [(Self, Self); 3] {
        trigonometry::of_three(&angles)
    }

    fn arc_tangent(self, x: Self) -> Self {
        libm::atan2f(self, x)
    }

    #[inline(always)]
    fn run<C: Call<Self>>(call: C) {
        call.flat();
    }

    fn to_f64(self) -> f64 {
        self.into()
    }
}
