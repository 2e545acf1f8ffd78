//! Physical numbers given at run time: what they may be, and what is said when they are not.

use core::error;
use core::fmt;

/// What the numbers of a parameter may be. All of them must be finite.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Domain {
    /// Any number.
    Any,
    /// Above zero: masses, lengths, inertias of rods.
    Positive,
    /// Zero or above: stiffnesses and dampings.
    NotNegative,
    /// From 0 to 1.
    Fraction,
    /// Vectors of three numbers, of length 1.
    UnitVectors,
    /// A 3x3 inertia tensor that some body has.
    Inertia,
}

/// Why a parameter was refused. It keeps its old value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ParameterError {
    /// Its name.
    pub parameter: &'static str,
    /// Index of its first wrong element, flat and row-major; of a vector or tensor that of the first component.
    pub element: usize,
    /// What is wrong.
    pub problem: ParameterProblem,
}

/// What is wrong with a parameter.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub enum ParameterProblem {
    /// NaN or infinite.
    NotFinite,
    /// Zero or below, where only positive numbers are physical.
    NotPositive(f64),
    /// Below zero.
    Negative(f64),
    /// Not between 0 and 1.
    NotAFraction(f64),
    /// A direction of another length than 1.
    NotAUnitVector(f64),
    /// An inertia tensor whose triangles differ.
    NotSymmetric,
    /// An inertia tensor with a principal moment that is not positive, or larger than the sum of the others.
    OfNoBody,
}

/// Deviation of a unit vector's squared length from 1, or of an inertia tensor's triangles from each other, that rounding to
/// single precision explains.
const ROUNDING: f64 = 2e-6;

/// Checks the numbers of the parameter called `parameter`, flat and row-major.
///
/// # Errors
/// The first that is not in the domain.
pub fn check<T: Copy + Into<f64>>(
    parameter: &'static str,
    domain: Domain,
    values: &[T],
) -> Result<(), ParameterError> {
    let refuse = |element, problem| Err(ParameterError { parameter, element, problem });
    for (element, value) in values.iter().enumerate() {
        let value: f64 = (*value).into();
        if !value.is_finite() {
            return refuse(element, ParameterProblem::NotFinite);
        }
        let problem = match domain {
            Domain::Positive if value <= 0.0 => ParameterProblem::NotPositive(value),
            Domain::NotNegative if value < 0.0 => ParameterProblem::Negative(value),
            Domain::Fraction if !(0.0..=1.0).contains(&value) => ParameterProblem::NotAFraction(value),
            _ => continue,
        };
        return refuse(element, problem);
    }
    match domain {
        Domain::UnitVectors => {
            for (k, vector) in values.chunks(3).enumerate() {
                let squared: f64 = vector.iter().map(|x| (*x).into() * (*x).into()).sum();
                if (squared - 1.0).abs() > ROUNDING {
                    return refuse(3 * k, ParameterProblem::NotAUnitVector(crate::float::sqrt(squared)));
                }
            }
            Ok(())
        }
        Domain::Inertia => match inertia_problem(values) {
            Some(problem) => refuse(0, problem),
            None => Ok(()),
        },
        _ => Ok(()),
    }
}

fn inertia_problem<T: Copy + Into<f64>>(values: &[T]) -> Option<ParameterProblem> {
    let mut entries = [0.0; 9];
    for (entry, value) in entries.iter_mut().zip(values) {
        *entry = (*value).into();
    }
    let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = entries;
    let trace = xx + yy + zz;
    let differ = |one: f64, other: f64| (one - other).abs() > ROUNDING * trace.abs();
    if differ(xy, yx) || differ(xz, zx) || differ(yz, zy) {
        return Some(ParameterProblem::NotSymmetric);
    }
    // The second moments of mass, trace / 2 - I, are those of a body where they are positive semidefinite; then no principal
    // moment exceeds the sum of the others. The least of them is 0 for a flat body, up to rounding.
    let (a, b, c) = (0.5 * trace - xx, 0.5 * trace - yy, 0.5 * trace - zz);
    let slack = ROUNDING * trace;
    let minors = [
        (a, slack),
        (b, slack),
        (c, slack),
        (a * b - xy * xy, slack * trace),
        (a * c - xz * xz, slack * trace),
        (b * c - yz * yz, slack * trace),
        (a * (b * c - yz * yz) - xy * (xy * c + yz * xz) - xz * (xy * yz + b * xz), slack * trace * trace),
    ];
    let semidefinite = trace > 0.0 && minors.iter().all(|(minor, slack)| *minor >= -slack);
    let positive = xx > 0.0
        && xx * yy - xy * xy > 0.0
        && xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz) > 0.0;
    (!semidefinite || !positive).then_some(ParameterProblem::OfNoBody)
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "parameter `{}` keeps its value: ", self.parameter)?;
        let element = self.element;
        match self.problem {
            ParameterProblem::NotFinite => write!(f, "element {element} is NaN or infinite"),
            ParameterProblem::NotPositive(value) => {
                write!(f, "element {element} must be positive, but is {value}")
            }
            ParameterProblem::Negative(value) => {
                write!(f, "element {element} must not be negative, but is {value}")
            }
            ParameterProblem::NotAFraction(value) => {
                write!(f, "element {element} must lie between 0 and 1, but is {value}")
            }
            ParameterProblem::NotAUnitVector(length) => write!(
                f,
                "elements {element} to {} must be a unit vector, but its length is {length}; divide it by that",
                element + 2
            ),
            ParameterProblem::NotSymmetric => f.write_str("the inertia tensor is not symmetric"),
            ParameterProblem::OfNoBody => f.write_str(
                "no body has this inertia tensor: a principal moment is not positive or exceeds the sum of the others",
            ),
        }
    }
}

impl error::Error for ParameterError {}
