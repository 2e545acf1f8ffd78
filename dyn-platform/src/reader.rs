//! From the text of a platform file to the resolved platform: which tables and keys there are, in what order they are
//! read, and what may be left out.

use toml::Spanned;
use toml::de::DeTable;

use crate::assembly;
use crate::checks::{self, Fault};
use crate::document::{Reading, Section};
use crate::findings::Findings;
use crate::keys::{self, Key};
use crate::layout;
use crate::leg_tables::LegTables;
use crate::legs::{self, Layout, Leg, Place};
use crate::limits::PlacedLimits;
use crate::parameters::{Matrix3, Parameters, Vector3};
use crate::payload::{Body, payload};
use crate::platform::{LegType, Platform, Pose};
use crate::refusal::Refusal;
use crate::text::{first_line, nearest};
use crate::units;
use crate::versions;

const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Reads the whole file, with hints at what looks odd in it, or returns every mistake in it.
pub(crate) fn read(text: &str) -> Result<(Platform, Vec<Refusal>), Vec<Refusal>> {
    let document = DeTable::parse(text).map_err(|error| vec![syntax(&error, text)])?;
    let table = document.get_ref();
    if table.is_empty() {
        return Err(vec![empty(text)]);
    }
    let file = Section::file(first_line(text), table);
    let mut of_version = Findings::default();
    if file.require(&keys::VERSION, versions::today, &mut of_version).is_none() && !of_version.is_clean() {
        // Another version may mean other keys: say nothing about them.
        return Err(of_version.into_refusals());
    }
    let mut findings = Findings::default();
    match platform(file, &mut findings) {
        Some(platform) if findings.is_clean() => Ok((platform, findings.into_hints())),
        _ => Err(findings.into_refusals()),
    }
}

fn platform(file: Section, findings: &mut Findings) -> Option<Platform> {
    let leg_type = file.require(&keys::LEG_TYPE, leg_type, findings).map(Spanned::into_inner);
    let file = &file.of_leg_type(leg_type, findings);
    let name = file.require(&keys::NAME, identifier, findings);
    // For people who read the file; nothing computes with them.
    file.read(&keys::DESCRIPTION, checks::any::<String>, findings);
    file.read(&keys::SOURCE, checks::any::<String>, findings);
    let gravity = file.require(&keys::GRAVITY, checks::vector, findings);
    let home = file
        .require_section(&keys::HOME, keys::IN_HOME.keys, findings)
        .and_then(|section| home(&section, findings));
    let payload = file
        .require_section(&keys::PAYLOAD, keys::IN_PAYLOAD.keys, findings)
        .and_then(|section| payload(&section, findings));
    let free_layout = file.key_span(&keys::CIRCULAR_LAYOUT).is_none();
    let misspelt = file.has_misspelt(&keys::CIRCULAR_LAYOUT) || file.has_misspelt(&keys::LEG);
    if free_layout && file.key_span(&keys::LEG).is_none() && !misspelt {
        findings.refuse(no_layout(file));
    }
    let tables = LegTables::find(file, free_layout, findings);
    let layout = if free_layout {
        free_layout_of(&tables, leg_type, home.as_ref(), findings)
    } else {
        circular_layout_of(file, &tables, findings)
    };
    let limits = PlacedLimits::read(&tables, findings);

    let (kind, leg_type) = (legs::kind(leg_type?), leg_type?);
    let pose = home.as_ref().map(Spanned::get_ref);
    let legs = tables.legs(kind, pose, layout.as_ref(), findings)?;
    findings.begin_assembly();
    let unfit = (kind.at_home)(&legs);
    if unfit.is_empty() {
        let at_home = legs.each_ref().map(kind.geometry);
        limits.refuse_home_outside(&at_home, findings);
        if let Some(Layout { remedy, .. }) = &layout {
            assembly::refuse_loose(&legs, &at_home, remedy.span(), remedy.get_ref(), findings);
        }
    }
    // A leg that does not fit has no size with which to compare its bodies.
    let hints = if unfit.is_empty() { units::of_legs(kind, &legs) } else { Vec::new() };
    hints.into_iter().for_each(|hint| findings.hint(hint));
    findings.refuse_all(unfit);
    let (payload, gravity) = (payload?, gravity?.into_inner());
    for hint in payload.bodies.iter().flat_map(|body| units::of_payload(&body.mass, &body.trace, &legs)) {
        findings.hint(hint);
    }
    Some(Platform {
        name: name?.into_inner(),
        leg_type,
        home: *pose?,
        parameters: parameters(leg_type, &legs, &payload.whole, gravity),
        limits: limits.limits(),
        warnings: Vec::new(),
    })
}

fn parameters(leg_type: LegType, legs: &[Leg; 6], payload: &Body, gravity: Vector3) -> Parameters {
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

/// The home pose, at the place of its position.
fn home(home: &Section, findings: &mut Findings) -> Option<Spanned<Pose>> {
    let position = home.require(&keys::POSITION, checks::vector, findings);
    let rotation = match home.read(&keys::ROTATION, checks::rotation, findings) {
        Reading::Absent => Some(IDENTITY),
        reading => reading.present().map(Spanned::into_inner),
    };
    let position = position?;
    let at = position.span();
    Some(Spanned::new(at, Pose { position: position.into_inner(), rotation: rotation? }))
}

fn free_layout_of(
    tables: &LegTables,
    leg_type: Option<LegType>,
    home: Option<&Spanned<Pose>>,
    findings: &mut Findings,
) -> Option<Layout> {
    let (mut base, mut platform) = (None, None);
    for property in legs::kind(leg_type?).joints() {
        let points = tables.points(property, findings);
        match property.place {
            Place::BaseJoint => base = points,
            _ => platform = points,
        }
    }
    let remedy = Spanned::new(home?.span(), "move the joints of these legs, or the home pose".into());
    Some(Layout { base: base?, platform: platform?, remedy })
}

fn circular_layout_of(file: &Section, tables: &LegTables, findings: &mut Findings) -> Option<Layout> {
    let circles = file.section(&keys::CIRCULAR_LAYOUT, keys::IN_CIRCULAR_LAYOUT.keys, findings)?;
    if let Some(at) = tables.any_point(file.leg_type()) {
        findings.refuse(Refusal::new(
            at,
            "a point, although [circular_layout] is given",
            "two layouts: both [circular_layout] and a [[leg]] say where joints are",
            "remove [circular_layout] and give the points of all six legs, or remove the points",
        ));
    }
    let mut read = |key: &Key| circles.require(key, checks::number, findings);
    let (base_radius, platform_radius) = (read(&keys::BASE_RADIUS), read(&keys::PLATFORM_RADIUS));
    let (base_angle, platform_angle) = (read(&keys::BASE_PAIR_ANGLE), read(&keys::PLATFORM_PAIR_ANGLE));
    let (base_angle, platform_angle) = (base_angle?, platform_angle?);
    let remedy = if (base_angle.get_ref() - platform_angle.get_ref()).abs() < 1e-3 {
        "make `base_pair_angle_rad` and `platform_pair_angle_rad` differ: with equal ones every leg is in a plane with \
         the z axis"
    } else {
        "change a radius, a pair angle or the home pose"
    };
    let remedy = Spanned::new(platform_angle.span(), remedy.into());
    let circle = |radius: Spanned<f64>, angle: f64| {
        let at = radius.span();
        layout::circle(radius.into_inner(), angle).map(|point| Spanned::new(at.clone(), point))
    };
    Some(Layout {
        base: circle(base_radius?, base_angle.into_inner()),
        platform: circle(platform_radius?, platform_angle.into_inner()),
        remedy,
    })
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
        "mend the syntax; https://toml.io describes it, `dyn-gen init` prints an example",
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
