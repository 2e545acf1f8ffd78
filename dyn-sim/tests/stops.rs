//! Motions that end early: time, leg and reason are told, and what came before is kept.

use std::path::Path;
use std::process::Command;

use dyn_sim::experiment::{self, Experiment, Silent};
use dyn_sim::scenario::Scenario;
use dyn_sim::stop::StopReason;

fn run(tables: &str) -> Experiment {
    let text = format!(
        "version = 1\nname = \"stop\"\nplatform = \"uhp_2016.toml\"\ngravity = true\nduration_s = 0.5\nstep_s = 1e-3\n{tables}"
    );
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../platforms");
    let scenario = Scenario::from_toml("stop.toml", &text, &folder).expect("a valid scenario");
    experiment::run(&scenario, None, "test", &mut Silent)
}

/// As long as the time of the stop says, and nothing but numbers.
fn keeps_what_came_before(experiment: &Experiment) {
    let stop = experiment.stop.as_ref().expect("a stop");
    let series = &experiment.outcome.simulations[0];
    let expected = (stop.time_s / 1e-3) as usize;
    assert!(
        series.len() >= expected.saturating_sub(1) && series.len() <= expected + 1,
        "{} {stop}",
        series.len()
    );
    assert!(series.acceleration.iter().flatten().all(|x| x.is_finite()));
    assert_eq!(experiment.outcome.actuator_length_m.len(), series.len());
    assert!(experiment.outcome.warnings.iter().any(|warning| *warning == stop.to_string()));
}

#[test]
fn a_target_out_of_reach() {
    let experiment = run("[target]\n[[target.harmonic]]\nfrequency_hz = 1.0\nlinear_m = [0.2, 0.0, 0.0]\n");
    keeps_what_came_before(&experiment);
    let stop = experiment.stop.expect("a stop").to_string();
    assert!(stop.starts_with("the target motion stops at 0."), "{stop}");
    assert!(
        stop.contains("leg ") && stop.contains("perpendicular") || stop.contains("out of reach"),
        "{stop}"
    );
}

#[test]
fn a_target_past_the_stroke() {
    let experiment = run(
        "[limits]\nactuator_length_m = [0.18, 0.21]\n[target]\n[[target.harmonic]]\nfrequency_hz = 1.0\nlinear_m = [0.0, 0.0, 0.03]\n",
    );
    keeps_what_came_before(&experiment);
    let stop = experiment.stop.expect("a stop");
    assert!(matches!(stop.reason, StopReason::Stroke { leg: 0, .. }), "{stop}");
    assert_eq!(
        stop.to_string(),
        "the target motion stops at 0.064500 s: leg 1 (index 0) is past its stroke: the actuator would be 210.036 mm \
         long, and may have 180.000 to 210.000 mm; reduce the motion, or change the limits in the platform file or the \
         scenario"
    );
}

/// The stroke of the platform file counts without a word in the scenario, which can only narrow it.
#[test]
fn a_target_past_the_stroke_of_the_platform_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let platform = Path::new(env!("CARGO_MANIFEST_DIR")).join("../platforms/uhp_2016.toml");
    let text = std::fs::read_to_string(platform).expect("the default platform");
    let limited = text.replace("\n[legs]", "\n[legs]\nminimum_length_m = 0.19");
    assert_ne!(text, limited);
    std::fs::write(folder.path().join("limited.toml"), limited).expect("a file");
    let run = |limits: &str| {
        let target = "[target]\n[[target.harmonic]]\nfrequency_hz = 1.0\nlinear_m = [0.0, 0.0, -0.03]\n";
        let text = format!(
            "version = 1\nname = \"stop\"\nplatform = \"limited.toml\"\ngravity = true\nduration_s = 0.5\nstep_s = 1e-3\n{limits}{target}"
        );
        let scenario = Scenario::from_toml("stop.toml", &text, folder.path()).expect("a valid scenario");
        let experiment = experiment::run(&scenario, None, "test", &mut Silent);
        keeps_what_came_before(&experiment);
        experiment.stop.expect("a stop").to_string()
    };
    let stop = run("");
    assert!(stop.contains("189.") && stop.contains("may have 190.000 mm or more;"), "{stop}");
    let stop = run("[limits]\nactuator_length_m = [0.18, 0.21]\n");
    assert!(stop.contains("may have 190.000 to 210.000 mm;"), "{stop}");
    let stop = run("[limits]\nactuator_length_m = [0.195, 0.21]\n");
    assert!(stop.contains("may have 195.000 to 210.000 mm;"), "{stop}");
}

/// About y the legs of the default platform come into a singular pose at 1.09 rad, well within reach. No sample falls on
/// it, and the force that the target would need there is finite at every sample.
#[test]
fn a_target_through_a_singular_pose() {
    let experiment = run(
        "[target]\nrelative_to = \"base\"\n[[target.harmonic]]\nfrequency_hz = 1.0\nrotation_rad = [0.0, 1.13, 0.0]\n",
    );
    keeps_what_came_before(&experiment);
    let stop = experiment.stop.expect("a stop");
    assert_eq!(stop.reason, StopReason::Singular, "{stop}");
    let said = stop.to_string();
    assert!(said.starts_with("the target motion stops at 0.2"), "{said}");
    assert!(said.contains(" s: all legs together: just before they passed a singular pose"), "{said}");
}

#[test]
fn a_free_platform_that_turns_into_a_singular_pose() {
    for integrator in ["lie_rk4", "adaptive"] {
        let experiment = run(&format!(
            "integrator = \"{integrator}\"\n[free]\nrotation_rad = [0.0, 1.0, 0.0]\n\
             angular_velocity_rad_per_s = [0.0, 20.0, 0.0]\n"
        ));
        let stop = experiment.stop.as_ref().expect("a stop");
        assert_eq!(stop.reason, StopReason::Singular, "{integrator}: {stop}");
        assert!(stop.to_string().starts_with("the simulation stops at 0.0"), "{integrator}: {stop}");
        keeps_what_came_before(&experiment);
    }
}

/// Limits of force, rate and joint angles end nothing: a warning says which leg exceeds them, when and by how much.
#[test]
fn limits_of_the_platform_file_that_only_warn() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let platform = Path::new(env!("CARGO_MANIFEST_DIR")).join("../platforms/uhp_2016.toml");
    let text = std::fs::read_to_string(platform).expect("the default platform");
    let warnings = |limits: &str, target: &str| {
        let limited = text.replace("\n[legs]", &format!("\n[legs]\n{limits}"));
        assert_ne!(text, limited);
        std::fs::write(folder.path().join("limited.toml"), limited).expect("a file");
        let scenario = format!(
            "version = 1\nname = \"limits\"\nplatform = \"limited.toml\"\ngravity = true\nduration_s = 1.0\n\
             step_s = 1e-3\n[target]\n[[target.harmonic]]\nfrequency_hz = 1.0\n{target}\n"
        );
        let scenario = Scenario::from_toml("stop.toml", &scenario, folder.path()).expect("a valid scenario");
        let experiment = experiment::run(&scenario, None, "test", &mut Silent);
        assert_eq!(experiment.stop, None);
        experiment.outcome.warnings
    };
    // Straight up and down every leg moves at up to 2 pi 20 mm/s, keeps its rod's direction, and needs on top 30.493 N of
    // home, 21 555.9 N/m 20 mm, less 15.902 kg (2 pi)^2 20 mm/s^2 / 6.
    let lift = "linear_m = [0.0, 0.0, 0.02]";
    let angles = "maximum_hooke_joint_angle_rad = 1e-6\nmaximum_platform_joint_angle_rad = 1e-6\n";
    let said =
        warnings(&format!("maximum_force_n = 460.0\nmaximum_velocity_m_per_s = 0.126\n{angles}"), lift);
    assert_eq!(said, Vec::<String>::new());
    let said =
        warnings(&format!("maximum_force_n = 459.0\nmaximum_velocity_m_per_s = 0.125\n{angles}"), lift);
    assert_eq!(said.len(), 2, "{said:?}");
    let force = " needs 459.5184 N at 0.250000 s, beyond its limit of 459 N (`maximum_force_n`); a limit of this kind is \
                 exceeded from 0.243000 s on";
    assert!(said[0].starts_with("leg ") && said[0].ends_with(force), "{said:?}");
    assert!(
        said[1].contains(" moves at 0.1257 m/s at ") && said[1].contains("from 0.000000 s on"),
        "{said:?}"
    );
    let said = warnings(angles, "rotation_rad = [0.0, 0.0, 0.01]");
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(said[0].contains(" turns its Hooke joint by 0.0") && said[0].contains(" rad at "), "{said:?}");
    assert!(said[1].contains(" turns its joint on the platform by 0.0"), "{said:?}");
}

#[test]
fn a_free_platform_pushed_too_far() {
    for integrator in ["lie_rk4", "adaptive"] {
        let experiment = run(&format!(
            "integrator = \"{integrator}\"\n[free]\nactuator_force_n = [9000.0, 0.0, 0.0, 0.0, 0.0, 0.0]\n"
        ));
        keeps_what_came_before(&experiment);
        let stop = experiment.stop.expect("a stop").to_string();
        assert!(stop.starts_with("the simulation stops at 0.0"), "{integrator}: {stop}");
        assert!(stop.contains("leg "), "{integrator}: {stop}");
    }
}

/// Exit code 3, tables as JSON, the report kept.
#[test]
fn on_the_command_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let platform = Path::new(env!("CARGO_MANIFEST_DIR")).join("../platforms/uhp_2016.toml");
    std::fs::copy(platform, folder.path().join("uhp_2016.toml")).expect("a copy");
    let run = |name: &str, tables: &str, arguments: &[&str]| {
        let file = folder.path().join(format!("{name}.toml"));
        let text = format!(
            "version = 1\nname = \"{name}\"\nplatform = \"uhp_2016.toml\"\ngravity = true\nduration_s = 0.2\nstep_s = 1e-3\n{tables}"
        );
        std::fs::write(&file, text).expect("a file");
        let mut command = Command::new(env!("CARGO_BIN_EXE_dyn-sim"));
        command.args([arguments[0]]).arg(&file).args(&arguments[1..]).current_dir(folder.path());
        command.output().expect("dyn-sim runs")
    };
    let good = "[target]\n[[target.harmonic]]\nfrequency_hz = 5.0\nlinear_m = [0.01, 0.0, 0.0]\n";
    let far = "[target]\n[[target.harmonic]]\nfrequency_hz = 5.0\nlinear_m = [0.2, 0.0, 0.0]\n";

    let output = run("good", good, &["run", "--json", "--output", "report"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let tables: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(tables["amplitude_tables"][0]["error_percent"][0][0].as_f64().expect("a number") < 1e-4);
    assert!(tables["amplitude_tables"][0]["error_percent"][0][1].is_null(), "no target, no error");
    assert!(folder.path().join("report/index.html").is_file());

    let output = run("far", far, &["run", "--output", "kept"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("warning: the target motion stops at"), "{said}");
    assert!(folder.path().join("kept/index.html").is_file());

    let output = run("bad", "", &["check"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("neither [target] nor [free]"));
}
