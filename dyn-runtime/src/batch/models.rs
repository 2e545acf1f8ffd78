//! The model of a batch, or one for every state.

use super::{LengthError, check};
use crate::lanes::{InLanes, Lanes, Number};

/// Where a state's model is.
#[derive(Debug)]
pub(super) enum Models<'a, M> {
    One(&'a M),
    Each(&'a [M]),
}

impl<M> Clone for Models<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for Models<'_, M> {}

impl<'a, M> Models<'a, M> {
    /// The model of a state.
    pub fn of(self, state: usize) -> &'a M {
        match self {
            Self::One(model) => model,
            Self::Each(models) => &models[state],
        }
    }

    /// Whether there is one for all `states` states, or one for each.
    pub fn check(self, states: usize) -> Result<(), LengthError> {
        match self {
            Self::One(_) => Ok(()),
            Self::Each(models) => check("models", states, [models.len()]),
        }
    }

    /// The parameters of the states from `first` on; after the last state the last ones again.
    #[inline(always)]
    pub fn load<S: Number, T: Lanes<Number = S>>(self, first: usize) -> M::Parameters<T>
    where
        M: InLanes<S>,
    {
        match self {
            Self::One(model) => M::in_lanes(|_| model),
            Self::Each(models) => M::in_lanes(|lane| &models[(first + lane).min(models.len() - 1)]),
        }
    }

    /// The same for another group of states, where that changes anything.
    #[inline(always)]
    pub fn reload<S: Number, T: Lanes<Number = S>>(self, first: usize, parameters: &mut M::Parameters<T>)
    where
        M: InLanes<S>,
    {
        if matches!(self, Self::Each(_)) {
            *parameters = self.load(first);
        }
    }
}
