//! Test vectors: the format, the values, and every refusal of a file of states.

mod common;

use std::fs;

use common::cli::{code, dyn_gen, entries, said, words};
use dyn_gen::GraphFile;
use dyn_gen::evidence::{reference_parameters, reference_state};
use dyn_gen::graph::{Environment, Role};
use dyn_gen::vectors::{read_states, vectors};
use serde_json::{Value, json};

const PLATFORM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(elements) => elements.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().expect("a number")],
    }
}

/// The shape of nested arrays; fails where rows differ.
fn shape(value: &Value) -> Vec<usize> {
    let Value::Array(elements) = value else { return Vec::new() };
    let inner: Vec<_> = elements.iter().map(shape).collect();
    assert!(inner.windows(2).all(|pair| pair[0] == pair[1]), "ragged: {value}");
    [vec![elements.len()], inner[0].clone()].concat()
}

fn close(found: &[f64], expected: &[f64]) -> bool {
    let largest = expected.iter().fold(1e-6, |most: f64, x| most.max(x.abs()));
    found.len() == expected.len() && found.iter().zip(expected).all(|(x, y)| (x - y).abs() <= 1e-10 * largest)
}

#[test]
fn every_output_in_its_shape_agrees_with_the_hand_written_dynamics() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["vectors", PLATFORM, "-n", "13", "--seed", "4", "-o", "vectors.json"];
    let result = dyn_gen(folder.path(), &arguments);
    assert_eq!(code(&result), 0, "{}", said(&result));
    let text = fs::read_to_string(folder.path().join("vectors.json")).unwrap();
    let file: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(file["version"], 1);
    let platform = common::platform();
    assert_eq!(file["platform"], serde_json::to_value(&platform).unwrap());
    let cases = file["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 13);

    let parameters = reference_parameters(&platform).unwrap();
    let program = common::program();
    let states = read_states(&text).unwrap().states;
    for (case, state) in cases.iter().zip(&states) {
        for body in ["base", "platform"] {
            assert_eq!(shape(&case[body]["rotation"]), [3, 3]);
            assert_eq!(shape(&case[body]["velocity"]), [6]);
        }
        let state = reference_state(state).unwrap();
        let outputs = case["outputs"].as_object().unwrap();
        let mut known = 0;
        for declaration in program.symbols.iter().filter(|symbol| symbol.role == Role::Output) {
            let symbol = &declaration.symbol;
            let Some(value) = outputs.get(&symbol.name) else { panic!("no `{}`", symbol.name) };
            assert_eq!(shape(value), symbol.shape, "{}", symbol.name);
            let mut expected = Vec::new();
            assert!(parameters.output(&state, &symbol.name, &mut expected));
            assert!(close(&flat(value), &expected), "{}: {value} and {expected:?}", symbol.name);
            known += 1;
        }
        assert_eq!(outputs.len(), known, "an output that the graph file does not declare");
    }
    // The same command, the same bytes; the states given back, the same outputs.
    assert_eq!(code(&dyn_gen(folder.path(), &arguments)), 0);
    assert_eq!(text, fs::read_to_string(folder.path().join("vectors.json")).unwrap());
    let again = ["vectors", PLATFORM, "--states", "vectors.json", "-o", "again.json"];
    let result = dyn_gen(folder.path(), &again);
    assert_eq!((code(&result), said(&result).as_str()), (0, "wrote again.json: 13 states\n"));
    assert_eq!(text, fs::read_to_string(folder.path().join("again.json")).unwrap());
}

#[test]
fn engines_agree_with_vectors_at_their_own_states() {
    for file in ["uhp_2016", "everything", "tilted_axes"] {
        let text = fs::read_to_string(common::root().join(format!("tests/vectors/{file}.json"))).unwrap();
        let engines: Value = serde_json::from_str(&text).unwrap();
        let platform: dyn_platform::Platform = serde_json::from_value(engines["platform"].clone()).unwrap();
        let states = read_states(&text).unwrap();
        assert_eq!(states.platform, Some(engines["platform"].clone()));
        let ours = vectors(&GraphFile::of(platform.leg_type).unwrap(), &platform, &states.states).unwrap();
        let ours: Value = serde_json::from_str(&ours).unwrap();
        let mut compared = 0;
        for (engine, ours) in
            engines["cases"].as_array().unwrap().iter().zip(ours["cases"].as_array().unwrap())
        {
            for key in ["base", "platform", "actuator_force", "external_wrench"] {
                assert_eq!(engine[key], ours[key]);
            }
            for (name, ours) in ours["outputs"].as_object().unwrap() {
                if let Some(engine) = engine["outputs"].get(name) {
                    assert!(close(&flat(ours), &flat(engine)), "{file}, {name}: {ours} and {engine}");
                    compared += 1;
                }
            }
        }
        assert!(compared > 500, "{file}: {compared}");
    }
}

fn example() -> Value {
    let mut state = Environment::new();
    for (name, length) in [
        ("base_position", 3),
        ("base_velocity", 6),
        ("base_acceleration", 6),
        ("platform_position", 3),
        ("platform_velocity", 6),
        ("platform_acceleration", 6),
        ("actuator_force", 6),
        ("external_wrench", 6),
    ] {
        state.insert(name.into(), vec![0.0; length]);
    }
    let body = |name: &str| {
        json!({
            "position": state[&format!("{name}_position")],
            "rotation": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            "velocity": state[&format!("{name}_velocity")],
            "acceleration": state[&format!("{name}_acceleration")],
        })
    };
    let mut case = json!({
        "base": body("base"),
        "platform": body("platform"),
        "actuator_force": state["actuator_force"],
        "external_wrench": state["external_wrench"],
    });
    case["platform"]["position"] = json!([0.0, 0.0, 0.382]);
    json!({ "version": 1, "cases": [case.clone(), case] })
}

fn refusal(text: &str) -> String {
    let error = read_states(text).unwrap_err();
    format!("{error} -- {}", miette::Diagnostic::help(&error).unwrap())
}

#[test]
fn mistakes_in_a_file_of_states_are_named_by_their_place() {
    assert!(read_states(&example().to_string()).is_ok());
    type Edit = fn(&mut Value);
    let cases: [(Edit, &str); 15] = [
        (
            |file| file["version"] = json!(2),
            "version: the file has version 2, this reader knows version 1 -- docs/vectors.md",
        ),
        (|file| drop(file.as_object_mut().unwrap().remove("cases")), "the file: `cases` is missing -- "),
        (|file| file["cases"] = json!([]), "cases: there are no cases -- "),
        (|file| file["cases"] = json!({}), "cases: this is not an array -- "),
        (|file| file["case"] = json!(1), "the file: unknown key `case` -- did you mean `cases`?"),
        (|file| file["cases"][1] = json!(3), "cases[1]: this is not an object -- "),
        (
            |file| file["cases"][1]["actuator_forces"] = json!(3),
            "cases[1]: unknown key `actuator_forces` -- did you mean `actuator_force`?",
        ),
        (
            |file| drop(file["cases"][1].as_object_mut().unwrap().remove("base")),
            "cases[1]: `base` is missing -- ",
        ),
        (
            |file| file["cases"][0]["base"]["velocity"] = json!([1, 2, 3]),
            "cases[0].base.velocity: 3 elements instead of 6 -- give 6 numbers in SI units",
        ),
        (
            |file| file["cases"][0]["base"]["position"][2] = json!("1"),
            "cases[0].base.position[2]: \"1\" is not a finite number -- give 3 numbers",
        ),
        (
            |file| file["cases"][0]["external_wrench"] = json!(1),
            "cases[0].external_wrench: this is not an array -- give 6 numbers",
        ),
        (
            |file| file["cases"][1]["platform"]["rotation"] = json!([1, 0, 0]),
            "cases[1].platform.rotation[0]: this is not an array -- ",
        ),
        (
            |file| file["cases"][1]["platform"]["rotation"] = json!([[1, 0, 0]]),
            "cases[1].platform.rotation: this is not an array of three rows -- ",
        ),
        (
            |file| file["cases"][1]["platform"]["rotation"][0][0] = json!(1.1),
            "cases[1].platform.rotation: this is not a rotation: R R^T differs from 1 by 2.1e-1 -- ",
        ),
        (
            |file| file["cases"][1]["platform"]["rotation"][0][0] = json!(-1),
            "cases[1].platform.rotation: this is a reflection, not a rotation: its determinant is -1 -- ",
        ),
    ];
    for (edit, message) in cases {
        let mut file = example();
        edit(&mut file);
        let found = refusal(&file.to_string());
        assert!(found.starts_with(message), "{found}\ninstead of {message}");
    }
    let found = refusal("{\n  \"version\": 1,\n  \"cases\": [\n");
    assert!(found.starts_with("line 4, column 0: this is not JSON: EOF while parsing a list"), "{found}");
}

#[test]
fn states_out_of_reach_are_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let mut file = example();
    file["cases"][1]["platform"]["position"] = json!([0.3, 0.0, 0.382]);
    fs::write(folder.path().join("states.json"), file.to_string()).unwrap();
    let arguments = ["vectors", PLATFORM, "--states", "states.json", "-o", "out.json"];
    let result = dyn_gen(folder.path(), &arguments);
    assert_eq!(code(&result), 1);
    assert!(words(&result).contains("cases[1]: leg 1 is out of reach"), "{}", words(&result));
    assert!(words(&result).contains("help: bring the platform of this case nearer to its home"));
    assert_eq!(entries(folder.path()), ["states.json"]);
    fs::write(folder.path().join("states.json"), "[]").unwrap();
    let result = dyn_gen(folder.path(), &arguments);
    assert!(words(&result).contains("states.json is refused"), "{}", words(&result));
    assert!(words(&result).contains("the file: this is not an object"), "{}", words(&result));
}

#[test]
fn numbers_of_another_platform_are_pointed_out() {
    let folder = tempfile::tempdir().unwrap();
    let other = common::root().join("tests/vectors/no_springs.json");
    let arguments = ["vectors", PLATFORM, "--states", other.to_str().unwrap(), "-o", "out.json"];
    let result = dyn_gen(folder.path(), &arguments);
    let warning = words(&result);
    assert!(
        warning.contains("carries the numbers of another platform; the outputs are those of"),
        "{warning}"
    );
}

/// The page lists every output as the graph file declares it, and nothing else.
#[test]
fn the_documentation_lists_every_output() {
    let page = fs::read_to_string(common::root().join("docs/vectors.md")).unwrap();
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| `")).collect();
    let program = common::program();
    let mut expected = Vec::new();
    for function in &program.functions {
        for name in &function.outputs {
            let symbol = &program.declaration(name).unwrap().symbol;
            let shape = match symbol.shape.as_slice() {
                [] => "scalar".into(),
                shape => shape.iter().map(usize::to_string).collect::<Vec<_>>().join("x"),
            };
            let row =
                format!("| `{name}` | {shape} | {} | {} | {} |", symbol.unit, symbol.frame, symbol.meaning);
            if !expected.contains(&row) {
                expected.push(row);
            }
        }
    }
    assert_eq!(rows, expected, "docs/vectors.md should have:\n{}", expected.join("\n"));
}
