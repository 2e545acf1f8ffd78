//! The payload: one rigid body, or several rigid parts that are summed.

use nalgebra::{Matrix3 as Matrix, Vector3 as Vector};
use toml::Spanned;

use crate::checks::{self, from_rows, to_rows};
use crate::document::{Reading, Section};
use crate::findings::Findings;
use crate::keys::{self, Key};
use crate::parameters::{Matrix3, Vector3};
use crate::refusal::Refusal;

/// The payload.
pub(crate) struct Payload {
    /// All of it.
    pub whole: Body,
    /// What it was made from in the file.
    pub bodies: Vec<PlacedBody>,
}

/// A rigid body.
#[derive(Clone, Copy)]
pub(crate) struct Body {
    /// kg.
    pub mass: f64,
    /// m, P.
    pub com: Vector3,
    /// About the centre of mass, kg m^2, P.
    pub inertia: Matrix3,
}

/// A rigid body as it stands in the file.
pub(crate) struct PlacedBody {
    /// kg.
    pub mass: Spanned<f64>,
    /// The sum of its principal moments, kg m^2.
    pub trace: Spanned<f64>,
    /// In platform axes.
    body: Body,
}

/// The keys of a body: those of `[payload]` or of one of its parts.
struct BodyKeys {
    mass: &'static Key,
    com: &'static Key,
    inertia: &'static Key,
}

const WHOLE: BodyKeys =
    BodyKeys { mass: &keys::PAYLOAD_MASS, com: &keys::PAYLOAD_COM, inertia: &keys::PAYLOAD_INERTIA };

const PART: BodyKeys =
    BodyKeys { mass: &keys::PART_MASS, com: &keys::PART_COM, inertia: &keys::PART_INERTIA };

/// The payload of `[payload]`, summed if it has parts.
pub(crate) fn payload(section: &Section, findings: &mut Findings) -> Option<Payload> {
    let as_a_whole = [WHOLE.mass, WHOLE.com, WHOLE.inertia];
    let Some(parts_at) = section.key_span(&keys::PART) else {
        let nothing = as_a_whole.iter().all(|key| section.key_span(key).is_none());
        if nothing && section.has_misspelt(&keys::PART) {
            return None;
        }
        let body = body(section, &WHOLE, findings)?;
        return Some(Payload { whole: body.body, bodies: vec![body] });
    };
    let mixed = as_a_whole.into_iter().find_map(|key| Some((key, section.key_span(key)?)));
    if let Some((key, at)) = mixed {
        findings.refuse(Refusal::new(
            at,
            "of the payload as a whole",
            format!("two payloads: [payload] has both `{}` and [[payload.part]] tables", key.name),
            "remove the parts, or turn these numbers into a part of their own",
        ));
    }
    let parts = section.sections("[[payload.part]]", &keys::PART, keys::IN_PART.keys, findings)?;
    if parts.is_empty() {
        let what = "the payload has no parts";
        let help = "give `mass_kg`, `com_m` and `inertia_kg_m2`, or add [[payload.part]] tables";
        findings.refuse(Refusal::new(parts_at, "empty", what, help));
        return None;
    }
    let parts: Vec<Option<PlacedBody>> =
        parts.into_iter().enumerate().map(|(index, section)| part(index + 1, section, findings)).collect();
    let bodies = parts.into_iter().collect::<Option<Vec<_>>>()?;
    Some(Payload { whole: sum(&bodies), bodies })
}

fn body(section: &Section, keys: &BodyKeys, findings: &mut Findings) -> Option<PlacedBody> {
    let mass = section.require(keys.mass, checks::number, findings);
    let com = section.require(keys.com, checks::vector, findings);
    let inertia = section.require(keys.inertia, checks::inertia, findings);
    let (mass, com, inertia) = (mass?, com?.into_inner(), inertia?);
    let trace = Spanned::new(inertia.span(), from_rows(*inertia.get_ref()).trace());
    let body = Body { mass: *mass.get_ref(), com, inertia: inertia.into_inner() };
    Some(PlacedBody { mass, trace, body })
}

/// One part, its inertia turned into platform axes.
fn part(number: usize, mut section: Section, findings: &mut Findings) -> Option<PlacedBody> {
    section.title = format!("part {number} of the payload");
    // For people who read the file.
    section.read(&keys::PART_NAME, checks::any::<String>, findings);
    let part = body(&section, &PART, findings);
    let rotation = section.read(&keys::PART_ROTATION, checks::rotation, findings);
    let mut part = part?;
    match rotation {
        Reading::Absent => {}
        reading => {
            let rotation = from_rows(reading.present().map(Spanned::into_inner)?);
            part.body.inertia = to_rows(rotation * from_rows(part.body.inertia) * rotation.transpose());
        }
    }
    Some(part)
}

/// The rigid body that the parts make together: `I_c = sum I_k + m_k (r.r 1 - r r^T)`, `r` from the common centre of mass
/// to that of part `k`.
fn sum(parts: &[PlacedBody]) -> Body {
    let bodies = || parts.iter().map(|part| &part.body);
    let mass: f64 = bodies().map(|body| body.mass).sum();
    let com = bodies().fold(Vector::zeros(), |sum, body| sum + Vector::from(body.com) * (body.mass / mass));
    let inertia = bodies().fold(Matrix::zeros(), |sum, body| {
        let r = Vector::from(body.com) - com;
        sum + from_rows(body.inertia) + (Matrix::identity() * r.dot(&r) - r * r.transpose()) * body.mass
    });
    // Symmetric to the last digit, as a payload given as one body is.
    let symmetric = Matrix::from_fn(|i, j| inertia[(i.min(j), i.max(j))]);
    Body { mass, com: com.into(), inertia: to_rows(symmetric) }
}
