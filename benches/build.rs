//! Tells the crate how it is compiled, because instruction counts compare only under the same compiler and flags; which
//! platform is measured; and, with the feature `peers`, where other people's code for it lies.
//!
//! `cargo xtask bench` sets `DYN_BENCHES_PLATFORM` (a platform file), `DYN_BENCHES_MODEL` (what dyn-gen generated for it),
//! `DYN_BENCHES_PAYLOAD` (the same with payload, gravity and stiffnesses at run time) and `DYN_PEERS` (a folder it filled).
//! Without them: the paper's platform, no such model, and no peers. `cargo xtask passes` sets `DYN_BENCHES_VARIANTS` (a folder
//! of models).

use std::env::var;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// The tables of `src/peers.rs` without peers.
const NO_PEERS: &str = "static PEERS: &[Peer] = &[];\nstatic PINOCCHIO: Option<PinocchioFunctions> = None;\n";

fn main() {
    let rustc = var("RUSTC").expect("cargo sets RUSTC");
    let output = Command::new(&rustc).arg("--version").output().expect("the compiler starts");
    let version = String::from_utf8_lossy(&output.stdout);
    // "rustc 1.95.0", without hash and date.
    let version: Vec<_> = version.split_whitespace().take(2).collect();
    let set = |name: &str| var(name).unwrap_or_default();
    let flags = codegen_flags(&set("CARGO_ENCODED_RUSTFLAGS")).join(" ");
    println!(
        "cargo::rustc-env=DYN_BENCHES_CODEGEN={}, {}, opt-level {}, features {}, flags [{flags}]",
        version.join(" "),
        set("TARGET"),
        set("OPT_LEVEL"),
        set("CARGO_CFG_TARGET_FEATURE"),
    );
    println!("cargo::rerun-if-changed=build.rs");
    let out = PathBuf::from(var("OUT_DIR").expect("cargo sets OUT_DIR"));
    write(&out.join("model.rs"), &model());
    write(&out.join("payload.rs"), &payload());
    write(&out.join("peers.rs"), &peers());
    write(&out.join("variants.rs"), &variants());
}

/// The module of the model that is measured, and its platform file for the program.
fn model() -> String {
    let (platform, model) = (given("DYN_BENCHES_PLATFORM"), given("DYN_BENCHES_MODEL"));
    let default =
        Path::new(&var("CARGO_MANIFEST_DIR").expect("cargo sets it")).join("../platforms/uhp_2016.toml");
    println!("cargo::rustc-env=DYN_BENCHES_PLATFORM={}", platform.as_deref().unwrap_or(&default).display());
    let Some(model) = model.filter(|_| platform.is_some()) else {
        return "pub use dyn_runtime::models::Uhp2016 as Baked;\n".into();
    };
    module_of(&model, "Baked")
}

/// The module of the model whose payload is given at run time, and a function that gives it, if there is one.
fn payload() -> String {
    match given("DYN_BENCHES_PAYLOAD") {
        Some(model) => {
            let module = module_of(&model, "Payload");
            format!("{module}/// That model.\npub fn payload() -> Option<Payload> {{\n    Some(Payload::default())\n}}\n")
        }
        // A type is needed, whichever.
        None => "pub use dyn_runtime::models::Uhp as Payload;\n/// None.\npub fn payload() -> Option<Payload> {\n    None\n}\n".into(),
    }
}

/// The module of a generated file, its model called `name`.
fn module_of(model: &Path, name: &str) -> String {
    let text = fs::read_to_string(model).unwrap_or_else(|error| panic!("{}: {error}", model.display()));
    let types = text.split("pub struct ").skip(1).filter_map(|rest| rest.split([';', ' ', '<']).next());
    let of_model = types.into_iter().find(|name| *name != "Parameters");
    let of_model = of_model.unwrap_or_else(|| panic!("{}: no model", model.display()));
    format!(
        "#[path = {model:?}]\n#[rustfmt::skip]\nmod generated;\npub use generated::{of_model} as {name};\n"
    )
}

/// Declarations of the peers in `DYN_PEERS`; links them.
fn peers() -> String {
    let folder = given("DYN_PEERS").filter(|_| env::var_os("CARGO_FEATURE_PEERS").is_some());
    let Some(folder) = folder else { return NO_PEERS.into() };
    let table = folder.join("peers.rs");
    let text = fs::read_to_string(&table).unwrap_or_else(|error| panic!("{}: {error}", table.display()));
    println!("cargo::rustc-link-search=native={}", folder.display());
    println!("cargo::rustc-link-lib=static=peers");
    if text.contains("pinocchio_new") {
        println!("cargo::rustc-link-lib=dylib=stdc++");
    }
    println!("cargo::rustc-link-lib=dylib=m");
    text
}

/// A module for each model in `DYN_BENCHES_VARIANTS`, and a function that shows them all by the macro of `benches/passes.rs`.
fn variants() -> String {
    let folder = given("DYN_BENCHES_VARIANTS").filter(|_| env::var_os("CARGO_FEATURE_VARIANTS").is_some());
    let entries = folder.into_iter().flat_map(|folder| fs::read_dir(folder).into_iter().flatten());
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "rs")).collect();
    paths.sort();
    let (mut modules, mut shown) = (String::new(), String::new());
    for path in paths {
        let module = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        println!("cargo::rerun-if-changed={}", path.display());
        modules += &format!("#[path = {path:?}]\n#[rustfmt::skip]\n#[allow(dead_code)]\nmod {module};\n");
        shown += &format!("    show!({:?}, {module}, states, visitor);\n", module.replace('_', " "));
    }
    format!("{modules}fn visit(states: &States, visitor: &mut impl Visitor) {{\n{shown}}}\n")
}

/// A path in an environment variable, watched.
fn given(name: &str) -> Option<PathBuf> {
    println!("cargo::rerun-if-env-changed={name}");
    let path = env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from)?;
    let table = path.join("peers.rs");
    let watched = if table.is_file() { table } else { path.clone() };
    println!("cargo::rerun-if-changed={}", watched.display());
    Some(path)
}

fn write(path: &Path, text: &str) {
    fs::write(path, text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

/// The values of `-C` alone: flags about warnings change no instruction.
fn codegen_flags(encoded: &str) -> Vec<&str> {
    let mut flags = encoded.split('\u{1f}');
    let mut codegen = Vec::new();
    while let Some(flag) = flags.next() {
        match flag.strip_prefix("--codegen=").or_else(|| flag.strip_prefix("-C")) {
            Some("") => codegen.extend(flags.next()),
            Some(value) => codegen.push(value),
            None if flag == "--codegen" => codegen.extend(flags.next()),
            None => {}
        }
    }
    codegen
}
