//! Which platform a call is about.

use core::ffi::c_char;
use core::marker::PhantomData;

#[cfg(feature = "uhp")]
use dyn_runtime::models;

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
}

/// Parameters of a platform with UHP legs. SI units; the first index of leg quantities is the leg.
///
/// `dyn-gen resolve platform.toml` prints these numbers under these names.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UhpParameters {
    /// Set to sizeof(dyn_uhp_parameters).
    pub struct_size: usize,
    /// Point b of the actuator's axis, m, B.
    pub base_point: [[Real; 3]; 6],
    /// Unit vector a of the actuator, towards the platform, B.
    pub actuator_axis: [[Real; 3]; 6],
    /// Platform joint p, m, P.
    pub platform_point: [[Real; 3]; 6],
    /// Rod length s, m.
    pub rod_length: [Real; 6],
    /// Rod mass m_s, kg.
    pub rod_mass: [Real; 6],
    /// Transverse inertia J_s of the rod about its centre of mass, kg m^2.
    pub rod_inertia: [Real; 6],
    /// The rod's centre of mass, from Hooke joint (0) to platform joint (1).
    pub rod_com_fraction: [Real; 6],
    /// Mover mass m_d, kg.
    pub mover_mass: [Real; 6],
    /// Distance of the mover's centre of mass below the Hooke joint, m.
    pub mover_offset: [Real; 6],
    /// Actuator length d0 at which the leaf springs are relaxed, m.
    pub rest_length: [Real; 6],
    /// Axial stiffness k_e of the leaf springs, N/m.
    pub axial_stiffness: [Real; 6],
    /// Axial viscous damping c_e, N s/m.
    pub axial_damping: [Real; 6],
    /// Mass of platform and payload, kg.
    pub payload_mass: Real,
    /// Centre of mass of platform and payload, m, P.
    pub payload_com: [Real; 3],
    /// Inertia of platform and payload about their centre of mass, kg m^2, P; symmetric, the upper triangle is read.
    pub payload_inertia: [[Real; 3]; 3],
    /// Acceleration of gravity, m/s^2, O.
    pub gravity: [Real; 3],
}

/// A [`Model`] whose kind is known and whose parameters are there.
pub(crate) enum Platform<'a> {
    Baked(PhantomData<&'a UhpParameters>),
    #[cfg(feature = "uhp")]
    Uhp(&'a UhpParameters),
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
            _ => Err(Refusal::of(Status::UnknownModel)),
        }
    }
}

#[cfg(feature = "uhp")]
impl From<&UhpParameters> for models::Uhp<Real> {
    fn from(parameters: &UhpParameters) -> Self {
        let &UhpParameters {
            struct_size: _,
            base_point,
            actuator_axis,
            platform_point,
            rod_length,
            rod_mass,
            rod_inertia,
            rod_com_fraction,
            mover_mass,
            mover_offset,
            rest_length,
            axial_stiffness,
            axial_damping,
            payload_mass,
            payload_com,
            payload_inertia,
            gravity,
        } = parameters;
        Self {
            parameters: models::Parameters {
                base_point,
                actuator_axis,
                platform_point,
                rod_length,
                rod_mass,
                rod_inertia,
                rod_com_fraction,
                mover_mass,
                mover_offset,
                rest_length,
                axial_stiffness,
                axial_damping,
                payload_mass,
                payload_com,
                payload_inertia,
                gravity,
            },
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
        })
    }
}

/// Name of the platform behind DYN_MODEL_KIND_BAKED, as in its platform file: a static string.
#[unsafe(no_mangle)]
pub extern "C" fn dyn_baked_platform_name() -> *const c_char {
    baked::NAME.as_ptr()
}
