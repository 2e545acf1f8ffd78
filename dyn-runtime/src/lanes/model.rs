//! Models whose functions take lanes.

use super::{Lanes, Number};
use crate::float::Scalar;

/// A model whose generated functions take any type of number: see the traits in
/// [`kernels::generic`](crate::kernels::generic).
pub trait Generic {
    /// The model's physical numbers in another type of number; nothing if all are baked in.
    type Parameters<T: Scalar>: Copy;
}

/// A model, or as many models as there are lanes, as the parameters of generic functions.
pub trait InLanes<S: Number>: Generic {
    /// The parameters of model `of_lane(k)` in each lane k.
    fn in_lanes<'a, T: Lanes<Number = S>>(of_lane: impl Fn(usize) -> &'a Self) -> Self::Parameters<T>
    where
        Self: 'a;
}
