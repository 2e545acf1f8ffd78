//! A mechanism whose leg type is known at run time only: parameters and results by name. Outside the numeric core:
//! this may allocate.

use crate::inputs::InputError;
use crate::legs::{uhp, ups};
use crate::outputs::{output, outputs};
use crate::parameters::Parameters;
use crate::state::State;

/// Parameters of a platform of any leg type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mechanism {
    /// The paper's leg.
    Uhp(Parameters<uhp::Leg>),
    /// The classical Gough-Stewart leg.
    Ups(Parameters<ups::Leg>),
}

/// Reads the parameters of one leg type.
type Read = fn(&mut dyn FnMut(&str) -> Option<Vec<f64>>) -> Result<Mechanism, InputError>;

/// Names of the leg types.
const LEG_TYPES: [(&str, Read); 2] = [
    ("uhp", |lookup| Parameters::from_arrays(lookup).map(Mechanism::Uhp)),
    ("ups", |lookup| Parameters::from_arrays(lookup).map(Mechanism::Ups)),
];

impl Mechanism {
    /// Parameters from flat row-major arrays by name, see [`Parameters::from_arrays`]; `None` for a leg type that is
    /// not known.
    ///
    /// # Errors
    /// A value is missing or has the wrong number of entries.
    pub fn from_arrays(
        leg_type: &str,
        mut lookup: impl FnMut(&str) -> Option<Vec<f64>>,
    ) -> Option<Result<Self, InputError>> {
        let (_, read) = LEG_TYPES.iter().find(|(name, _)| *name == leg_type)?;
        Some(read(&mut lookup))
    }

    /// Names of all results.
    pub fn output_names(&self) -> Vec<&'static str> {
        match self {
            Self::Uhp(_) => outputs::<uhp::Leg>().map(|output| output.name).collect(),
            Self::Ups(_) => outputs::<ups::Leg>().map(|output| output.name).collect(),
        }
    }

    /// Appends the result called `name`, see [`output`].
    pub fn output(&self, state: &State, name: &str, out: &mut Vec<f64>) -> bool {
        match self {
            Self::Uhp(parameters) => output(parameters, state, name, out),
            Self::Ups(parameters) => output(parameters, state, name, out),
        }
    }
}
