//! Tells the crate how it is compiled, because instruction counts compare only under the same compiler and flags.

use std::env::var;
use std::process::Command;

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
