//! States out of a file of vectors, or of one without outputs. Every mistake is named by its place in the file.

use dyn_platform::nearest;
use serde_json::{Map, Value};

use super::VERSION;
use crate::graph::Environment;

/// Why a file of states is refused.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error, miette::Diagnostic)]
#[error("{place}: {problem}")]
#[diagnostic(help("{remedy}"))]
pub struct StatesError {
    /// Where: a path such as `cases[2].base.rotation`, or line and column.
    pub place: String,
    /// What is wrong.
    pub problem: String,
    /// What to do about it.
    pub remedy: String,
}

/// What a file of states holds.
#[derive(Clone, PartialEq, Debug)]
pub struct StatesFile {
    /// The states: every input of the functions by name, flat.
    pub states: Vec<Environment>,
    /// The numbers of a platform that the file carries, if it does.
    pub platform: Option<Value>,
}

/// Largest deviation of R R^T from 1 in a rotation: what six digits leave.
const ROTATION_TOLERANCE: f64 = 1e-5;

/// Where to look when something is wrong with the format.
const FORMAT: &str = "docs/vectors.md describes the format; `dyn-gen vectors PLATFORM.toml -n 1 -o example.json` writes an example";

type Read<T> = Result<T, StatesError>;

fn refuse<T>(place: &str, problem: impl Into<String>, remedy: impl Into<String>) -> Read<T> {
    Err(StatesError { place: place.to_owned(), problem: problem.into(), remedy: remedy.into() })
}

/// Reads the text of a file of states.
///
/// # Errors
/// The first mistake in it.
pub fn read_states(text: &str) -> Read<StatesFile> {
    let value: Value = serde_json::from_str(text).map_err(|error| StatesError {
        place: format!("line {}, column {}", error.line(), error.column()),
        problem: format!(
            "this is not JSON: {}",
            error.to_string().split(" at line ").next().unwrap_or_default()
        ),
        remedy: FORMAT.into(),
    })?;
    let file = object(&value, "the file", &["version", "platform", "cases"])?;
    match required(file, "the file", "version")? {
        version if version.as_u64() == Some(VERSION.into()) => {}
        other => {
            return refuse(
                "version",
                format!("the file has version {other}, this reader knows version {VERSION}"),
                FORMAT,
            );
        }
    }
    let Value::Array(cases) = required(file, "the file", "cases")? else {
        return refuse("cases", "this is not an array", FORMAT);
    };
    if cases.is_empty() {
        return refuse("cases", "there are no cases", FORMAT);
    }
    let states =
        cases.iter().enumerate().map(|(k, case)| state(case, &format!("cases[{k}]"))).collect::<Read<_>>()?;
    Ok(StatesFile { states, platform: file.get("platform").cloned() })
}

fn state(case: &Value, place: &str) -> Read<Environment> {
    let known = ["base", "platform", "actuator_force", "external_wrench", "reference_velocity", "outputs"];
    let case = object(case, place, &known)?;
    let mut state = Environment::new();
    for body in ["base", "platform"] {
        let at = format!("{place}.{body}");
        let parts =
            object(required(case, place, body)?, &at, &["position", "rotation", "velocity", "acceleration"])?;
        for (part, length) in [("position", 3), ("velocity", 6), ("acceleration", 6)] {
            let values = numbers(required(parts, &at, part)?, &format!("{at}.{part}"), length)?;
            state.insert(format!("{body}_{part}"), values);
        }
        let rotation = rotation(required(parts, &at, "rotation")?, &format!("{at}.rotation"))?;
        state.insert(format!("{body}_rotation"), rotation);
    }
    for load in ["actuator_force", "external_wrench"] {
        state.insert(load.into(), numbers(required(case, place, load)?, &format!("{place}.{load}"), 6)?);
    }
    let reference = match case.get("reference_velocity") {
        Some(given) => numbers(given, &format!("{place}.reference_velocity"), 6)?,
        None => state["platform_velocity"].clone(),
    };
    state.insert("reference_velocity".into(), reference);
    Ok(state)
}

fn object<'a>(value: &'a Value, place: &str, known: &[&str]) -> Read<&'a Map<String, Value>> {
    let Value::Object(members) = value else { return refuse(place, "this is not an object", FORMAT) };
    match members.keys().find(|key| !known.contains(&key.as_str())) {
        None => Ok(members),
        Some(key) => {
            let remedy = match nearest(key, known.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("known here: {}", known.join(", ")),
            };
            refuse(place, format!("unknown key `{key}`"), remedy)
        }
    }
}

fn required<'a>(members: &'a Map<String, Value>, place: &str, key: &str) -> Read<&'a Value> {
    match members.get(key) {
        Some(value) => Ok(value),
        None => refuse(place, format!("`{key}` is missing"), FORMAT),
    }
}

fn numbers(value: &Value, place: &str, length: usize) -> Read<Vec<f64>> {
    let remedy = || format!("give {length} numbers in SI units");
    let Value::Array(elements) = value else { return refuse(place, "this is not an array", remedy()) };
    if elements.len() != length {
        return refuse(place, format!("{} elements instead of {length}", elements.len()), remedy());
    }
    let element = |(k, element): (usize, &Value)| match element.as_f64().filter(|number| number.is_finite()) {
        Some(number) => Ok(number),
        None => refuse(&format!("{place}[{k}]"), format!("{element} is not a finite number"), remedy()),
    };
    elements.iter().enumerate().map(element).collect()
}

fn rotation(value: &Value, place: &str) -> Read<Vec<f64>> {
    const REMEDY: &str = "give three rows of three numbers that take body coordinates to inertial ones: rows are unit vectors at \
                          right angles, the determinant is +1";
    let rows = match value {
        Value::Array(rows) if rows.len() == 3 => rows,
        _ => return refuse(place, "this is not an array of three rows", REMEDY),
    };
    let mut matrix = Vec::with_capacity(9);
    for (k, row) in rows.iter().enumerate() {
        matrix.extend(numbers(row, &format!("{place}[{k}]"), 3)?);
    }
    let matrix3 = nalgebra::Matrix3::from_row_slice(&matrix);
    let deviation = (matrix3 * matrix3.transpose() - nalgebra::Matrix3::identity()).amax();
    if deviation.is_nan() || deviation > ROTATION_TOLERANCE {
        let problem = format!("this is not a rotation: R R^T differs from 1 by {deviation:.1e}");
        return refuse(place, problem, REMEDY);
    }
    if matrix3.determinant() < 0.0 {
        return refuse(place, "this is a reflection, not a rotation: its determinant is -1", REMEDY);
    }
    Ok(matrix)
}
