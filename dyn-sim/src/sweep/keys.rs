//! Numbers in TOML files, by paths such as `payload.mass_kg`, `payload.com_m.2` or `leg.0.rod_length_m`.

use dyn_platform::nearest;
use toml::{Table, Value};

/// The number at a path.
pub(super) fn number(document: &Table, path: &str) -> Option<f64> {
    match value(document, path)? {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}

fn value<'d>(document: &'d Table, path: &str) -> Option<&'d Value> {
    let (first, rest) = split(path);
    let mut value = document.get(first)?;
    for key in rest {
        value = match value {
            Value::Array(values) => values.get(key.parse::<usize>().ok()?)?,
            Value::Table(table) => table.get(key)?,
            _ => return None,
        };
    }
    Some(value)
}

/// Puts a number where one is; elsewhere nothing changes.
pub(super) fn put(document: &mut Table, path: &str, number: f64) {
    let (first, rest) = split(path);
    let mut place = document.get_mut(first);
    for key in rest {
        place = match place {
            Some(Value::Array(values)) => key.parse::<usize>().ok().and_then(|k| values.get_mut(k)),
            Some(Value::Table(table)) => table.get_mut(key),
            _ => None,
        };
    }
    if let Some(place) = place {
        *place = Value::Float(number);
    }
}

fn split(path: &str) -> (&str, impl Iterator<Item = &str>) {
    let mut keys = path.split('.');
    (keys.next().unwrap_or_default(), keys)
}

/// What may be meant by a path at which there is no number.
pub(super) fn remedy(document: &Table, path: &str) -> String {
    let mut known = Vec::new();
    for (key, value) in document {
        collect(key, value, &mut known);
    }
    match nearest(path, known.iter().map(String::as_str)) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("a number must stand there already; known here: {}", known.join(", ")),
    }
}

fn collect(path: &str, value: &Value, known: &mut Vec<String>) {
    match value {
        Value::Float(_) | Value::Integer(_) if path != "version" => known.push(path.to_owned()),
        Value::Array(values) => {
            for (k, value) in values.iter().enumerate() {
                collect(&format!("{path}.{k}"), value, known);
            }
        }
        Value::Table(table) => {
            for (key, value) in table {
                collect(&format!("{path}.{key}"), value, known);
            }
        }
        _ => {}
    }
}
