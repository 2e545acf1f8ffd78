//! Slices of one length, of which lanes are loaded and stored with one check for all of them: with one check each, a batch
//! spent a third of its time on them.

use core::array;

use super::{Lanes, Number};

/// N slices. Invariant: `shared` is not longer than any of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Components<'a, S, const N: usize> {
    slices: [&'a [S]; N],
    shared: usize,
}

/// N slices to be written. Invariant: `shared` is not longer than any of them.
#[derive(Debug)]
pub(crate) struct ComponentsMut<'a, S, const N: usize> {
    slices: [&'a mut [S]; N],
    shared: usize,
}

impl<'a, S: Number, const N: usize> Components<'a, S, N> {
    pub fn new(slices: [&'a [S]; N]) -> Self {
        let shared = slices.iter().map(|slice| slice.len()).min().unwrap_or(0);
        Self { slices, shared }
    }

    pub fn slices(&self) -> &[&'a [S]; N] {
        &self.slices
    }

    /// From `first` on; after the end of a slice its last number again.
    #[inline(always)]
    pub fn load<T: Lanes<Number = S>>(&self, first: usize) -> [T; N] {
        if first < self.shared && T::COUNT <= self.shared - first {
            // SAFETY: no slice is shorter than `shared`.
            let group = |slice: &'a [S]| unsafe { slice.get_unchecked(first..first + T::COUNT) };
            array::from_fn(|k| T::load(group(self.slices[k])))
        } else {
            array::from_fn(|k| T::load(self.slices[k].get(first..).unwrap_or_default()))
        }
    }
}

impl<'a, S: Number, const N: usize> ComponentsMut<'a, S, N> {
    pub fn new(slices: [&'a mut [S]; N]) -> Self {
        let shared = slices.iter().map(|slice| slice.len()).min().unwrap_or(0);
        Self { slices, shared }
    }

    pub fn slices(&self) -> [&[S]; N] {
        array::from_fn(|k| &*self.slices[k])
    }

    #[cfg(feature = "rayon")]
    pub fn into_slices(self) -> [&'a mut [S]; N] {
        self.slices
    }

    /// As [`Components::load`].
    #[inline(always)]
    pub fn load<T: Lanes<Number = S>>(&self, first: usize) -> [T; N] {
        Components { slices: self.slices(), shared: self.shared }.load(first)
    }

    /// Writes all lanes from `first` on; false, and nothing written, where slices end before that.
    #[inline(always)]
    pub fn store<T: Lanes<Number = S>>(&mut self, first: usize, numbers: &[T; N]) -> bool {
        let inside = first < self.shared && T::COUNT <= self.shared - first;
        if inside {
            for (slice, number) in self.slices.iter_mut().zip(numbers) {
                // SAFETY: no slice is shorter than `shared`.
                number.store(unsafe { slice.get_unchecked_mut(first..first + T::COUNT) });
            }
        }
        inside
    }

    /// Writes the lanes whose bit is set in `lanes`, as far as there are places for them.
    #[inline(always)]
    pub fn store_some<T: Lanes<Number = S>>(&mut self, first: usize, numbers: &[T; N], lanes: u32) {
        for (slice, number) in self.slices.iter_mut().zip(numbers) {
            let places = slice.get_mut(first..).unwrap_or_default();
            number.for_each(|lane, number| {
                if let Some(place) = places.get_mut(lane).filter(|_| lanes >> lane & 1 == 1) {
                    *place = number;
                }
            });
        }
    }
}
