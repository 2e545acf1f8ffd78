//! A graph file: its program, its name, and the hash by which generated files refer to it.

use dyn_platform::LegType;
use sha2::{Digest, Sha256};

use crate::graph::{FormatError, Program};

/// A graph file that was read and checked.
#[derive(Clone, PartialEq, Debug)]
pub struct GraphFile {
    /// File name without folders, e.g. `uhp.json`.
    pub name: String,
    /// Hash of the file's bytes, hexadecimal.
    pub sha256: String,
    /// What it holds.
    pub program: Program,
}

impl GraphFile {
    /// Reads the text of a graph file called `name`.
    ///
    /// # Errors
    /// Anything that is not a graph file of this version, with the place in it.
    pub fn from_json(name: &str, text: &str) -> Result<GraphFile, FormatError> {
        Ok(GraphFile {
            name: name.into(),
            sha256: sha256(text.as_bytes()),
            program: Program::from_json(text)?,
        })
    }

    /// The mechanism with legs of this type as this crate was built with it (`codegen/graphs/<leg type>.json`).
    ///
    /// # Errors
    /// As [`GraphFile::from_json`]; a test shows that there are none.
    pub fn of(leg_type: LegType) -> Result<GraphFile, FormatError> {
        let text = match leg_type {
            LegType::Uhp => include_str!("../../codegen/graphs/uhp.json"),
            LegType::Ups => include_str!("../../codegen/graphs/ups.json"),
        };
        GraphFile::from_json(&format!("{}.json", leg_type.name()), text)
    }

    /// The paper's mechanism, that with legs of type [`LegType::Uhp`].
    ///
    /// # Errors
    /// As [`GraphFile::of`].
    pub fn uhp() -> Result<GraphFile, FormatError> {
        GraphFile::of(LegType::Uhp)
    }
}

/// SHA-256 of `bytes`, hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_graphs_are_graphs_of_their_leg_types() {
        for leg_type in LegType::ALL {
            assert_eq!(GraphFile::of(leg_type).unwrap().program.name, leg_type.name());
        }
    }

    #[test]
    fn the_hash_is_sha256() {
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
