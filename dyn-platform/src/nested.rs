//! Numbers in the natural nesting of their shape, as they stand in JSON.

use serde::{Deserialize, Serialize};

/// A number, or an array of such.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum Nested {
    Number(f64),
    Array(Vec<Nested>),
}

impl Nested {
    /// Nests flat row-major values; their number must be that of `shape`.
    pub fn of(values: &[f64], shape: &[usize]) -> Self {
        match shape {
            [] => Self::Number(values[0]),
            [length, inner @ ..] => {
                let parts = values.chunks(values.len() / length);
                Self::Array(parts.map(|part| Self::of(part, inner)).collect())
            }
        }
    }

    /// Flat row-major values, if this has the shape.
    pub fn flat(&self, shape: &[usize]) -> Option<Vec<f64>> {
        match (self, shape) {
            (Self::Number(number), []) => Some(vec![*number]),
            (Self::Array(entries), [length, inner @ ..]) if entries.len() == *length => {
                let parts: Option<Vec<_>> = entries.iter().map(|entry| entry.flat(inner)).collect();
                Some(parts?.concat())
            }
            _ => None,
        }
    }
}
