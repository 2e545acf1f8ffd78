//! The JSON schema of the platform file, for editors; made from the tables of keys.
//!
//! It knows spelling, types, bounds of single numbers and which keys go together. What takes arithmetic (rotations,
//! inertia tensors, legs that reach) only the reader checks.

use std::f64::consts::{PI, TAU};

use serde_json::{Map, Value as Json, json};

use crate::keys::{self, Key, Range, Table, Value};
use crate::legs::{self, LegKind};
use crate::platform::{LegType, VERSION};

/// The JSON schema (draft 7) of platform files, as TOML read into JSON.
///
/// Editors complete and check platform files with it; [`Platform::from_toml`](crate::Platform::from_toml) checks more.
pub fn schema() -> Json {
    let mut tables = Map::new();
    tables.insert(keys::HOME.name.into(), closed(keys::IN_HOME.keys, keys::IN_HOME.needed));
    let circles = closed(keys::IN_CIRCULAR_LAYOUT.keys, keys::IN_CIRCULAR_LAYOUT.needed);
    tables.insert(keys::CIRCULAR_LAYOUT.name.into(), circles);
    tables.insert(keys::PAYLOAD.name.into(), payload());
    let mut schema = closed(keys::FILE.keys, keys::FILE.needed);
    for (name, table) in tables {
        let described = &mut schema["properties"][&name];
        let description = described["description"].take();
        *described = table;
        described["description"] = description;
    }
    schema["$schema"] = "http://json-schema.org/draft-07/schema#".into();
    schema["title"] = format!("Platform file of dyn-gen, version {VERSION}").into();
    let mut rules = vec![layouts()];
    rules.extend(legs::kinds(None).map(legs_of_type));
    schema["allOf"] = rules.into();
    schema
}

/// A table in which only these keys may stand.
fn closed(keys: &[&Key], needed: &[&Key]) -> Json {
    let properties: Map<String, Json> = keys.iter().map(|key| (key.name.into(), property(key))).collect();
    json!({
        "type": "object",
        "additionalProperties": false,
        "properties": properties,
        "required": names(needed),
    })
}

fn names(keys: &[&Key]) -> Vec<&'static str> {
    keys.iter().map(|key| key.name).collect()
}

/// One body, or parts.
fn payload() -> Json {
    let Table { keys, needed, .. } = keys::IN_PAYLOAD;
    let mut table = closed(keys, &[]);
    let part = closed(keys::IN_PART.keys, keys::IN_PART.needed);
    table["properties"][keys::PART.name]["items"] = part;
    table["properties"][keys::PART.name]["minItems"] = 1.into();
    let absent = json!({ "not": { "anyOf": needed.iter().map(|key| json!({ "required": [key.name] })).collect::<Vec<_>>() } });
    table["if"] = json!({ "required": [keys::PART.name] });
    table["then"] = absent;
    table["else"] = json!({ "required": names(needed) });
    table
}

/// Joints on circles, or in a table for each of six legs.
fn layouts() -> Json {
    let joints: Vec<&str> = legs::kinds(None).flat_map(LegKind::joints).map(|joint| joint.key.name).collect();
    let of_joint = |name: &&str| json!({ "required": [name] });
    let without_joints = json!({ "not": { "anyOf": joints.iter().map(of_joint).collect::<Vec<_>>() } });
    let with_joints = json!({ "allOf": joints.iter().map(of_joint).collect::<Vec<_>>() });
    json!({
        "if": { "required": [keys::CIRCULAR_LAYOUT.name] },
        "then": { "properties": { (keys::LEG.name): { "items": without_joints } } },
        "else": {
            "required": [keys::LEG.name],
            "properties": { (keys::LEG.name): { "minItems": 6, "items": with_joints } },
        },
    })
}

/// Keys of legs of one type. That each leg has each property, here or there, only the reader checks.
fn legs_of_type(kind: &LegKind) -> Json {
    let leg_type = Some(kind.leg_type);
    let shared = keys::in_legs(leg_type);
    let in_leg = [keys::only_in_leg(leg_type), shared.clone()].concat();
    json!({
        "if": { "properties": { (keys::LEG_TYPE.name): { "const": kind.leg_type.name() } } },
        "then": {
            "properties": {
                (keys::LEGS.name): closed(&shared, &[]),
                (keys::LEG.name): { "maxItems": 6, "items": closed(&in_leg, &[&keys::LEG_NUMBER]) },
            },
        },
    })
}

fn property(key: &Key) -> Json {
    let mut schema = value(key.value);
    schema["description"] = format!("{}; for example `{}`", key.meaning, key.example).into();
    schema
}

fn value(value: Value) -> Json {
    let row = || json!({ "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 });
    match value {
        Value::Version => json!({ "const": VERSION }),
        Value::Text => json!({ "type": "string" }),
        Value::Name => json!({ "type": "string", "pattern": "^[a-z][a-z0-9_]*$" }),
        Value::LegType => json!({ "enum": LegType::ALL.map(LegType::name) }),
        Value::LegNumber => json!({ "type": "integer", "minimum": 1, "maximum": 6 }),
        Value::Number(range) => number(range),
        Value::Vector | Value::UnitVector => row(),
        Value::Rotation | Value::Inertia => {
            json!({ "type": "array", "items": row(), "minItems": 3, "maxItems": 3 })
        }
        Value::Table => json!({ "type": "object" }),
        Value::Tables => json!({ "type": "array", "items": { "type": "object" } }),
    }
}

fn number(range: Range) -> Json {
    match range {
        Range::Any => json!({ "type": "number" }),
        Range::Positive => json!({ "type": "number", "exclusiveMinimum": 0 }),
        Range::NotNegative => json!({ "type": "number", "minimum": 0 }),
        Range::Fraction => json!({ "type": "number", "minimum": 0, "maximum": 1 }),
        Range::PairAngle => json!({ "type": "number", "minimum": 0, "exclusiveMaximum": TAU }),
        Range::JointAngle => json!({ "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": PI }),
    }
}
