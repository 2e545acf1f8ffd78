//! From the text of a platform file to the resolved platform: which tables and keys there are, in what order they are
//! read, and what may be left out.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeTable;

use crate::checks::{self, Fault, LegAtHome};
use crate::document::{Reading, Section, nearest};
use crate::keys::{self, Key};
use crate::layout;
use crate::legs::{LegProperties, Legs};
use crate::parameters::{Matrix3, Parameters, Vector3};
use crate::platform::{LegType, Platform, Pose, VERSION};
use crate::refusal::Refusal;

const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Reads the whole file or returns every mistake in it.
pub(crate) fn read(text: &str) -> Result<Platform, Vec<Refusal>> {
    let document = DeTable::parse(text).map_err(|error| vec![syntax(&error, text)])?;
    let table = document.get_ref();
    if table.is_empty() {
        return Err(vec![empty(text)]);
    }
    let mut refusals = Vec::new();
    let file = Section::new("the file", first_line(text), table, &[keys::FILE], &mut refusals);
    let mut of_version = Vec::new();
    if file.require(&keys::VERSION, this_version, &mut of_version).is_none() && !of_version.is_empty() {
        // Another version may mean other keys: say nothing about them.
        return Err(of_version);
    }
    match platform(&file, &mut refusals) {
        Some(platform) if refusals.is_empty() => Ok(platform),
        _ => Err(refusals),
    }
}

fn platform(file: &Section, refusals: &mut Vec<Refusal>) -> Option<Platform> {
    let name = file.require(&keys::NAME, identifier, refusals);
    // For people who read the file; nothing computes with them.
    file.read(&keys::DESCRIPTION, checks::any::<String>, refusals);
    file.read(&keys::SOURCE, checks::any::<String>, refusals);
    let leg_type = file.require(&keys::LEG_TYPE, leg_type, refusals);
    let gravity = file.require(&keys::GRAVITY, checks::any, refusals);
    let home = file
        .require_section(&keys::HOME, &[keys::IN_HOME], refusals)
        .and_then(|section| home(&section, refusals));
    let payload = file
        .require_section(&keys::PAYLOAD, &[keys::IN_PAYLOAD], refusals)
        .and_then(|section| payload(&section, refusals));
    let free_layout = file.key_span(&keys::CIRCULAR_LAYOUT).is_none();
    let misspelt = file.has_misspelt(&keys::CIRCULAR_LAYOUT) || file.has_misspelt(&keys::LEG);
    if free_layout && file.key_span(&keys::LEG).is_none() && !misspelt {
        refusals.push(no_layout(file));
    }
    let legs = Legs::find(file, free_layout, refusals);
    let points =
        if free_layout { free_points(&legs, refusals) } else { circular_points(file, &legs, refusals) };
    let properties = legs.properties(refusals);

    let (home, points, properties) = (home?, points?, properties?);
    refusals.extend(out_of_reach(&home, &points, &properties));
    let payload = payload?;
    Some(Platform {
        name: name?.into_inner(),
        leg_type: leg_type?.into_inner(),
        home,
        parameters: Parameters {
            base_point: points.base,
            actuator_axis: properties.actuator_axis,
            platform_point: points.platform,
            rod_length: properties.rod_length.map(Spanned::into_inner),
            rod_mass: properties.rod_mass,
            rod_inertia: properties.rod_inertia,
            rod_com_fraction: properties.rod_com_fraction,
            mover_mass: properties.mover_mass,
            mover_offset: properties.mover_offset,
            rest_length: properties.rest_length,
            axial_stiffness: properties.axial_stiffness,
            axial_damping: properties.axial_damping,
            payload_mass: payload.mass,
            payload_com: payload.com,
            payload_inertia: payload.inertia,
            gravity: gravity?.into_inner(),
        },
    })
}

fn home(home: &Section, refusals: &mut Vec<Refusal>) -> Option<Pose> {
    let position = home.require(&keys::POSITION, checks::any, refusals);
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
    let mass = payload.require(&keys::PAYLOAD_MASS, checks::positive, refusals);
    let com = payload.require(&keys::PAYLOAD_COM, checks::any, refusals);
    let inertia = payload.require(&keys::PAYLOAD_INERTIA, checks::inertia, refusals);
    Some(Payload { mass: mass?.into_inner(), com: com?.into_inner(), inertia: inertia?.into_inner() })
}

/// The joints of all six legs.
struct JointPoints {
    base: [Vector3; 6],
    platform: [Vector3; 6],
}

fn free_points(legs: &Legs, refusals: &mut Vec<Refusal>) -> Option<JointPoints> {
    let base = legs.points(&keys::BASE_POINT, refusals);
    let platform = legs.points(&keys::PLATFORM_POINT, refusals);
    Some(JointPoints { base: base?, platform: platform? })
}

fn circular_points(file: &Section, legs: &Legs, refusals: &mut Vec<Refusal>) -> Option<JointPoints> {
    let circles = file.section(&keys::CIRCULAR_LAYOUT, &[keys::IN_CIRCULAR_LAYOUT], refusals)?;
    if let Some(at) = legs.any_point() {
        refusals.push(Refusal::new(
            at,
            "a point, although [circular_layout] is given",
            "two layouts: both [circular_layout] and a [[leg]] say where joints are",
            "remove [circular_layout] and give the points of all six legs, or remove the points",
        ));
    }
    let base_radius = circles.require(&keys::BASE_RADIUS, checks::positive, refusals);
    let platform_radius = circles.require(&keys::PLATFORM_RADIUS, checks::positive, refusals);
    let base_angle = circles.require(&keys::BASE_PAIR_ANGLE, checks::pair_angle, refusals);
    let platform_angle = circles.require(&keys::PLATFORM_PAIR_ANGLE, checks::pair_angle, refusals);
    Some(JointPoints {
        base: layout::circle(base_radius?.into_inner(), base_angle?.into_inner()),
        platform: layout::circle(platform_radius?.into_inner(), platform_angle?.into_inner()),
    })
}

/// Refuses rods that do not reach at home; legs that share one `rod_length_m` share one refusal.
fn out_of_reach(home: &Pose, points: &JointPoints, properties: &LegProperties) -> Vec<Refusal> {
    let mut places: Vec<(Range<usize>, Vec<LegAtHome>)> = Vec::new();
    for (leg, rod_length) in properties.rod_length.iter().enumerate() {
        let at_home = LegAtHome::new(
            leg + 1,
            home,
            points.base[leg],
            points.platform[leg],
            properties.actuator_axis[leg],
            *rod_length.get_ref(),
        );
        match places.iter_mut().find(|(span, _)| *span == rod_length.span()) {
            Some((_, legs)) => legs.push(at_home),
            None => places.push((rod_length.span(), vec![at_home])),
        }
    }
    let refusal = |(at, legs): (Range<usize>, Vec<LegAtHome>)| {
        let fault = checks::reach(&legs)?;
        Some(Refusal::new(at, fault.label, fault.what, fault.help))
    };
    places.into_iter().filter_map(refusal).collect()
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

/// The first line, to point at the file as a whole.
fn first_line(text: &str) -> Range<usize> {
    0..text.find(['\r', '\n']).unwrap_or(text.len())
}
