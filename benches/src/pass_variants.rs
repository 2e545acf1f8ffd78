//! Models of one platform made without some passes, to see what each pass is worth.

use std::path::Path;

use dyn_gen::emit::{RuntimePath, Scalar};
use dyn_gen::evidence::Sampling;
use dyn_gen::graph::{Graph, Node, Op};
use dyn_gen::pack::STEPS;
use dyn_gen::passes::PASSES;
use dyn_gen::{GraphFile, Numbers, Options, generate, optimise_without};
use dyn_platform::Platform;

/// The functions that are looked at.
pub const FUNCTIONS: [&str; 3] = ["inverse_dynamics", "forward_dynamics", "matrices"];

/// Passes that a model cannot do without: it would have no numbers, and a system of equations that nothing solves.
const NEEDED: [&str; 2] = ["bake", "expand"];

/// A pipeline with passes missing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variant {
    /// `all`, `without PASS`, `PASS alone` or `none`.
    pub name: String,
    /// Names of the passes and steps that do not run.
    pub without: Vec<String>,
}

impl Variant {
    /// The module and file of its model, from which `build.rs` knows its name.
    pub fn module(&self) -> String {
        self.name.replace(' ', "_")
    }
}

/// Every pass; each pass and each step of packing left out; each pass alone beside `NEEDED`, and none beside them.
pub fn variants() -> Vec<Variant> {
    let names = || PASSES.iter().map(|pass| pass.name).filter(|name| !NEEDED.contains(name));
    let variant = |name: String, without: Vec<&str>| Variant {
        name,
        without: without.into_iter().map(str::to_owned).collect(),
    };
    let left_out = names().chain(STEPS).map(|name| variant(format!("without {name}"), vec![name]));
    let alone = names().map(|name| {
        let others = names().filter(|&other| other != name).collect();
        variant(format!("{name} alone"), others)
    });
    let none = variant("none".into(), names().collect());
    std::iter::once(variant("all".into(), Vec::new())).chain(left_out).chain(alone).chain([none]).collect()
}

/// Writes the models of a platform, one file per variant.
///
/// # Errors
/// If a model cannot be made or is beyond its tolerance, or a file cannot be written; in words.
pub fn write_models(platform: &Platform, folder: &Path) -> Result<(), String> {
    let file = GraphFile::of(platform.leg_type).map_err(|error| error.to_string())?;
    for variant in variants() {
        let options = Options {
            model: "model".into(),
            runtime: RuntimePath::new("dyn_runtime").map_err(|error| error.to_string())?,
            scalars: vec![Scalar::F64],
            functions: Some(FUNCTIONS.map(str::to_owned).into()),
            command: "cargo xtask passes".into(),
            evidence: Some(Sampling::default()),
            without: variant.without.clone(),
        };
        let generated = generate(&file, &Numbers::baked(platform), &options)
            .map_err(|error| format!("{}: {error}", variant.name))?;
        let path = folder.join(variant.module()).with_extension("rs");
        std::fs::write(&path, generated.source).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

/// Operations of [`FUNCTIONS`], without lanes and with, where three numbers at a time are one operation.
///
/// # Errors
/// If the platform's functions cannot be made; in words.
pub fn operations(platform: &Platform, variant: &Variant) -> Result<[[usize; 2]; 3], String> {
    let file = GraphFile::of(platform.leg_type).map_err(|error| error.to_string())?;
    let names = FUNCTIONS.map(str::to_owned);
    let functions =
        optimise_without(&file.program, &Numbers::baked(platform), Some(&names), &variant.without)
            .map_err(|error| format!("{}: {error}", variant.name))?;
    let counts = functions.iter().map(|function| {
        let packed = function.in_lanes.as_ref().map_or(0, |packed| arithmetic(&packed.graph));
        [arithmetic(&function.graph), packed]
    });
    counts.collect::<Vec<_>>().try_into().map_err(|_| "not every function was made".to_owned())
}

/// Additions, products, divisions and roots that outputs need; negations are not counted.
fn arithmetic(graph: &Graph) -> usize {
    let is_counted =
        |node: &Node| matches!(node, Node::Binary(..) | Node::Ternary(..) | Node::Unary(Op::Sqrt, _));
    graph.nodes.iter().zip(graph.live()).filter(|(node, live)| *live && is_counted(node)).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::states::platform;

    #[test]
    fn passes_are_missed() {
        let all = operations(&platform(), &variants()[0]).unwrap();
        for (name, index) in [("without merge", 0), ("fuse alone", 0), ("without sums", 1)] {
            let variant = variants().into_iter().find(|variant| variant.name == name).unwrap();
            let counted = operations(&platform(), &variant).unwrap();
            assert!(counted[0][index] > all[0][index], "{name}: {counted:?}, {all:?}");
        }
    }
}
