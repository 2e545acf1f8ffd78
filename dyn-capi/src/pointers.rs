//! The border to C: the only module that follows pointers of callers.
//!
//! # What a caller must keep
//!
//! Every call takes pointers that are null or point to what their type says. A struct need only be as large as its first
//! member, `struct_size`, while that member is not the struct's size in this library: then the rest is neither read
//! nor written, and the call refuses. During a call no other thread writes what the call reads, or uses what it writes.
//! Outputs may lie anywhere, over inputs as well: they are written when everything is computed.

use core::mem::size_of;

use dyn_runtime::Error;

use crate::control::{Control, ForwardKinematics};
use crate::inputs::{Inputs, States};
use crate::limits::{Coils, CurrentsResult, Limits, Margins};
use crate::model::{Model, Platform};
use crate::outputs::{
    CoriolisMatrices, Energy, EquationOfMotion, LegKinematics, Matrices, PassiveForces, StiffnessMatrices,
};
use crate::parameters::{UhpParameters, UpsParameters};
use crate::real::Real;
use crate::status::{Info, Refusal, Status};

/// A struct that begins with its size.
///
/// # Safety
/// The type is `repr(C)` and its first member is `struct_size: usize`.
pub(crate) unsafe trait Structure: Sized {
    /// The struct behind a caller's pointer has this size.
    ///
    /// # Safety
    /// `pointer` is null or points to a `usize` that may be read.
    unsafe fn check(pointer: *const Self) -> Result<(), Refusal> {
        present(pointer)?;
        // SAFETY: not null, aligned for `Self` and so for its first member, which the caller lets us read.
        let struct_size = unsafe { pointer.cast::<usize>().read() };
        if struct_size == size_of::<Self>() { Ok(()) } else { Err(Refusal::of(Status::WrongStructSize)) }
    }
}

/// Declares that structs begin with their size.
macro_rules! structures {
    ($($structure:ty),+ $(,)?) => {$(
        // SAFETY: `repr(C)`, first member `struct_size: usize`.
        unsafe impl Structure for $structure {}
    )+};
}

/// What a call writes: an array, or a struct that begins with its size.
pub(crate) trait Output: Copy {
    /// The caller's place for it is as large as it must be, as far as that can be told.
    ///
    /// # Safety
    /// `pointer` is null or points to an array, or to a `usize` that may be read.
    unsafe fn check(pointer: *const Self) -> Result<(), Refusal>;
}

impl<T: Copy, const N: usize> Output for [T; N] {
    unsafe fn check(pointer: *const Self) -> Result<(), Refusal> {
        present(pointer)
    }
}

/// Neither null nor misaligned.
fn present<T>(pointer: *const T) -> Result<(), Refusal> {
    if pointer.is_null() || !pointer.is_aligned() { Err(Refusal::of(Status::NullPointer)) } else { Ok(()) }
}

/// The struct behind a caller's pointer.
///
/// # Safety
/// As the module says.
pub(crate) unsafe fn structure<'a, T: Structure>(pointer: *const T) -> Result<&'a T, Refusal> {
    // SAFETY: the caller lets us read `struct_size`; once that is right, the whole struct is there.
    unsafe {
        T::check(pointer)?;
        Ok(&*pointer)
    }
}

/// The N numbers behind a caller's pointer.
///
/// # Safety
/// As the module says.
pub(crate) unsafe fn array<const N: usize>(first: *const Real) -> Result<[Real; N], Refusal> {
    present(first)?;
    // SAFETY: not null and aligned; the caller lets us read N numbers from there.
    Ok(unsafe { first.cast::<[Real; N]>().read() })
}

/// Answers a call about a model: refuses bad pointers, computes, then writes output and details.
///
/// # Safety
/// As the module says.
pub(crate) unsafe fn answer<O: Output>(
    model: *const Model,
    inputs: *const Inputs,
    output: *mut O,
    info: *mut Info,
    compute: impl FnOnce(&Platform<'_>, &States) -> Result<O, Error>,
) -> Status {
    // SAFETY: the caller keeps what the module says.
    unsafe {
        convert(output, info, || {
            let platform = structure(model)?.platform()?;
            Ok(compute(&platform, &structure(inputs)?.into())?)
        })
    }
}

/// Answers any call with an output: refuses a bad pointer to it, computes, then writes it and the details.
///
/// # Safety
/// As the module says.
pub(crate) unsafe fn convert<O: Output>(
    output: *mut O,
    info: *mut Info,
    compute: impl FnOnce() -> Result<O, Refusal>,
) -> Status {
    // SAFETY: the caller keeps what the module says: a pointer that passes the check points to a whole array or struct,
    // and nobody else uses it.
    unsafe {
        explain(info, || {
            O::check(output)?;
            output.write(compute()?);
            Ok(())
        })
    }
}

/// Does something and writes how it ended; where details have no place of their size, it is not even begun.
///
/// # Safety
/// As the module says.
pub(crate) unsafe fn explain(info: *mut Info, act: impl FnOnce() -> Result<(), Refusal>) -> Status {
    if info.is_null() {
        return act().map_or_else(|refusal| refusal.status, |()| Status::Ok);
    }
    // SAFETY: the caller keeps what the module says: a pointer that passes the check points to a whole struct, and
    // nobody else uses it.
    unsafe {
        if let Err(refusal) = Info::check(info) {
            return refusal.status;
        }
        let refusal = act().err().unwrap_or(Refusal::of(Status::Ok));
        info.write(refusal.info());
        refusal.status
    }
}

/// Declares that structs are outputs.
macro_rules! outputs {
    ($($structure:ty),+ $(,)?) => {
        structures!($($structure),+);
        $(impl Output for $structure {
            unsafe fn check(pointer: *const Self) -> Result<(), Refusal> {
                // SAFETY: passed on to the caller.
                unsafe { <Self as Structure>::check(pointer) }
            }
        })+
    };
}

structures!(Inputs, Info, Model, UhpParameters, UpsParameters);

outputs!(
    CoriolisMatrices,
    Energy,
    EquationOfMotion,
    LegKinematics,
    Matrices,
    PassiveForces,
    StiffnessMatrices,
    Control,
    CurrentsResult,
    ForwardKinematics,
    Coils,
    Limits,
    Margins,
);
