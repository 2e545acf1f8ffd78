//! The search of forward kinematics: Newton's method in plain arrays, compiled like functions in lanes for the processor's
//! registers.

use nalgebra::Rotation3;

use crate::blocks::{Blocks, combined, components, sum};
use crate::check;
use crate::error::Error;
use crate::float::{Scalar, mul_add, neg_mul_add, sqrt};
use crate::kernels;
use crate::real::Real;
use crate::triple::{Call, Portable, Triple};

/// Most Newton steps of one call.
const MAX_ITERATIONS: u32 = 30;
/// Most times that a step is halved.
const MAX_HALVINGS: u32 = 8;
/// Largest angle of one step, rad; larger ones are shortened.
const MAX_TURN_RAD: f64 = 0.5;

/// A rotation, row by row, as generated functions take it.
type Rows<T> = [[T; 3]; 3];

/// What a search needs, and where its result goes. Positions are seen from the base's origin, everything in axes of O.
pub(crate) struct Search<'a, M, T> {
    /// The generated functions.
    pub model: &'a M,
    /// B to O.
    pub base_rotation: &'a Rows<T>,
    /// Wanted, m.
    pub lengths: &'a [T; 6],
    /// The platform's position at the start, m.
    pub position: [T; 3],
    /// P to O at the start.
    pub rotation: &'a Rotation3<T>,
    /// The result.
    pub found: &'a mut Result<Found<T>, Error>,
}

/// A pose with the wanted lengths.
pub(crate) struct Found<T> {
    /// Of the platform, m.
    pub position: [T; 3],
    /// P to O.
    pub rotation: Rows<T>,
    /// Newton steps that led there.
    pub iterations: u32,
    /// Largest difference of lengths there, m.
    pub residual: T,
}

/// Actuators at a pose, seen from the lengths that are wanted.
struct Actuators<T> {
    jacobian_dp: [[T; 6]; 6],
    /// Wanted less present lengths, m.
    missing: [T; 6],
    /// Largest of them, m.
    residual: T,
}

/// A pose of the platform.
#[derive(Clone, Copy)]
struct Place<P> {
    /// m.
    position: P,
    /// P to O, row by row.
    rotation: [P; 3],
}

/// What the last step leaves to the next.
struct LastStep<P: Triple> {
    /// The Jacobian that it was made with, where it is one for blocks.
    blocks: Option<Blocks<P>>,
    /// Largest missing length before it, m; 0 before the first step.
    residual: P::Lane,
}

impl<M: kernels::ActuatorGeometry<T>, T: Real> Call<T> for Search<'_, M, T> {
    #[inline(always)]
    fn in_lanes<P: Triple<Lane = T>>(self) {
        *self.found = self.search::<P>();
    }

    #[inline]
    fn flat(self) {
        self.in_lanes::<Portable<T>>();
    }
}

impl<M: kernels::ActuatorGeometry<T>, T: Real> Search<'_, M, T> {
    #[inline(always)]
    fn search<P: Triple<Lane = T>>(&self) -> Result<Found<T>, Error> {
        let zero = T::zero();
        let r = self.rotation.matrix();
        let start = [
            P::triple([r.m11, r.m12, r.m13]),
            P::triple([r.m21, r.m22, r.m23]),
            P::triple([r.m31, r.m32, r.m33]),
        ];
        // Before any length is looked at, so that the residual is that of the pose which is returned.
        let rotation = orthonormalised(start);
        let mut place = Place { position: P::triple(self.position), rotation };
        let mut actuators = Actuators { jacobian_dp: [[zero; 6]; 6], missing: [zero; 6], residual: zero };
        self.actuators(&place, &mut actuators)?;
        let mut last = LastStep { blocks: None, residual: zero };
        let mut iterations = 0;
        while actuators.residual > T::LENGTH_RESIDUAL_M {
            if iterations == MAX_ITERATIONS {
                return Err(no_convergence(iterations, actuators.residual));
            }
            place = self.step(&place, &mut actuators, &mut last, iterations)?;
            iterations += 1;
        }
        let (position, rotation) = (components(place.position), rows(&place.rotation));
        Ok(Found { position, rotation, iterations, residual: actuators.residual })
    }

    /// Where one Newton step leads, halved until it leads to a better pose, with the actuators there.
    #[inline(always)]
    fn step<P: Triple<Lane = T>>(
        &self,
        from: &Place<P>,
        actuators: &mut Actuators<T>,
        last: &mut LastStep<P>,
        iterations: u32,
    ) -> Result<Place<P>, Error> {
        let residual = actuators.residual;
        // A step from r_0 to r_1 was wrong by r_1 = c r_0^2; with the same Jacobian the next is by 2 c r_0 r_1.
        let is_last = T::constant(4.0) * residual * residual < T::LENGTH_RESIDUAL_M * last.residual;
        if !is_last {
            last.blocks = Blocks::of(&actuators.jacobian_dp);
        }
        last.residual = residual;
        let (shift, turn) = match &last.blocks {
            Some(blocks) => blocks.solve(&actuators.missing),
            None => {
                let [x, y, z, wx, wy, wz] =
                    check::judged_with_care(&actuators.jacobian_dp, &actuators.missing)?;
                (P::triple([x, y, z]), P::triple([wx, wy, wz]))
            }
        };
        let turn_squared = sum(turn * turn);
        let most = T::constant(MAX_TURN_RAD);
        let mut share = if turn_squared > most * most { most / sqrt(turn_squared) } else { T::one() };
        for _ in 0..=MAX_HALVINGS {
            let part = P::splat(share);
            let position = mul_add(shift, part, from.position);
            let place = Place { position, rotation: turned_by(turn * part, &from.rotation) };
            // A leg that cannot reach a pose on the way is not to blame: the lengths lead there.
            if self.actuators(&place, actuators).is_ok() && actuators.residual < residual {
                return Ok(place);
            }
            share *= T::constant(0.5);
        }
        Err(no_convergence(iterations, residual))
    }

    /// The actuators at a pose.
    #[inline(always)]
    fn actuators<P: Triple<Lane = T>>(
        &self,
        place: &Place<P>,
        actuators: &mut Actuators<T>,
    ) -> Result<(), Error> {
        let (origin, position) = ([T::zero(); 3], components(place.position));
        let mut rod_alignment = [T::zero(); 6];
        self.model.actuator_geometry(
            &origin,
            self.base_rotation,
            &position,
            &rows(&place.rotation),
            &mut rod_alignment,
            &mut actuators.missing,
            &mut actuators.jacobian_dp,
        );
        check::in_reach(&rod_alignment, &origin, &position)?;
        let (mut largest, mut sum) = (T::zero(), T::zero());
        for (length, wanted) in actuators.missing.iter_mut().zip(self.lengths) {
            *length = *wanted - *length;
            let size = length.abs();
            largest = if size > largest { size } else { largest };
            sum += size;
        }
        actuators.residual = largest;
        // No comparison holds for what is not a number, but a sum is none then. In reach J_dp is finite; were it not, no step
        // would come of it.
        if sum.is_finite() { Ok(()) } else { Err(Error::NonFiniteResult) }
    }
}

#[cold]
fn no_convergence<T: Real>(iterations: u32, residual: T) -> Error {
    Error::NoConvergence { iterations, residual_m: residual.to_f64() }
}

#[inline(always)]
fn rows<P: Triple>(matrix: &[P; 3]) -> Rows<P::Lane> {
    [components(matrix[0]), components(matrix[1]), components(matrix[2])]
}

/// `rows`, turned by an angle (rad) about an axis through the origin: the Cayley transform, a rotation that agrees with the
/// exponential to third order, exactly orthonormal, without trigonometry.
#[inline(always)]
fn turned_by<P: Triple>(angle: P, rows: &[P; 3]) -> [P; 3] {
    let [x, y, z] = components(angle * P::constant(0.5));
    let (xx, yy, zz) = (x * x, y * y, z * z);
    // R + s (S + S^2) R with S = [x y z]x; the division has its time while the product is made.
    let s = P::splat(P::Lane::constant(2.0) / (P::Lane::constant(1.0) + xx + yy + zz));
    let first = combined([-(yy + zz), P::mul_sub(x, y, z), P::mul_add(x, z, y)], rows);
    let second = combined([P::mul_add(x, y, z), -(xx + zz), P::mul_sub(y, z, x)], rows);
    let third = combined([P::mul_sub(x, z, y), P::mul_add(y, z, x), -(xx + yy)], rows);
    [mul_add(s, first, rows[0]), mul_add(s, second, rows[1]), mul_add(s, third, rows[2])]
}

/// One step of Newton's method towards the nearest rotation: takes out what rounding of earlier calls, and a start that was
/// rounded itself, have put in, so that poses may be passed on from call to call for ever.
#[inline(always)]
fn orthonormalised<P: Triple>(rows: [P; 3]) -> [P; 3] {
    let ([a, b, c], [d, e, f], [g, h, i]) = (components(rows[0]), components(rows[1]), components(rows[2]));
    let (zero, most, half) = (P::Lane::constant(0.0), P::Lane::constant(1.5), P::constant(0.5));
    // 3/2 - R^T R/2
    let by = [
        neg_mul_add(half, combined([a, d, g], &rows), P::triple([most, zero, zero])),
        neg_mul_add(half, combined([b, e, h], &rows), P::triple([zero, most, zero])),
        neg_mul_add(half, combined([c, f, i], &rows), P::triple([zero, zero, most])),
    ];
    [combined([a, b, c], &by), combined([d, e, f], &by), combined([g, h, i], &by)]
}
