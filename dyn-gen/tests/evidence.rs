//! Evidence against a model stops it: wrong graphs, wrong passes, broken laws, parameters that are not taken.

mod common;

use std::fs;

use common::cli::{code, dyn_gen, entries, said};
use dyn_gen::evidence::{Evidence, Sampling, gather};
use dyn_gen::graph::{Graph, Node, NodeId, Op};
use dyn_gen::{GeneratedFunction, Numbers, optimise};
use dyn_platform::Platform;

const PLATFORM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");
const SAMPLING: Sampling = Sampling { states: 40, seed: 5 };

/// What the evidence says of the default platform's functions after a change of one of them.
fn after(function: &str, change: impl Fn(&mut Graph)) -> Evidence {
    let (program, platform) = (common::program(), common::platform());
    let numbers = Numbers::baked(&platform);
    let mut functions = optimise(&program, &numbers, None).unwrap();
    let changed: &mut GeneratedFunction =
        functions.iter_mut().find(|candidate| candidate.graph.name == function).unwrap();
    change(&mut changed.graph);
    gather(&program, &numbers, &functions, SAMPLING).unwrap()
}

/// Makes the first element of an output larger by a part.
fn enlarge(graph: &mut Graph, output: &str, part: f64) {
    let position = graph.outputs.iter().position(|candidate| candidate.symbol.name == output).unwrap();
    let old = graph.outputs[position].nodes[0];
    let mut push = |node: Node| {
        graph.nodes.push(node);
        graph.section_of.push(0);
        NodeId(graph.nodes.len() as u32 - 1)
    };
    let factor = push(Node::Constant(1.0 + part));
    let new = push(Node::Binary(Op::Mul, old, factor));
    graph.outputs[position].nodes[0] = new;
}

/// Names of the laws that are missed.
fn broken(evidence: &Evidence) -> Vec<&'static str> {
    evidence.laws.iter().filter(|row| !row.holds()).map(|row| row.law).collect()
}

#[test]
fn sound_models_have_nothing_against_them() {
    let program = common::program();
    for platform in common::platforms() {
        let numbers = Numbers::baked(&platform);
        let functions = optimise(&program, &numbers, None).unwrap();
        let evidence = gather(&program, &numbers, &functions, SAMPLING).unwrap();
        assert!(evidence.holds(), "{}:\n{}", platform.name, evidence.failures().join("\n"));
        assert!(evidence.laws.iter().all(|row| row.worst.is_some()));
        let outputs: usize = functions.iter().map(|function| function.graph.outputs.len()).sum();
        let in_lanes = functions.iter().filter(|function| function.in_lanes.is_some());
        let in_lanes: usize = in_lanes.map(|function| function.graph.outputs.len()).sum();
        assert_eq!(evidence.outputs.len(), outputs + in_lanes);
    }
}

/// Nothing but rounding is left at home where springs are relaxed and there is no gravity; that is no disagreement.
#[test]
fn forces_that_cancel_are_not_held_against_a_model() {
    let text = dyn_platform::starter(dyn_platform::Starter::Cubic);
    for gravity in ["[0.0, 0.0, -9.81]", "[0.0, 0.0, 0.0]"] {
        let text: String = text
            .lines()
            .map(|line| match line.split_once("gravity_m_per_s2 = ") {
                Some(("", _)) => format!("gravity_m_per_s2 = {gravity}\n"),
                _ => format!("{line}\n"),
            })
            .collect();
        let platform = Platform::from_toml("cubic.toml", &text).unwrap();
        let program = dyn_gen::GraphFile::of(platform.leg_type).unwrap().program;
        let numbers = Numbers::baked(&platform);
        let functions = optimise(&program, &numbers, None).unwrap();
        let evidence = gather(&program, &numbers, &functions, SAMPLING).unwrap();
        assert!(evidence.holds(), "gravity {gravity}:\n{}", evidence.failures().join("\n"));
    }
}

#[test]
fn a_pass_that_changes_a_value_is_noticed() {
    let evidence = after("bias", |graph| enlarge(graph, "bias", 1e-9));
    let failures = evidence.failures();
    assert!(
        failures[0]
            .starts_with("function `bias`, output `bias`: differs from the graph before optimisation by "),
        "{failures:?}"
    );
    assert!(
        failures[1].starts_with("function `bias`, output `bias`: differs from the hand-written dynamics by ")
    );
    assert!(failures[0].ends_with(" of seed 5") && failures[0].contains("(tolerance 1e-12) at state "));
}

#[test]
fn a_value_that_is_not_a_number_is_noticed() {
    let evidence = after("energy", |graph| enlarge(graph, "kinetic_energy", f64::NAN));
    assert!(!evidence.holds());
    assert!(evidence.failures()[0].contains("by NaN"), "{:?}", evidence.failures());
}

#[test]
fn every_law_can_be_broken() {
    let symmetric = "M_p = M_p^T";
    let definite = "M_p > 0: condition number, diagonal scaled to 1";
    let skew = "M_p' - 2 C_p is skew";
    let energy = "T = v_p^T M_p v_p / 2, base at rest";
    let power = "(T + V)' = F.d' + W_ext.v_p - D.v_p, base at rest";
    let motion = "M_p v_p' + bias = J_dp^T F + W_ext + M_b v_b' (49)";
    let round = "forward dynamics of the inverse dynamics' forces give v_p'";
    // What is changed is small enough that only these see it, but for definiteness.
    let part = 1e-6;
    assert_eq!(
        broken(&after("mass_matrix_p", |graph| graph.outputs[0].nodes.swap(1, 2))),
        [symmetric, skew, energy, motion]
    );
    assert!(
        broken(&after("mass_matrix_p", |graph| enlarge(graph, "mass_matrix_p", -2.0))).contains(&definite)
    );
    assert_eq!(
        broken(&after("coriolis_matrices", |graph| enlarge(graph, "coriolis_matrix_p", part))),
        [skew]
    );
    assert_eq!(broken(&after("energy", |graph| enlarge(graph, "kinetic_energy", part))), [energy, power]);
    assert_eq!(broken(&after("energy", |graph| enlarge(graph, "potential_energy", part))), [power]);
    assert_eq!(broken(&after("bias", |graph| enlarge(graph, "bias", part))), [motion]);
    assert_eq!(broken(&after("forward_dynamics", |graph| enlarge(graph, "forward_dynamics", part))), [round]);
    assert_eq!(
        broken(&after("inverse_dynamics", |graph| enlarge(graph, "inverse_dynamics", part))),
        [power, motion, round]
    );
}

#[test]
fn a_parameter_that_is_not_taken_is_noticed() {
    let (program, platform) = (common::program(), common::platform());
    let baked = optimise(&program, &Numbers::baked(&platform), None).unwrap();
    for name in ["payload_mass", "gravity", "rod_length", "actuator_axis", "axial_stiffness"] {
        let numbers = Numbers::with_run_time(&platform, [name]);
        let evidence = gather(&program, &numbers, &baked, SAMPLING).unwrap();
        assert!(!evidence.holds(), "{name} is baked in, which nobody noticed");
        let taken = optimise(&program, &numbers, None).unwrap();
        let evidence = gather(&program, &numbers, &taken, SAMPLING).unwrap();
        assert!(evidence.holds(), "{name}:\n{}", evidence.failures().join("\n"));
    }
}

#[test]
fn laws_without_their_functions_are_not_examined() {
    let (program, platform) = (common::program(), common::platform());
    let numbers = Numbers::baked(&platform);
    let functions = optimise(&program, &numbers, Some(&["mass_matrix_p".to_owned()])).unwrap();
    let evidence = gather(&program, &numbers, &functions, SAMPLING).unwrap();
    let examined: Vec<_> = evidence.laws.iter().filter(|row| row.worst.is_some()).collect();
    assert_eq!(examined.len(), 2);
    assert_eq!(examined[0].functions, ["mass_matrix_p"]);
    assert!(evidence.text().contains("5 laws take functions that are not generated and were not examined"));
}

#[test]
fn evidence_needs_a_platform() {
    let program = common::program();
    let error = gather(&program, &Numbers::at_run_time(), &[], SAMPLING).unwrap_err();
    assert_eq!(error.to_string(), "there is no platform whose states could be sampled");
}

/// The committed graph file with one coefficient of one graph changed by a millionth.
fn altered_graph(folder: &std::path::Path) -> String {
    let text = fs::read_to_string(common::root().join("codegen/graphs/uhp.json")).unwrap();
    let mut file: serde_json::Value = serde_json::from_str(&text).unwrap();
    let graphs = file["graphs"].as_array_mut().unwrap();
    let nodes = graphs.iter_mut().flat_map(|graph| graph["nodes"].as_array_mut().unwrap());
    let constant = nodes
        .filter(|node| node[0] == "const")
        .find(|node| node[1].as_f64().is_some_and(|value| value == 0.5))
        .expect("a coefficient 1/2");
    constant[1] = serde_json::json!(0.5000005);
    fs::write(folder.join("altered.json"), file.to_string()).unwrap();
    "altered.json".into()
}

#[test]
fn an_altered_coefficient_is_refused_and_the_old_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let graph = altered_graph(folder.path());
    let model = folder.path().join("model.rs");
    let old = "// @generated by dyn-gen 0.0.0, old \u{3b1}\n";
    fs::write(&model, old).unwrap();
    let arguments =
        ["generate", PLATFORM, "-o", "model.rs", "--graph", &graph, "--evidence", "evidence.json"];
    let result = dyn_gen(folder.path(), &arguments);
    assert_eq!(code(&result), 1, "{}", said(&result));
    let words = common::cli::words(&result);
    for mention in [
        "the evidence is against this model; nothing is written",
        "differs from the hand-written dynamics by",
        "(tolerance 1e-12) at state",
        "of seed 2016",
        "the graph file was altered (derive it again with `cargo regen --derive`, or leave out --graph)",
    ] {
        assert!(words.contains(mention), "{mention}: {words}");
    }
    assert_eq!(fs::read_to_string(&model).unwrap(), old);
    assert_eq!(entries(folder.path()), ["altered.json", "model.rs"]);
    // Whoever wants it in spite of that has to say so, and the file does not claim anything.
    let result =
        dyn_gen(folder.path(), &["generate", PLATFORM, "-o", "model.rs", "--graph", &graph, "--no-evidence"]);
    assert_eq!(code(&result), 0, "{}", said(&result));
    assert!(!fs::read_to_string(&model).unwrap().contains("every output agrees"));
}

#[test]
fn evidence_is_printed_summed_up_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "generate",
        PLATFORM,
        "-o",
        "model.rs",
        "--evidence",
        "evidence.json",
        "--states",
        "100",
        "--seed",
        "3",
        "--timings",
    ];
    let result = dyn_gen(folder.path(), &arguments);
    assert_eq!(code(&result), 0, "{}", said(&result));
    let printed = String::from_utf8_lossy(&result.stdout).into_owned();
    assert!(
        printed.starts_with("evidence: 100 states over the workspace of uhp_2016, seed 3\n"),
        "{printed}"
    );
    for stage in ["optimise", "evidence", "print", "write"] {
        assert!(printed.lines().any(|line| line.starts_with(stage) && line.ends_with(" ms")), "{stage}");
    }
    let text = fs::read_to_string(folder.path().join("evidence.json")).unwrap();
    let evidence: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&evidence["states"], &evidence["seed"]), (&100.into(), &3.into()));
    assert!(evidence["outputs"].as_array().unwrap().len() > 40);
    assert!(evidence["outputs"][0]["reference"]["error"].as_f64().unwrap() < 1e-12);
    let model = fs::read_to_string(folder.path().join("model.rs")).unwrap();
    assert!(model.contains("// 100 states over the workspace, seed 3: every output agrees"), "{model:.2000}");
    assert!(model.contains("//   M_p' - 2 C_p is skew\n"));
}

#[test]
fn a_platform_is_sampled_in_turn() {
    let program = common::program();
    let platform: Platform = common::platform();
    let kinds = |states| {
        let cases = dyn_gen::evidence::cases(&program, &platform, Sampling { states, seed: 1 }).unwrap();
        cases.iter().map(|case| case.kind.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(kinds(0), [""; 0]);
    assert_eq!(kinds(1), ["home"]);
    assert_eq!(kinds(6), ["home", "near home", "large", "near edge", "near home", "large"]);
}
