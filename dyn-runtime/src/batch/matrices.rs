//! The matrices of a batch.

use super::models::Models;
use super::states::{finite, reached, settle};
use super::{ColumnMut, LengthError, States, Status};
use crate::kernels::{RodAlignment, generic};
use crate::lanes::{InLanes, Kernel, Lanes, Number};

/// Where the matrices of many states go; 36 numbers each, row by row. See [`Matrices`](crate::Matrices).
#[derive(Debug)]
pub struct MatricesMut<'a, S> {
    /// M_p.
    pub mass_matrix_p: ColumnMut<'a, S, 36>,
    /// C_p.
    pub coriolis_matrix_p: ColumnMut<'a, S, 36>,
    /// J_dp.
    pub jacobian_dp: ColumnMut<'a, S, 36>,
    /// M_b.
    pub mass_matrix_b: ColumnMut<'a, S, 36>,
    /// C_b.
    pub coriolis_matrix_b: ColumnMut<'a, S, 36>,
    /// J_db.
    pub jacobian_db: ColumnMut<'a, S, 36>,
}

impl<S: Number> MatricesMut<'_, S> {
    pub(super) fn check(&self, states: usize) -> Result<(), LengthError> {
        self.mass_matrix_p.check("mass_matrix_p", states)?;
        self.coriolis_matrix_p.check("coriolis_matrix_p", states)?;
        self.jacobian_dp.check("jacobian_dp", states)?;
        self.mass_matrix_b.check("mass_matrix_b", states)?;
        self.coriolis_matrix_b.check("coriolis_matrix_b", states)?;
        self.jacobian_db.check("jacobian_db", states)
    }

    #[cfg(feature = "rayon")]
    fn split(self, state: usize) -> (Self, Self) {
        let Self {
            mass_matrix_p,
            coriolis_matrix_p,
            jacobian_dp,
            mass_matrix_b,
            coriolis_matrix_b,
            jacobian_db,
        } = self;
        let columns =
            [mass_matrix_p, coriolis_matrix_p, jacobian_dp, mass_matrix_b, coriolis_matrix_b, jacobian_db];
        let [a, b, c, d, e, f] = columns.map(|column| column.split(state));
        ([a.0, b.0, c.0, d.0, e.0, f.0].into(), [a.1, b.1, c.1, d.1, e.1, f.1].into())
    }
}

/// M_p, C_p, J_dp, M_b, C_b, J_db, in this order.
impl<'a, S> From<[ColumnMut<'a, S, 36>; 6]> for MatricesMut<'a, S> {
    fn from(columns: [ColumnMut<'a, S, 36>; 6]) -> Self {
        let [mass_matrix_p, coriolis_matrix_p, jacobian_dp, mass_matrix_b, coriolis_matrix_b, jacobian_db] =
            columns;
        Self { mass_matrix_p, coriolis_matrix_p, jacobian_dp, mass_matrix_b, coriolis_matrix_b, jacobian_db }
    }
}

pub(super) struct Matrices<'a, M, S> {
    pub models: Models<'a, M>,
    pub states: States<'a, S>,
    pub matrices: MatricesMut<'a, S>,
    pub status: &'a mut [Status],
    /// Index of the first state in the inputs.
    pub offset: usize,
}

impl<M, S: Number> Kernel<S> for Matrices<'_, M, S>
where
    M: InLanes<S> + RodAlignment<S> + generic::RodAlignment + generic::Matrices,
{
    type Output = ();

    #[inline(always)]
    fn run<T: Lanes<Number = S>>(self) {
        let Self { models, states, mut matrices, status, offset } = self;
        if status.is_empty() {
            return;
        }
        let mut parameters = models.load::<S, T>(offset);
        for first in (0..status.len()).step_by(T::COUNT) {
            let input = offset + first;
            models.reload::<S, T>(input, &mut parameters);
            let (base, platform) = states.load::<T>(input);
            let [mut mass_p, mut coriolis_p, mut jacobian_p, mut mass_b, mut coriolis_b, mut jacobian_b] =
                [[[T::constant(0.0); 6]; 6]; 6];
            <M as generic::Matrices>::matrices(
                &parameters,
                &base.position,
                &base.rotation,
                &base.velocity,
                &platform.position,
                &platform.rotation,
                &platform.velocity,
                &mut mass_p,
                &mut coriolis_p,
                &mut jacobian_p,
                &mut mass_b,
                &mut coriolis_b,
                &mut jacobian_b,
            );
            let reached = reached::<M, T>(&parameters, &base, &platform);
            // Every matrix has a row or a column in which all inputs meet.
            let finite = finite(coriolis_p.as_flattened()) & finite(coriolis_b.as_flattened());
            let kept = settle::<T>(&mut status[first..], reached & finite, finite, |lane| {
                let state = input + lane;
                states.examined(models.of(state), state, &[]).err()
            });
            matrices.mass_matrix_p.store_matrix(first, &mass_p, kept);
            matrices.coriolis_matrix_p.store_matrix(first, &coriolis_p, kept);
            matrices.jacobian_dp.store_matrix(first, &jacobian_p, kept);
            matrices.mass_matrix_b.store_matrix(first, &mass_b, kept);
            matrices.coriolis_matrix_b.store_matrix(first, &coriolis_b, kept);
            matrices.jacobian_db.store_matrix(first, &jacobian_b, kept);
        }
    }
}

impl<M, S: Number> super::Job<S> for Matrices<'_, M, S>
where
    M: InLanes<S> + RodAlignment<S> + generic::RodAlignment + generic::Matrices + Sync,
{
    fn count(&self) -> usize {
        self.status.len()
    }

    fn check(&self, count: usize) -> Result<(), LengthError> {
        self.models.check(count)?;
        self.states.check(count)?;
        self.matrices.check(count)
    }

    #[cfg(feature = "rayon")]
    fn split(self, state: usize) -> (Self, Self) {
        let (matrices, matrices_after) = self.matrices.split(state);
        let (status, status_after) = self.status.split_at_mut(state);
        let offset = self.offset + state;
        (
            Self { matrices, status, ..self },
            Self { matrices: matrices_after, status: status_after, offset, ..self },
        )
    }
}
