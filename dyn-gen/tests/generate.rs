//! What `generate` refuses: layouts that no elimination can serve, and graph files that do not fit the platform. Whatever a
//! valid graph file holds, there is an error or source that parses.

mod common;

use dyn_gen::emit::{RuntimePath, Scalar};
use dyn_gen::graph::FormatError;
use dyn_gen::{GenerateError, Generated, GraphFile, Numbers, Options, generate, kernels};
use dyn_platform::{Parameters, Platform};
use proptest::prelude::*;
use serde_json::{Value, json};

fn options(functions: &[&str]) -> Options {
    Options {
        model: "model".into(),
        runtime: RuntimePath::inside(),
        scalars: vec![Scalar::F64],
        functions: Some(functions.iter().map(|name| (*name).to_owned()).collect()),
        command: "cargo test\nfn injected() {}".into(),
        evidence: None,
        without: Vec::new(),
    }
}

fn committed() -> Value {
    let text = include_str!("../../codegen/graphs/uhp.json");
    serde_json::from_str(text).unwrap()
}

fn read(file: &Value) -> Result<GraphFile, FormatError> {
    GraphFile::from_json("edited.json\nfn injected() {}", &file.to_string())
}

/// The declaration of a symbol in a graph file.
fn symbol<'a>(file: &'a mut Value, name: &str) -> &'a mut Value {
    let symbols = file["symbols"].as_array_mut().unwrap();
    symbols.iter_mut().find(|symbol| symbol["name"] == name).unwrap()
}

/// Gives a symbol another shape of as many or more elements and the sample the numbers for it.
fn reshape(file: &mut Value, name: &str, shape: &[usize]) {
    let declaration = symbol(file, name);
    let legs = if declaration["per_leg"] == json!(true) { 6 } else { 1 };
    declaration["shape"] = json!(shape);
    if file["sample"].get(name).is_some() {
        file["sample"][name] = json!(vec![1.0; legs * shape.iter().product::<usize>()]);
    }
}

fn baked(file: &Value, functions: &[&str]) -> Result<Generated, GenerateError> {
    generate(&read(file).unwrap(), &Numbers::baked(&common::platform()), &options(functions))
}

fn refused(file: &Value) -> String {
    baked(file, &["bias"]).unwrap_err().to_string()
}

/// The default platform with its joints elsewhere. Platform files with such layouts are refused, resolved numbers are not.
fn singular(place: impl Fn(&mut Parameters)) -> Platform {
    let mut platform = common::platform();
    place(&mut platform.parameters);
    platform
}

#[test]
fn coinciding_legs_are_refused() {
    let platform = singular(|parameters| {
        for leg in [1, 3, 5] {
            parameters.base_point[leg] = parameters.base_point[leg - 1];
            parameters.platform_point[leg] = parameters.platform_point[leg - 1];
        }
    });
    let file = GraphFile::uhp().unwrap();
    let error = generate(&file, &Numbers::baked(&platform), &options(&["inverse_dynamics"])).unwrap_err();
    let text = error.to_string();
    assert!(
        text.starts_with("platform `uhp_2016`: J_dp is singular or nearly so at every sampled pose"),
        "{text}"
    );
    let help = miette::Diagnostic::help(&error).unwrap().to_string();
    assert!(help.contains("parallel or coinciding rods"), "{help}");
}

#[test]
fn a_home_with_parallel_rods_is_refused() {
    // Rods stand upright at home: they hold no horizontal force. Elsewhere, far from the centre, they do.
    let platform = singular(|parameters| {
        parameters.base_point = parameters.base_point.map(|point| point.map(|x| 4.0 * x));
        parameters.platform_point = parameters.base_point;
    });
    let file = GraphFile::uhp().unwrap();
    let error = generate(&file, &Numbers::baked(&platform), &options(&["inverse_dynamics"])).unwrap_err();
    let GenerateError::Growth { growth: f64::INFINITY, states: 51, .. } = &error else { panic!("{error}") };
    assert_eq!(
        error.to_string(),
        "the elimination of `axial_reaction` in function `inverse_dynamics` loses digits: rounding errors grow by inf at the \
         worst of 51 sampled states (limit 1e4), so J_dp is singular or nearly so there"
    );
    let help = miette::Diagnostic::help(&error).unwrap().to_string();
    assert!(help.contains("check the legs' layout"), "{help}");
}

#[test]
fn parameters_must_have_the_platform_s_size() {
    let mut file = committed();
    reshape(&mut file, "gravity", &[4]);
    assert_eq!(
        refused(&file),
        "parameter `gravity` has 3 numbers in the platform, but shape [4] in the graph"
    );
    let mut file = committed();
    reshape(&mut file, "rod_length", &[2]);
    assert_eq!(
        refused(&file),
        "parameter `rod_length` has 6 numbers in the platform, but shape [6, 2] in the graph"
    );
}

#[test]
fn inputs_must_be_those_of_sampled_states() {
    let mut file = committed();
    reshape(&mut file, "external_wrench", &[7]);
    assert_eq!(
        refused(&file),
        "input `external_wrench` has shape [7] in the graph, but 6 numbers in sampled states"
    );
}

#[test]
fn functions_that_sampling_needs_are_named() {
    for name in ["rod_alignment", "jacobian_dp"] {
        let mut file = committed();
        let functions = file["functions"].as_array_mut().unwrap();
        functions.iter_mut().find(|function| function["name"] == name).unwrap()["name"] = json!("renamed");
        let error = baked(&file, &["bias"]).unwrap_err();
        assert_eq!(
            error.to_string(),
            format!("states cannot be sampled: function `{name}` is not in the graph file")
        );
        let help = miette::Diagnostic::help(&error).unwrap().to_string();
        assert!(help.contains("derive again with `cargo regen --derive`"), "{help}");
    }
    let mut file = committed();
    let functions = file["functions"].as_array_mut().unwrap();
    let function = functions.iter_mut().find(|function| function["name"] == "rod_alignment").unwrap();
    (function["outputs"], function["sample_outputs"]) = (json!([]), json!({}));
    assert_eq!(
        refused(&file),
        "states cannot be sampled: function `rod_alignment` gives 0 numbers instead of 6"
    );
}

#[test]
fn a_function_is_generated_once() {
    let error = baked(&committed(), &["bias", "energy", "bias"]).unwrap_err();
    assert_eq!(error, GenerateError::RepeatedFunction { name: "bias".into() });
}

#[test]
fn the_header_has_counts_and_growth_and_no_code() {
    let generated = baked(&committed(), &["inverse_dynamics", "rod_alignment"]).unwrap();
    let order = generated.functions[0].pivot_orders().next().unwrap();
    let line = format!("// inverse_dynamics, {}: {:.1} (51 states sampled)\n", order.solve, order.growth);
    assert!(generated.source.contains(&line), "{line}");
    assert_eq!(generated.source.lines().filter(|line| line.contains("states sampled")).count(), 1);
    for line in generated.source.lines().filter(|line| line.contains("injected")) {
        assert!(line.starts_with("//"), "{line}");
    }
    assert!(generated.source.contains("graph     edited.json fn injected() {}, sha256"));
}

/// One change of a graph file.
#[derive(Clone, Debug)]
enum Edit {
    Shape {
        symbol: usize,
        shape: Vec<usize>,
    },
    PerLeg {
        symbol: usize,
    },
    Role {
        symbol: usize,
        role: &'static str,
    },
    /// Everywhere in the file, so that references stay whole.
    Name {
        symbol: usize,
        name: String,
    },
    Text {
        symbol: usize,
        text: String,
    },
    Function {
        function: usize,
        name: String,
    },
    Solve {
        definite: bool,
    },
    Drop {
        function: usize,
    },
    Legs(usize),
}

fn edits() -> impl Strategy<Value = Edit> {
    let name = prop_oneof![
        "[a-z_0-9]{1,3}",
        prop::sample::select(
            &["fn", "self", "sqrt", "t1", "parameters", "solve_general", "gravity", "rod_length", "self_"][..]
        )
        .prop_map(str::to_owned),
    ];
    // Inputs and parameters come first in the file; what is wrong with them shows latest.
    let symbol = || prop_oneof![0..26_usize, 0..1000_usize];
    prop_oneof![
        (symbol(), prop::collection::vec(0..8_usize, 0..3))
            .prop_map(|(symbol, shape)| Edit::Shape { symbol, shape }),
        symbol().prop_map(|symbol| Edit::PerLeg { symbol }),
        (symbol(), prop::sample::select(&["input", "parameter", "intermediate", "output"][..]))
            .prop_map(|(symbol, role)| Edit::Role { symbol, role }),
        (symbol(), name.clone()).prop_map(|(symbol, name)| Edit::Name { symbol, name }),
        (symbol(), "[\\PC\n\r\u{202e}\"]{0,6}").prop_map(|(symbol, text)| Edit::Text { symbol, text }),
        (symbol(), name).prop_map(|(function, name)| Edit::Function { function, name }),
        any::<bool>().prop_map(|definite| Edit::Solve { definite }),
        symbol().prop_map(|function| Edit::Drop { function }),
        (1..8_usize).prop_map(Edit::Legs),
    ]
}

fn apply(file: &mut Value, edit: &Edit) {
    let pick = |file: &Value, list: &str, index: usize| {
        let items = file[list].as_array().unwrap();
        items[index % items.len()]["name"].as_str().unwrap().to_owned()
    };
    let by_index = |file: &Value, index: usize| pick(file, "symbols", index);
    match edit {
        Edit::Shape { symbol, shape } => {
            let name = by_index(file, *symbol);
            reshape(file, &name, shape);
        }
        Edit::PerLeg { symbol: index } => {
            let name = by_index(file, *index);
            let declaration = symbol(file, &name);
            declaration["per_leg"] = json!(declaration["per_leg"] == json!(false));
            let shape: Vec<usize> = serde_json::from_value(declaration["shape"].clone()).unwrap();
            reshape(file, &name, &shape);
        }
        Edit::Role { symbol: index, role } => {
            let name = by_index(file, *index);
            symbol(file, &name)["role"] = json!(role);
        }
        Edit::Name { symbol, name } => {
            let old = by_index(file, *symbol);
            *file = serde_json::from_str(
                &file.to_string().replace(&format!("\"{old}\""), &format!("\"{name}\"")),
            )
            .unwrap();
        }
        Edit::Text { symbol: index, text } => {
            let name = by_index(file, *index);
            symbol(file, &name)["meaning"] = json!(text);
        }
        Edit::Function { function, name } => {
            let functions = file["functions"].as_array_mut().unwrap();
            let index = function % functions.len();
            functions[index]["name"] = json!(name);
        }
        Edit::Solve { definite } => {
            for function in file["functions"].as_array_mut().unwrap() {
                for step in function["steps"].as_array_mut().unwrap() {
                    if step.get("solve").is_some() {
                        step["symmetric_positive_definite"] = json!(definite);
                    }
                }
            }
        }
        Edit::Drop { function } => {
            let functions = file["functions"].as_array_mut().unwrap();
            functions.remove(function % functions.len());
        }
        Edit::Legs(legs) => file["leg_count"] = json!(legs),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn edited_graphs_give_an_error_or_source_that_parses(
        edits in prop::collection::vec(edits(), 1..3),
        function in 0..1000_usize,
    ) {
        let mut file = committed();
        edits.iter().for_each(|edit| apply(&mut file, edit));
        let Ok(file) = read(&file) else { return Ok(()) };
        if let Ok(source) = kernels(std::slice::from_ref(&file), "cargo test") {
            syn::parse_file(&source).expect("kernels parse");
        }
        // Those with few results are printed fast.
        let functions = file.program.functions.iter().filter(|function| function.outputs.len() < 3).collect::<Vec<_>>();
        let chosen = options(&[&functions[function % functions.len()].name]);
        let platform = common::platform();
        for numbers in [Numbers::baked(&platform), Numbers::at_run_time()] {
            if let Ok(generated) = generate(&file, &numbers, &chosen) {
                let parsed = syn::parse_file(&generated.source).expect("a model parses");
                prop_assert!(!parsed.items.iter().any(
                    |item| matches!(item, syn::Item::Fn(function) if function.sig.ident == "injected")
                ));
                if numbers.platform().is_some() {
                    prop_assert!(!generated.source.contains("parameters."));
                }
            }
        }
    }
}

#[test]
fn some_outputs_cost_less_and_are_no_trait() {
    let file = GraphFile::uhp().unwrap();
    let text = include_str!("../../platforms/uhp_2016.toml");
    let platform = Platform::from_toml("uhp_2016.toml", text).unwrap();
    let whole = generate(&file, &Numbers::baked(&platform), &options(&["control"])).unwrap();
    let some =
        generate(&file, &Numbers::baked(&platform), &options(&["control:total_bias:jacobian_dp"])).unwrap();
    assert!(whole.source.contains("kernels::Control for"));
    assert!(!some.source.contains("kernels::Control for"));
    let outputs: Vec<&str> =
        some.functions[0].graph.outputs.iter().map(|output| output.symbol.name.as_str()).collect();
    assert_eq!(outputs, ["jacobian_dp", "total_bias"]);
    let count = |generated: &Generated| generated.functions[0].graph.operation_count().total();
    assert!(count(&some) < 2 * count(&whole) / 3);
    let refused =
        generate(&file, &Numbers::baked(&platform), &options(&["control:jacobian_db"])).unwrap_err();
    assert_eq!(refused.to_string(), "function `control` has no output `jacobian_db`");
}
