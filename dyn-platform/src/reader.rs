//! From the text of a platform file to the resolved platform: which tables and keys there are, in what order they are
//! read, and what may be left out.

use toml::Spanned;
use toml::de::DeTable;

use crate::checks::{self, Fault};
use crate::document::{Reading, Section};
use crate::keys::{self, Key};
use crate::layout;
use crate::leg_tables::LegTables;
use crate::legs::{self, JointPoints, Leg, Place};
use crate::limits::PlacedLimits;
use crate::parameters::{Matrix3, Parameters, Vector3};
use crate::platform::{LegType, Platform, Pose, VERSION};
use crate::refusal::Refusal;
use crate::text::{first_line, nearest};

const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Reads the whole file or returns every mistake in it.
pub(crate) fn read(text: &str) -> Result<Platform, Vec<Refusal>> {
    let document = DeTable::parse(text).map_err(|error| vec![syntax(&error, text)])?;
    let table = document.get_ref();
    if table.is_empty() {
        return Err(vec![empty(text)]);
    }
    let mut refusals = Vec::new();
    let file = Section::file(first_line(text), table);
    let mut of_version = Vec::new();
    if file.require(&keys::VERSION, this_version, &mut of_version).is_none() && !of_version.is_empty() {
        // Another version may mean other keys: say nothing about them.
        return Err(of_version);
    }
    match platform(file, &mut refusals) {
        Some(platform) if refusals.is_empty() => Ok(platform),
        _ => Err(refusals),
    }
}

fn platform(file: Section, refusals: &mut Vec<Refusal>) -> Option<Platform> {
    let leg_type = file.require(&keys::LEG_TYPE, leg_type, refusals).map(Spanned::into_inner);
    let file = &file.of_leg_type(leg_type, refusals);
    let name = file.require(&keys::NAME, identifier, refusals);
    // For people who read the file; nothing computes with them.
    file.read(&keys::DESCRIPTION, checks::any::<String>, refusals);
    file.read(&keys::SOURCE, checks::any::<String>, refusals);
    let gravity = file.require(&keys::GRAVITY, checks::vector, refusals);
    let home = file
        .require_section(&keys::HOME, keys::IN_HOME, refusals)
        .and_then(|section| home(&section, refusals));
    let payload = file
        .require_section(&keys::PAYLOAD, keys::IN_PAYLOAD, refusals)
        .and_then(|section| payload(&section, refusals));
    let free_layout = file.key_span(&keys::CIRCULAR_LAYOUT).is_none();
    let misspelt = file.has_misspelt(&keys::CIRCULAR_LAYOUT) || file.has_misspelt(&keys::LEG);
    if free_layout && file.key_span(&keys::LEG).is_none() && !misspelt {
        refusals.push(no_layout(file));
    }
    let tables = LegTables::find(file, free_layout, refusals);
    let points = if free_layout {
        free_points(&tables, leg_type, refusals)
    } else {
        circular_points(file, &tables, refusals)
    };
    let limits = PlacedLimits::read(&tables, refusals);

    let (kind, leg_type) = (legs::kind(leg_type?), leg_type?);
    let legs = tables.legs(kind, home.as_ref(), points.as_ref(), refusals)?;
    let unfit = (kind.at_home)(&legs);
    if unfit.is_empty() {
        limits.refuse_home_outside(&legs.each_ref().map(kind.geometry), refusals);
    }
    refusals.extend(unfit);
    let (payload, gravity) = (payload?, gravity?.into_inner());
    Some(Platform {
        name: name?.into_inner(),
        leg_type,
        home: home?,
        parameters: parameters(leg_type, &legs, payload, gravity),
        limits: limits.limits(),
    })
}

fn parameters(leg_type: LegType, legs: &[Leg; 6], payload: Payload, gravity: Vector3) -> Parameters {
    let mut parameters = Parameters::zero(leg_type);
    for property in legs::kind(leg_type).properties {
        let name = property.parameter.name;
        let place = parameters.get_mut(name).expect("every parameter of the leg type has a place");
        let width = place.len() / 6;
        for (numbers, leg) in place.chunks_mut(width).zip(legs) {
            numbers.copy_from_slice(leg.value(name).get_ref());
        }
    }
    parameters.payload_mass = payload.mass;
    parameters.payload_com = payload.com;
    parameters.payload_inertia = payload.inertia;
    parameters.gravity = gravity;
    parameters
}

fn home(home: &Section, refusals: &mut Vec<Refusal>) -> Option<Pose> {
    let position = home.require(&keys::POSITION, checks::vector, refusals);
    let rotation = match home.read(&keys::ROTATION, checks::rotation, refusals) {
        Reading::Absent => Some(IDENTITY),
        reading => reading.present().map(Spanned::into_inner),
    };
    Some(Pose { position: position?.into_inner(), rotation: rotation? })
}

struct Payload {
    mass: f64,
    com: Vector3,
    inertia: Matrix3,
}

fn payload(payload: &Section, refusals: &mut Vec<Refusal>) -> Option<Payload> {
    let mass = payload.require(&keys::PAYLOAD_MASS, checks::number, refusals);
    let com = payload.require(&keys::PAYLOAD_COM, checks::vector, refusals);
    let inertia = payload.require(&keys::PAYLOAD_INERTIA, checks::inertia, refusals);
    Some(Payload { mass: mass?.into_inner(), com: com?.into_inner(), inertia: inertia?.into_inner() })
}

fn free_points(
    tables: &LegTables,
    leg_type: Option<LegType>,
    refusals: &mut Vec<Refusal>,
) -> Option<JointPoints> {
    let (mut base, mut platform) = (None, None);
    for property in legs::kind(leg_type?).joints() {
        let points = tables.points(property, refusals);
        match property.place {
            Place::BaseJoint => base = points,
            _ => platform = points,
        }
    }
    Some(JointPoints { base: base?, platform: platform? })
}

fn circular_points(file: &Section, tables: &LegTables, refusals: &mut Vec<Refusal>) -> Option<JointPoints> {
    let circles = file.section(&keys::CIRCULAR_LAYOUT, keys::IN_CIRCULAR_LAYOUT, refusals)?;
    if let Some(at) = tables.any_point(file.leg_type()) {
        refusals.push(Refusal::new(
            at,
            "a point, although [circular_layout] is given",
            "two layouts: both [circular_layout] and a [[leg]] say where joints are",
            "remove [circular_layout] and give the points of all six legs, or remove the points",
        ));
    }
    let mut read = |key: &Key| circles.require(key, checks::number, refusals);
    let (base_radius, platform_radius) = (read(&keys::BASE_RADIUS), read(&keys::PLATFORM_RADIUS));
    let (base_angle, platform_angle) = (read(&keys::BASE_PAIR_ANGLE), read(&keys::PLATFORM_PAIR_ANGLE));
    let circle = |radius: Spanned<f64>, angle: Spanned<f64>| {
        let at = radius.span();
        layout::circle(radius.into_inner(), angle.into_inner()).map(|point| Spanned::new(at.clone(), point))
    };
    Some(JointPoints {
        base: circle(base_radius?, base_angle?),
        platform: circle(platform_radius?, platform_angle?),
    })
}

fn this_version(version: i64, key: &Key) -> Result<i64, Fault> {
    if version == i64::from(VERSION) {
        return Ok(version);
    }
    Err(Fault::new(
        format!("must be {VERSION}"),
        format!("the file has format version {version}, this reader knows version {VERSION} only"),
        format!(
            "write `{}` and bring the file into the form of docs/platform-file.md, or use the reader that knows \
             version {version}",
            key.example
        ),
    ))
}

/// Lower-case words that Rust keeps for itself, strict and reserved keywords of edition 2024.
const KEYWORDS: [&str; 51] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual",
    "where", "while", "yield",
];

/// Generated modules are called by the platform's name.
fn identifier(name: String, key: &Key) -> Result<String, Fault> {
    let lower = |letter: char| letter.is_ascii_lowercase();
    let inside = |letter: char| lower(letter) || letter.is_ascii_digit() || letter == '_';
    if KEYWORDS.contains(&name.as_str()) {
        return Err(Fault::new(
            "a keyword of Rust",
            format!("`{}` is {name:?}, a keyword of Rust, which cannot name a generated module", key.name),
            format!("choose another word, for example `{} = \"{name}_platform\"`", key.name),
        ));
    }
    if name.starts_with(lower) && name.chars().all(inside) {
        return Ok(name);
    }
    Err(Fault::new(
        "cannot name a module",
        format!("`{}` is {name:?}, which cannot name a generated module", key.name),
        format!("use lower-case letters, digits and underscores, a letter first: `{}`", key.example),
    ))
}

fn leg_type(written: String, key: &Key) -> Result<LegType, Fault> {
    let names = LegType::ALL.map(LegType::name);
    if let Some(leg_type) = LegType::ALL.into_iter().find(|leg_type| leg_type.name() == written) {
        return Ok(leg_type);
    }
    let help = match nearest(&written, names) {
        Some(nearest) => format!("did you mean {nearest:?}?"),
        None => format!("leg types known here: {}", names.join(", ")),
    };
    Err(Fault::new("unknown leg type", format!("`{}` {written:?} is unknown", key.name), help))
}

fn syntax(error: &toml::de::Error, text: &str) -> Refusal {
    Refusal::new(
        error.span().unwrap_or_else(|| first_line(text)),
        "here",
        format!("this is not TOML: {}", error.message()),
        "mend the syntax; https://toml.io describes it, platforms/uhp_2016.toml is an example",
    )
}

fn empty(text: &str) -> Refusal {
    Refusal::new(
        first_line(text),
        "no key in this file",
        "the platform file is empty",
        "start from a copy of platforms/uhp_2016.toml; docs/platform-file.md describes the format",
    )
}

fn no_layout(file: &Section) -> Refusal {
    Refusal::new(
        file.header.clone(),
        "no joint points in this file",
        "there is no layout: nothing says where the joints are",
        "give [circular_layout], or six [[leg]] tables with `base_point_m` and `platform_point_m`",
    )
}
