//! Which platform a call is about.

use core::ffi::c_char;
use core::marker::PhantomData;

use dyn_runtime::Limits;
use dyn_runtime::current::VoiceCoils;
#[cfg(any(feature = "uhp", feature = "ups"))]
use dyn_runtime::models;

use crate::parameters::{UhpParameters, UpsParameters};
use crate::pointers::{explain, structure};
use crate::real::Real;
use crate::status::{Info, Refusal, Status};

#[cfg(not(feature = "own-platform"))]
mod baked {
    pub(crate) use dyn_runtime::models::Uhp2016 as Baked;
    pub(crate) const NAME: &core::ffi::CStr = c"uhp_2016";
}

#[cfg(feature = "own-platform")]
#[allow(missing_docs)]
#[rustfmt::skip]
mod baked {
    include!(concat!(env!("OUT_DIR"), "/baked.rs"));
    pub(crate) const NAME: &core::ffi::CStr = include!(concat!(env!("OUT_DIR"), "/baked_name.rs"));
}

pub(crate) use baked::Baked;

/// Kinds of models, for `dyn_model.kind`.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ModelKind {
    /// The platform whose numbers are baked into the library; dyn_baked_platform_name() names it.
    Baked = 0,
    /// Any platform with UHP legs (actuator fixed to the base, Hooke joint, rod, universal joint), parameters at run time.
    Uhp = 1,
    /// Any platform with UPS legs (universal joint on the base, telescopic leg, spherical joint; Gough and Stewart's),
    /// parameters at run time.
    Ups = 2,
}

/// A platform: a kind, and the parameters of kinds that have them at run time.
///
/// Holds no state and no resources; any number of threads may use one at the same time.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Model {
    /// Set to sizeof(dyn_model).
    pub struct_size: usize,
    /// A `DYN_MODEL_KIND_...`.
    pub kind: i32,
    /// For DYN_MODEL_KIND_UHP, else not looked at. The caller keeps it.
    pub uhp: *const UhpParameters,
    /// For DYN_MODEL_KIND_UPS, else not looked at. The caller keeps it.
    pub ups: *const UpsParameters,
}

/// A [`Model`] whose kind is known and whose parameters are there.
pub(crate) enum Platform<'a> {
    Baked(PhantomData<&'a ()>),
    #[cfg(feature = "uhp")]
    Uhp(&'a UhpParameters),
    #[cfg(feature = "ups")]
    Ups(&'a UpsParameters),
}

/// Evaluates an expression with `hexapod` bound to the platform's [`Hexapod`](dyn_runtime::Hexapod).
macro_rules! with_hexapod {
    ($platform:expr, |$hexapod:ident| $value:expr) => {
        match $platform {
            $crate::model::Platform::Baked(_) => {
                let $hexapod = $crate::real::hexapod($crate::model::Baked);
                $value
            }
            #[cfg(feature = "uhp")]
            $crate::model::Platform::Uhp(parameters) => {
                let $hexapod = $crate::real::hexapod(dyn_runtime::models::Uhp::from(*parameters));
                $value
            }
            #[cfg(feature = "ups")]
            $crate::model::Platform::Ups(parameters) => {
                let $hexapod = $crate::real::hexapod(dyn_runtime::models::Ups::from(*parameters));
                $value
            }
        }
    };
}

pub(crate) use with_hexapod;

impl Model {
    /// The platform that this is.
    ///
    /// # Safety
    /// Pointers are null or point to a `struct_size` and, if that is right, to the whole struct.
    pub(crate) unsafe fn platform<'a>(&self) -> Result<Platform<'a>, Refusal> {
        match self.kind {
            kind if kind == ModelKind::Baked as i32 => Ok(Platform::Baked(PhantomData)),
            #[cfg(feature = "uhp")]
            kind if kind == ModelKind::Uhp as i32 => {
                // SAFETY: passed on to the caller.
                Ok(Platform::Uhp(unsafe { structure(self.uhp)? }))
            }
            #[cfg(feature = "ups")]
            kind if kind == ModelKind::Ups as i32 => {
                // SAFETY: passed on to the caller.
                Ok(Platform::Ups(unsafe { structure(self.ups)? }))
            }
            _ => Err(Refusal::of(Status::UnknownModel)),
        }
    }
}

/// Stands in for the function of a model whose platform file does not give all six force constants: where the model has its
/// own `voice_coils`, that comes before a trait's.
#[allow(dead_code)] // Not called where the model has its own.
trait WithoutVoiceCoils {
    fn voice_coils<T>() -> Option<VoiceCoils<T>> {
        None
    }
}

impl WithoutVoiceCoils for Baked {}

impl Platform<'_> {
    /// What the platform file says that actuators and joints may do; none is behind parameters at run time.
    pub(crate) fn limits(&self) -> Option<Limits<Real>> {
        match self {
            Self::Baked(_) => Some(Baked::limits()),
            #[cfg(any(feature = "uhp", feature = "ups"))]
            _ => None,
        }
    }

    /// The voice coils of the platform file, if it gives them.
    pub(crate) fn voice_coils(&self) -> Option<VoiceCoils<Real>> {
        match self {
            // The coils of a model that has them, or what stands in for them.
            #[allow(clippy::useless_conversion)]
            Self::Baked(_) => Baked::voice_coils::<Real>().into(),
            #[cfg(any(feature = "uhp", feature = "ups"))]
            _ => None,
        }
    }
}

/// Checks that the parameters of a model are physical: once, before the first call. Calls do not look at them; they find
/// out what makes their own results impossible, and compute nonsense from the rest, such as a negative mass.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dyn_check_model(model: *const Model, info: *mut Info) -> Status {
    // SAFETY: the caller keeps what the crate says.
    unsafe {
        explain(info, || match structure(model)?.platform()? {
            Platform::Baked(_) => Ok(()),
            #[cfg(feature = "uhp")]
            Platform::Uhp(parameters) => Ok(models::Uhp::from(parameters).parameters.check()?),
            #[cfg(feature = "ups")]
            Platform::Ups(parameters) => Ok(models::Ups::from(parameters).parameters.check()?),
        })
    }
}

/// Name of the platform behind DYN_MODEL_KIND_BAKED, as in its platform file: a static string.
#[unsafe(no_mangle)]
pub extern "C" fn dyn_baked_platform_name() -> *const c_char {
    baked::NAME.as_ptr()
}
