//! Hints at units that are probably wrong. Nothing here refuses: an unusual number may be meant.
//!
//! The limits are generous: what they let through may still be wrong, what they catch is hardly ever meant.

use std::f64::consts::TAU;
use std::ops::Range;

use toml::Spanned;

use crate::keys::Key;
use crate::legs::{Leg, LegKind};
use crate::refusal::Refusal;

/// Lengths of this many metres belong to no machine on a table, but to millimetres.
const LONG: f64 = 20.0;
/// Speeds and accelerations of this size, in m/s and m/s^2, belong to mm/s and mm/s^2.
const FAST: f64 = 100.0;
/// A pair of joints farther apart than this, a third of the circle, overlaps its neighbours.
const WIDE: f64 = TAU / 3.0;
/// About the density of gold, kg/m^3: no cube is heavier.
const DENSE: f64 = 2e4;

/// A unit that may have been meant: its name, and what one of it is in the SI unit of the key.
struct Meant {
    /// End of the names of keys.
    ending: &'static str,
    unit: &'static str,
    factor: f64,
    from: f64,
}

const LARGE: [Meant; 4] = [
    Meant { ending: "_m_per_s2", unit: "mm/s^2", factor: 1e-3, from: FAST },
    Meant { ending: "_m_per_s", unit: "mm/s", factor: 1e-3, from: FAST },
    Meant { ending: "_rad", unit: "degrees", factor: TAU / 360.0, from: WIDE },
    Meant { ending: "_m", unit: "mm", factor: 1e-3, from: LONG },
];

/// A number, or the largest of a vector, that is too large for the unit of its key.
pub(crate) fn too_large(numbers: &[f64], at: Range<usize>, key: &Key) -> Option<Refusal> {
    if key.name.ends_with("_per_m") {
        // Stiffness and damping have no size of their own.
        return None;
    }
    let meant = LARGE.iter().find(|meant| key.name.ends_with(meant.ending))?;
    let largest = numbers.iter().copied().max_by(|one, other| one.abs().total_cmp(&other.abs()))?;
    let found = if numbers.len() == 1 { format!("is {largest}") } else { format!("has {largest} in it") };
    (largest.abs() >= meant.from).then(|| {
        let (label, what) =
            (format!("in {}?", meant.unit), format!("`{}` {found}, unusually large", key.name));
        Refusal::new(
            at,
            label,
            what,
            format!("if that is in {}, write {}", meant.unit, rounded(largest * meant.factor)),
        )
    })
}

/// Units of inertia that may have been meant, and what one of each is in kg m^2.
const INERTIAS: [(&str, f64); 4] = [("kg cm^2", 1e-4), ("kg mm^2", 1e-6), ("g cm^2", 1e-7), ("g mm^2", 1e-9)];

/// Of a body of this size (m): heavier than a cube of gold of this size.
fn too_heavy(mass: &Spanned<f64>, size: f64, key: &str, body: &str) -> Option<Refusal> {
    let kilograms = *mass.get_ref();
    (kilograms > DENSE * size.powi(3)).then(|| {
        let what = format!(
            "`{key}` is {kilograms}, heavier than a cube of gold {} m wide, the size of {body}",
            rounded(size)
        );
        let help = format!("if that is in g, write {}", rounded(kilograms * 1e-3));
        Refusal::new(mass.span(), "in g?", what, help)
    })
}

/// The unit and factor that bring the inertia of a body of this size nearest to that of others, which have a radius of
/// gyration of a third of their size.
fn likely_unit(inertia: f64, mass: f64, size: f64) -> (&'static str, f64) {
    let off = |factor: f64| (9.0 * inertia * factor / (mass * size * size)).ln().abs();
    INERTIAS.into_iter().min_by(|one, other| off(one.1).total_cmp(&off(other.1))).unwrap_or(INERTIAS[0])
}

/// Masses and inertias of the legs, each compared with the leg's own size.
pub(crate) fn of_legs(kind: &LegKind, legs: &[Leg; 6]) -> Vec<Refusal> {
    let mut hints = Vec::new();
    for leg in legs {
        let size = (kind.size)(leg);
        for body in kind.bodies {
            let (mass, mass_at) = (leg.scalar(body.mass), leg.span(body.mass));
            let key = |parameter: &str| kind.key(parameter).name;
            let placed = Spanned::new(mass_at, mass);
            hints.extend(too_heavy(&placed, size, key(body.mass), &format!("leg {}", leg.number)));
            let Some(parameter) = body.inertia else { continue };
            let (inertia, at) = (leg.scalar(parameter), leg.span(parameter));
            let gyration = (inertia / mass).sqrt();
            if gyration > size {
                let what = format!(
                    "`{}` is {inertia}, which gives a radius of gyration of {} m, beyond leg {}",
                    key(parameter),
                    rounded(gyration),
                    leg.number
                );
                let (unit, factor) = likely_unit(inertia, mass, size);
                let help = format!("if that is in {unit}, write {}", rounded(inertia * factor));
                hints.push(Refusal::new(at, format!("in {unit}?"), what, help));
            }
        }
    }
    hints
}

/// Mass and inertia of the payload or of a part of it, compared with the platform's joints; `mass` and the trace of the
/// inertia with their places.
pub(crate) fn of_payload(mass: &Spanned<f64>, trace: &Spanned<f64>, legs: &[Leg; 6]) -> Vec<Refusal> {
    let farthest = legs.iter().map(|leg| leg.vector("platform_point").norm()).fold(0.0, f64::max);
    let size = 2.0 * farthest;
    if size == 0.0 {
        // Refused already.
        return Vec::new();
    }
    let mut hints: Vec<Refusal> = too_heavy(mass, size, "mass_kg", "the platform").into_iter().collect();
    // Half of the trace is the second moment about the centre of mass.
    let (mass, moment) = (*mass.get_ref(), 0.5 * trace.get_ref());
    let gyration = (moment / mass).sqrt();
    if gyration > 4.0 * size {
        let what = format!(
            "`inertia_kg_m2` gives a radius of gyration of {} m, beyond four times the platform's width",
            rounded(gyration)
        );
        let (unit, factor) = likely_unit(moment, mass, size);
        let help = format!("if that is in {unit}, multiply it by {factor:e}");
        hints.push(Refusal::new(trace.span(), format!("in {unit}?"), what, help));
    }
    hints
}

/// At most four digits, as a person would write it.
fn rounded(number: f64) -> f64 {
    format!("{number:.3e}").parse().unwrap_or(number)
}
