//! The JSON schema against the reader: what the reader accepts, the schema accepts; common slips it refuses.

use std::fs;
use std::path::Path;

use dyn_platform::{Platform, Starter, schema, starter};
use jsonschema::Validator;
use serde_json::Value;

fn validator() -> Validator {
    jsonschema::draft7::new(&schema()).expect("a schema")
}

fn json(text: &str) -> Value {
    serde_json::to_value(toml::from_str::<toml::Table>(text).expect("TOML")).expect("JSON")
}

fn accept(name: &str, text: &str) {
    let (validator, value) = (validator(), json(text));
    let errors: Vec<String> =
        validator.iter_errors(&value).map(|error| format!("{error} at {}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{name}: {errors:#?}");
}

/// Schema and reader refuse.
fn refuse(text: &str) {
    assert!(Platform::from_toml("edited.toml", text).is_err(), "the reader accepts\n{text}");
    assert!(!validator().is_valid(&json(text)), "the schema accepts\n{text}");
}

fn with(text: &str, good: &str, bad: &str) -> String {
    assert!(text.contains(good), "{good:?} is not in the valid file");
    text.replacen(good, bad, 1)
}

#[test]
fn every_platform_file_is_valid() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut count = 0;
    for folder in ["platforms", "tests/platforms", "dyn-platform/starters"] {
        for entry in fs::read_dir(root.join(folder)).expect("a folder of platform files") {
            let path = entry.expect("a folder entry").path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                accept(&path.display().to_string(), &fs::read_to_string(&path).expect("a platform file"));
                count += 1;
            }
        }
    }
    assert!(count >= 15, "{count} files");
}

#[test]
fn the_schema_is_a_schema() {
    jsonschema::draft7::meta::validate(&schema()).expect("draft 7");
}

#[test]
fn limits_and_parts_are_valid() {
    let text = starter(Starter::Paper).replace("#~ ", "");
    let parts =
        text.find("\n[payload]").expect("a payload")..text.find("\n[[payload.part]]").expect("a part");
    let text = text.replacen(&text[parts], "", 1);
    Platform::from_toml("edited.toml", &text).expect("limits and a part");
    accept("paper, with everything", &text);
}

#[test]
fn unknown_keys_are_refused() {
    let paper = starter(Starter::Paper);
    refuse(&with(paper, "rod_length_m", "rod_lenght_m"));
    refuse(&with(paper, "\n[payload]", "\n[payload]\nrod_mass_kg = 1.0"));
    refuse(&with(paper, "\n[home]", "\ncolour = 3\n[home]"));
    refuse(&with(starter(Starter::Free), "number = 3", "number = 3\ncolour = 3"));
    refuse(&with(starter(Starter::Ups), "\n[legs]", "\n[legs]\nrod_length_m = 0.2"));
}

#[test]
fn missing_keys_are_refused() {
    for which in Starter::ALL {
        let text = starter(which);
        let keys = ["version", "name", "leg_type", "gravity_m_per_s2", "position_m", "mass_kg", "com_m"];
        for key in keys {
            let line = text.lines().find(|line| line.starts_with(key)).expect("a needed key");
            refuse(&with(text, line, ""));
        }
    }
    for key in ["base_radius_m", "platform_pair_angle_rad"] {
        let text = starter(Starter::Paper);
        refuse(&with(text, text.lines().find(|line| line.starts_with(key)).expect("a needed key"), ""));
    }
    let text = starter(Starter::Free);
    for key in ["number", "base_point_m", "platform_point_m"] {
        refuse(&with(text, text.lines().find(|line| line.starts_with(key)).expect("a needed key"), ""));
    }
}

#[test]
fn wrong_values_are_refused() {
    let paper = starter(Starter::Paper);
    for (good, bad) in [
        ("version = 1", "version = 2"),
        ("name = \"my_platform\"", "name = \"My platform\""),
        ("leg_type = \"uhp\"", "leg_type = \"stewart\""),
        ("mover_mass_kg = 0.611", "mover_mass_kg = -0.611"),
        ("rod_com_fraction = 0.5", "rod_com_fraction = 50"),
        ("axial_damping_n_s_per_m = 0.0", "axial_damping_n_s_per_m = -1.0"),
        ("base_pair_angle_rad = 1.5009831567151235", "base_pair_angle_rad = 86"),
        ("com_m = [0.0, 0.0, 0.031]", "com_m = [0.0, 0.031]"),
        ("#~ maximum_hooke_joint_angle_rad = 0.35", "maximum_hooke_joint_angle_rad = 20"),
        ("#~ maximum_force_n = 200.0", "maximum_force_n = 0"),
    ] {
        refuse(&with(paper, good, bad));
    }
}

#[test]
fn layouts_and_payloads_exclude_each_other() {
    let (paper, free) = (starter(Starter::Paper), starter(Starter::Free));
    let legs =
        &free[free.find("[[leg]]\nnumber").expect("legs")..free.find("\n[payload]").expect("a payload")];
    refuse(&with(paper, "\n[payload]", &format!("\n{legs}[payload]")));
    refuse(&with(free, "[[leg]]\nnumber = 6", "[[leg]]\nnumber = 7"));
    let sixth =
        free.find("[[leg]]\nnumber = 6").expect("a sixth leg")..free.find("\n[payload]").expect("a payload");
    refuse(&with(free, &free[sixth], ""));
    refuse(&paper.replace("#~ ", ""));
}
