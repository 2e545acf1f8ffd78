//! Results of generated functions and of the reference: different types, read alike.

use dyn_reference::matrices::{CoriolisMatrices, Matrices};
use nalgebra::{Matrix6, Vector6};

/// A result.
pub trait Output {
    /// Bitwise "or" of every number, to make what follows wait for all of them.
    fn bits(&self) -> u64;

    /// Appends every number, row-major.
    fn read(&self, values: &mut Vec<f64>);
}

impl Output for f64 {
    #[inline(always)]
    fn bits(&self) -> u64 {
        self.to_bits()
    }

    fn read(&self, values: &mut Vec<f64>) {
        values.push(*self);
    }
}

impl<T: Output, const N: usize> Output for [T; N] {
    #[inline(always)]
    fn bits(&self) -> u64 {
        self.iter().fold(0, |bits, element| bits | element.bits())
    }

    fn read(&self, values: &mut Vec<f64>) {
        self.iter().for_each(|element| element.read(values));
    }
}

impl Output for Vector6<f64> {
    #[inline(always)]
    fn bits(&self) -> u64 {
        self.data.0.bits()
    }

    fn read(&self, values: &mut Vec<f64>) {
        self.data.0.read(values);
    }
}

impl Output for Matrix6<f64> {
    #[inline(always)]
    fn bits(&self) -> u64 {
        self.data.0.bits()
    }

    fn read(&self, values: &mut Vec<f64>) {
        self.transpose().data.0.read(values);
    }
}

/// A solution; without one there is nothing to wait for and nothing to read.
impl<T: Output> Output for Option<T> {
    #[inline(always)]
    fn bits(&self) -> u64 {
        self.as_ref().map_or(0, T::bits)
    }

    fn read(&self, values: &mut Vec<f64>) {
        if let Some(output) = self {
            output.read(values);
        }
    }
}

impl Output for CoriolisMatrices {
    #[inline(always)]
    fn bits(&self) -> u64 {
        self.coriolis_matrix_p.bits() | self.coriolis_matrix_b.bits()
    }

    fn read(&self, values: &mut Vec<f64>) {
        self.coriolis_matrix_p.read(values);
        self.coriolis_matrix_b.read(values);
    }
}

impl Output for Matrices {
    #[inline(always)]
    fn bits(&self) -> u64 {
        self.mass_matrix_p.bits()
            | self.coriolis_matrix_p.bits()
            | self.jacobian_dp.bits()
            | self.mass_matrix_b.bits()
            | self.coriolis_matrix_b.bits()
            | self.jacobian_db.bits()
    }

    fn read(&self, values: &mut Vec<f64>) {
        let Self {
            mass_matrix_p,
            coriolis_matrix_p,
            jacobian_dp,
            mass_matrix_b,
            coriolis_matrix_b,
            jacobian_db,
        } = self;
        for matrix in
            [mass_matrix_p, coriolis_matrix_p, jacobian_dp, mass_matrix_b, coriolis_matrix_b, jacobian_db]
        {
            matrix.read(values);
        }
    }
}
