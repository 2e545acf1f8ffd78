//! The search of forward kinematics: Newton's method in plain arrays, compiled like functions in lanes for the processor's
//! registers.

use crate::blocks::{Blocks, dot, product};
use crate::check;
use crate::error::Error;
use crate::float::{Scalar, sqrt};
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
    /// Of the platform, m, at the start.
    pub position: [T; 3],
    /// P to O, at the start.
    pub rotation: Rows<T>,
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

/// What the last step leaves to the next.
struct LastStep<T> {
    /// The Jacobian that it was made with, where it is one for blocks.
    blocks: Option<Blocks<T>>,
    /// Largest missing length before it, m; 0 before the first step.
    residual: T,
}

impl<M: kernels::ActuatorGeometry<T>, T: Real> Call<T> for Search<'_, M, T> {
    #[inline(always)]
    fn in_lanes<P: Triple<Lane = T>>(mut self) {
        *self.found = self.search::<P>();
    }

    #[inline]
    fn flat(self) {
        self.in_lanes::<Portable<T>>();
    }
}

impl<M: kernels::ActuatorGeometry<T>, T: Real> Search<'_, M, T> {
    #[inline(always)]
    fn search<P: Triple<Lane = T>>(&mut self) -> Result<Found<T>, Error> {
        let zero = T::zero();
        // Before any length is looked at, so that the residual is that of the pose which is returned.
        self.rotation = orthonormalised::<P>(&self.rotation);
        let mut actuators = Actuators { jacobian_dp: [[zero; 6]; 6], missing: [zero; 6], residual: zero };
        self.actuators(&mut actuators)?;
        let mut last = LastStep { blocks: None, residual: zero };
        let mut iterations = 0;
        while actuators.residual > T::LENGTH_RESIDUAL_M {
            if iterations == MAX_ITERATIONS {
                return Err(no_convergence(iterations, actuators.residual));
            }
            self.step::<P>(&mut actuators, &mut last, iterations)?;
            iterations += 1;
        }
        let (position, rotation) = (self.position, self.rotation);
        Ok(Found { position, rotation, iterations, residual: actuators.residual })
    }

    /// One Newton step, halved until it leads to a better pose, with the actuators there.
    #[inline(always)]
    fn step<P: Triple<Lane = T>>(
        &mut self,
        actuators: &mut Actuators<T>,
        last: &mut LastStep<T>,
        iterations: u32,
    ) -> Result<(), Error> {
        let (position, rotation, residual) = (self.position, self.rotation, actuators.residual);
        // A step from r_0 to r_1 was wrong by r_1 = c r_0^2; with the same Jacobian the next is by 2 c r_0 r_1.
        let is_last = T::constant(4.0) * residual * residual < T::LENGTH_RESIDUAL_M * last.residual;
        if !is_last {
            last.blocks = Blocks::of::<P>(&actuators.jacobian_dp);
        }
        last.residual = residual;
        let [x, y, z, wx, wy, wz] = match &last.blocks {
            Some(blocks) => blocks.solve::<P>(&actuators.missing),
            None => check::judged_with_care(&actuators.jacobian_dp, &actuators.missing)?,
        };
        let turn = [wx, wy, wz];
        let turn_squared = dot::<P>(&turn, &turn);
        let most = T::constant(MAX_TURN_RAD);
        let mut share = if turn_squared > most * most { most / sqrt(turn_squared) } else { T::one() };
        let mut refusal = None;
        for _ in 0..=MAX_HALVINGS {
            self.position = [
                P::mul_add(x, share, position[0]),
                P::mul_add(y, share, position[1]),
                P::mul_add(z, share, position[2]),
            ];
            self.rotation = turned_by::<P>(&[wx * share, wy * share, wz * share], &rotation);
            match self.actuators(actuators) {
                Ok(()) if actuators.residual < residual => return Ok(()),
                Ok(()) => refusal = None,
                Err(reason) => refusal = Some(reason),
            }
            share *= T::constant(0.5);
        }
        Err(refusal.unwrap_or(no_convergence(iterations, residual)))
    }

    /// The actuators at the present pose.
    #[inline(always)]
    fn actuators(&self, actuators: &mut Actuators<T>) -> Result<(), Error> {
        let origin = [T::zero(); 3];
        let mut rod_alignment = [T::zero(); 6];
        self.model.actuator_geometry(
            &origin,
            self.base_rotation,
            &self.position,
            &self.rotation,
            &mut rod_alignment,
            &mut actuators.missing,
            &mut actuators.jacobian_dp,
        );
        check::in_reach(&rod_alignment, &origin, &self.position)?;
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

/// `rows`, turned by an angle (rad) about an axis through the origin: the Cayley transform, a rotation that agrees with the
/// exponential to third order, exactly orthonormal, without trigonometry.
#[inline(always)]
fn turned_by<P: Triple>(angle: &[P::Lane; 3], rows: &Rows<P::Lane>) -> Rows<P::Lane> {
    let half = P::Lane::constant(0.5);
    let [x, y, z] = [angle[0] * half, angle[1] * half, angle[2] * half];
    let (xx, yy, zz) = (x * x, y * y, z * z);
    // R + s (S + S^2) R with S = [x y z]x; the division has its time while the product is made.
    let s = P::Lane::constant(2.0) / (P::Lane::constant(1.0) + xx + yy + zz);
    let by = product::<P>(
        &[
            [-(yy + zz), P::mul_sub(x, y, z), P::mul_add(x, z, y)],
            [P::mul_add(x, y, z), -(xx + zz), P::mul_sub(y, z, x)],
            [P::mul_sub(x, z, y), P::mul_add(y, z, x), -(xx + yy)],
        ],
        rows,
    );
    let row = |k: usize| {
        let ([a, b, c], [x, y, z]) = (rows[k], by[k]);
        [P::mul_add(s, x, a), P::mul_add(s, y, b), P::mul_add(s, z, c)]
    };
    [row(0), row(1), row(2)]
}

/// One step of Newton's method towards the nearest rotation: takes out what rounding of earlier calls, and a start that was
/// rounded itself, have put in, so that poses may be passed on from call to call for ever.
#[inline(always)]
fn orthonormalised<P: Triple>(rows: &Rows<P::Lane>) -> Rows<P::Lane> {
    let [[a, b, c], [d, e, f], [g, h, i]] = *rows;
    let (x, y, z) = ([a, d, g], [b, e, h], [c, f, i]);
    let (half, most) = (P::Lane::constant(0.5), P::Lane::constant(1.5));
    // 3/2 - R^T R/2, symmetric
    let on = |column: &[P::Lane; 3]| P::neg_mul_add(half, dot::<P>(column, column), most);
    let off = |one: &[P::Lane; 3], other: &[P::Lane; 3]| -half * dot::<P>(one, other);
    let (xy, yz, zx) = (off(&x, &y), off(&y, &z), off(&z, &x));
    product::<P>(rows, &[[on(&x), xy, zx], [xy, on(&y), yz], [zx, yz, on(&z)]])
}
