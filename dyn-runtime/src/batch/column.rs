//! Where the numbers of a batch lie: one argument of many states.

use core::array;

use super::{LengthError, check};
use crate::lanes::{Components, ComponentsMut, Lanes, Number};

/// One input of every state: N numbers per state. 3x3 rotations are nine numbers, row by row.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a, S, const N: usize>(Layout<'a, S, N>);

#[derive(Clone, Copy, Debug)]
enum Layout<'a, S, const N: usize> {
    Same([S; N]),
    States(&'a [[S; N]]),
    Components(Components<'a, S, N>),
}

impl<'a, S: Number, const N: usize> Column<'a, S, N> {
    /// The same for every state.
    pub fn same(numbers: [S; N]) -> Self {
        Self(Layout::Same(numbers))
    }

    /// Array of structures: the numbers of one state after those of another.
    pub fn states(states: &'a [[S; N]]) -> Self {
        Self(Layout::States(states))
    }

    /// Structure of arrays: for each number a slice with that of every state.
    pub fn components(components: [&'a [S]; N]) -> Self {
        Self(Layout::Components(Components::new(components)))
    }

    /// Structure of arrays in one slice: the first number of every state, then the second of every state, ... A number of
    /// elements that is no multiple of N fits no batch.
    pub fn component_major(numbers: &'a [S]) -> Self {
        let states = numbers.len().div_ceil(N);
        Self::components(array::from_fn(|component| {
            let rest = numbers.get(component * states..).unwrap_or_default();
            &rest[..states.min(rest.len())]
        }))
    }

    /// Whether it is one for `states` states; `argument` is its name.
    pub(super) fn check(&self, argument: &'static str, states: usize) -> Result<(), LengthError> {
        match &self.0 {
            Layout::Same(_) => Ok(()),
            Layout::States(numbers) => check(argument, states, [numbers.len()]),
            Layout::Components(numbers) => check(argument, states, numbers.slices().map(<[S]>::len)),
        }
    }

    /// From state `first` on, one state per lane; after the last state the last one again.
    #[inline(always)]
    pub(super) fn load<T: Lanes<Number = S>>(&self, first: usize) -> [T; N] {
        match &self.0 {
            Layout::Same(numbers) => {
                // No `map`: it is not always inlined, and then not compiled for the lanes.
                let mut lanes = [T::constant(0.0); N];
                for (lanes, number) in lanes.iter_mut().zip(numbers) {
                    *lanes = T::splat(*number);
                }
                lanes
            }
            Layout::Components(numbers) => numbers.load(first),
            Layout::States(states) => match states.get(first..first + T::COUNT) {
                Some(states) => array::from_fn(|k| T::from_fn(|lane| states[lane][k])),
                None => {
                    array::from_fn(|k| T::from_fn(|lane| states[(first + lane).min(states.len() - 1)][k]))
                }
            },
        }
    }

    /// Of one state.
    pub(super) fn at(&self, state: usize) -> [S; N] {
        match &self.0 {
            Layout::Same(numbers) => *numbers,
            Layout::States(states) => states[state],
            Layout::Components(numbers) => numbers.slices().map(|numbers| numbers[state]),
        }
    }
}

/// One output of every state: N numbers per state. A 6x6 matrix is 36 numbers, row by row.
#[derive(Debug)]
pub struct ColumnMut<'a, S, const N: usize>(LayoutMut<'a, S, N>);

#[derive(Debug)]
enum LayoutMut<'a, S, const N: usize> {
    States(&'a mut [[S; N]]),
    Components(ComponentsMut<'a, S, N>),
}

impl<'a, S: Number, const N: usize> ColumnMut<'a, S, N> {
    /// Array of structures, see [`Column::states`].
    pub fn states(states: &'a mut [[S; N]]) -> Self {
        Self(LayoutMut::States(states))
    }

    /// Structure of arrays, see [`Column::components`].
    pub fn components(components: [&'a mut [S]; N]) -> Self {
        Self(LayoutMut::Components(ComponentsMut::new(components)))
    }

    /// Structure of arrays in one slice, see [`Column::component_major`].
    pub fn component_major(numbers: &'a mut [S]) -> Self {
        let states = numbers.len().div_ceil(N);
        let mut rest = numbers;
        Self::components(array::from_fn(|_| {
            let (component, after) =
                core::mem::take(&mut rest).split_at_mut_checked(states).unwrap_or_default();
            rest = after;
            component
        }))
    }

    pub(super) fn check(&self, argument: &'static str, states: usize) -> Result<(), LengthError> {
        match &self.0 {
            LayoutMut::States(numbers) => check(argument, states, [numbers.len()]),
            LayoutMut::Components(numbers) => check(argument, states, numbers.slices().map(<[S]>::len)),
        }
    }

    /// As [`Column::load`].
    #[inline(always)]
    pub(super) fn load<T: Lanes<Number = S>>(&self, first: usize) -> [T; N] {
        match &self.0 {
            LayoutMut::States(states) => Column::states(states).load(first),
            LayoutMut::Components(numbers) => numbers.load(first),
        }
    }

    /// As [`Column::at`].
    pub(super) fn at(&self, state: usize) -> [S; N] {
        match &self.0 {
            LayoutMut::States(states) => states[state],
            LayoutMut::Components(numbers) => numbers.slices().map(|numbers| numbers[state]),
        }
    }

    /// Writes the lanes whose bit is set in `lanes` to the states from `first` on.
    #[inline(always)]
    pub(super) fn store<T: Lanes<Number = S>>(&mut self, first: usize, numbers: &[T; N], lanes: u32) {
        let all = lanes == all_lanes::<T>();
        match &mut self.0 {
            LayoutMut::Components(components) => {
                if !all || !components.store(first, numbers) {
                    components.store_some(first, numbers, lanes);
                }
            }
            LayoutMut::States(states) => {
                let states = &mut states[first..];
                match states.get_mut(..T::COUNT) {
                    Some(states) if all => {
                        for (k, number) in numbers.iter().enumerate() {
                            number.for_each(|lane, number| states[lane][k] = number);
                        }
                    }
                    _ => {
                        for (k, number) in numbers.iter().enumerate() {
                            number.for_each(|lane, number| {
                                if let Some(state) = states.get_mut(lane).filter(|_| lanes >> lane & 1 == 1) {
                                    state[k] = number;
                                }
                            });
                        }
                    }
                }
            }
        }
    }

    /// The states before `state`, and the others.
    #[cfg(feature = "rayon")]
    pub(super) fn split(self, state: usize) -> (Self, Self) {
        match self.0 {
            LayoutMut::States(states) => {
                let (before, after) = states.split_at_mut(state);
                (Self::states(before), Self::states(after))
            }
            LayoutMut::Components(numbers) => {
                let mut after = array::from_fn(|_| Default::default());
                let mut parts = after.iter_mut();
                let before = numbers.into_slices().map(|numbers| {
                    let (before, rest) = numbers.split_at_mut(state);
                    if let Some(part) = parts.next() {
                        *part = rest;
                    }
                    before
                });
                (Self::components(before), Self::components(after))
            }
        }
    }
}

impl<S: Number> ColumnMut<'_, S, 36> {
    /// [`store`](Self::store) of 6x6 matrices.
    #[inline(always)]
    pub(super) fn store_matrix<T: Lanes<Number = S>>(
        &mut self,
        first: usize,
        matrix: &[[T; 6]; 6],
        lanes: u32,
    ) {
        if let Some(numbers) = matrix.as_flattened().first_chunk() {
            self.store(first, numbers, lanes);
        }
    }
}

/// A bit for every lane.
#[inline(always)]
pub(super) fn all_lanes<T: Lanes>() -> u32 {
    u32::MAX >> (32 - T::COUNT)
}
