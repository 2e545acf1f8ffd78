//! Vectors to text: one case a line.

use dyn_platform::Platform;
use serde_json::{Map, Value, json};

use super::VERSION;
use crate::graph::Environment;

/// The file.
pub fn file(platform: &Platform, cases: &[Value]) -> serde_json::Result<String> {
    let lines = cases.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>()?;
    let platform = serde_json::to_string(platform)?;
    Ok(format!(
        "{{\"version\":{VERSION},\n\"platform\":{platform},\n\"cases\":[\n{}\n]}}\n",
        lines.join(",\n")
    ))
}

/// One case.
pub fn case(state: &Environment, outputs: &[(String, Value)]) -> Value {
    let part = |name: String| {
        let values = state.get(&name).map_or(&[][..], Vec::as_slice);
        if name.ends_with("_rotation") { nested(values, &[3, 3]) } else { json!(values) }
    };
    let body = |body: &str| {
        let parts = ["position", "rotation", "velocity", "acceleration"];
        Value::Object(
            parts.map(|name| (name.to_owned(), part(format!("{body}_{name}")))).into_iter().collect(),
        )
    };
    json!({
        "base": body("base"),
        "platform": body("platform"),
        "actuator_force": part("actuator_force".into()),
        "external_wrench": part("external_wrench".into()),
        "reference_velocity": part("reference_velocity".into()),
        "outputs": outputs.iter().cloned().collect::<Map<String, Value>>(),
    })
}

/// Flat row-major numbers as nested arrays; a scalar bare.
pub fn nested(values: &[f64], shape: &[usize]) -> Value {
    match shape {
        [] => json!(values.first()),
        [_] => json!(values),
        [_, inner @ ..] => {
            let length = inner.iter().product::<usize>().max(1);
            values.chunks(length).map(|row| nested(row, inner)).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::nested;

    #[test]
    fn arrays_nest_row_by_row() {
        let values = [0.0, 1.0, 2.0, 3.0, 4.0, 5.5];
        assert_eq!(nested(&values, &[3, 2]).to_string(), "[[0.0,1.0],[2.0,3.0],[4.0,5.5]]");
        assert_eq!(nested(&values, &[1, 3, 2]).to_string(), "[[[0.0,1.0],[2.0,3.0],[4.0,5.5]]]");
        assert_eq!(nested(&values[5..], &[]).to_string(), "5.5");
    }
}
