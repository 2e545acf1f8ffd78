//! Sweeps: what they find is what single simulations find, and what they refuse.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use dyn_runtime::{BaseMotion, PlatformState};
use dyn_sim::experiment::Silent;
use dyn_sim::mechanism::{self, Mechanism};
use dyn_sim::motion::BodyMotion;
use dyn_sim::scenario::Steering;
use dyn_sim::simulate::{Drive, forces_along, sample, simulate};
use dyn_sim::sweep::{self, Found, Sweep, Swept, measures};

const TOOL: &str = env!("CARGO_BIN_EXE_dyn-sim");

const FREE: &str = "version = 1\nname = \"free\"\nplatform = \"uhp_2016.toml\"\ngravity = true\nduration_s = 0.05\nstep_s = 5e-4\n\
                    [base]\n[[base.harmonic]]\nfrequency_hz = 30.0\nlinear_m_per_s2 = [1.0, 0.5, 2.0]\n\
                    [spectrum]\nfrequencies_hz = []\nstart_s = 0.01\n\
                    [free]\nposition_m = [0.0, 0.0, 0.001]\n";
const TARGET: &str = "version = 1\nname = \"target\"\nplatform = \"uhp_2016.toml\"\ngravity = false\nduration_s = 0.1\nstep_s = 1e-3\n\
                      [target]\n[[target.harmonic]]\nfrequency_hz = 20.0\nlinear_m = [0.003, 0.0, 0.002]\n";

/// A folder with the scenarios, their platform, and a sweep.
struct Bench(tempfile::TempDir);

impl Bench {
    fn new(sweep: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let platform = Path::new(env!("CARGO_MANIFEST_DIR")).join("../platforms/uhp_2016.toml");
        fs::copy(platform, folder.path().join("uhp_2016.toml")).expect("a copy");
        for (name, text) in [("free.toml", FREE), ("target.toml", TARGET), ("sweep.toml", sweep)] {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        Self(folder)
    }

    fn sweep(&self) -> Sweep {
        Sweep::from_file(&self.0.path().join("sweep.toml")).expect("a sound sweep")
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(TOOL);
        command.args(["sweep", "sweep.toml", "--output", "report"]).args(arguments);
        command.current_dir(self.0.path()).output().expect("dyn-sim runs")
    }

    /// Exit code 1, and a message with these words.
    fn refused(sweep: &str, words: &[&str]) {
        let output = Self::new(sweep).run(&[]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{said}");
        for word in words.iter().chain(&["sweep.toml:", "help:"]) {
            assert!(said.contains(word), "no {word:?} in {said}");
        }
    }
}

fn swept(sweep: &Sweep, threads: usize) -> Swept {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    sweep::run(sweep, &pool, &mut Silent)
}

fn close(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs() + 1e-15, "{what}: {found:e} {expected:e}");
}

/// Payloads, tolerances of every spring, starts; designs of different bases.
const MANY: &str = "version = 1\nname = \"many\"\nscenario = \"free.toml\"\nhold = true\ndesigns = 70\nseed = 3\n\
                    [[vary]]\nplatform = \"payload.mass_kg\"\nfrom = 4.0\nto = 8.0\n\
                    [[vary]]\nplatform = \"circular_layout.platform_radius_m\"\nrelative = 0.02\n\
                    [[vary]]\nparameter = \"axial_stiffness\"\nrelative = 0.05\n\
                    [[vary]]\nscenario = \"free.position_m.2\"\nabsolute = 0.001\n";

#[test]
fn free_platforms_move_as_single_simulations_say() {
    for base in ["", "[[vary]]\nscenario = \"base.harmonic.0.frequency_hz\"\nvalues = [20.0, 30.0]\n"] {
        let bench = Bench::new(&format!("{MANY}{base}"));
        let sweep = bench.sweep();
        let swept = swept(&sweep, 2);
        for k in [0, 7, 63, 69] {
            let (numbers, design) = &swept.designs[k];
            let design = design.as_ref().expect("a sound design");
            let Steering::Free(start, force) = &design.steering else { panic!("nobody steers it") };
            let scenario = sweep.scenario_with(numbers).expect("a sound scenario");
            let single = mechanism::Model::with_gravity(mechanism::run_time_model(&scenario.platform));
            // Its own forces hold it where it starts, above a base at rest.
            let at_rest = BaseMotion::at_rest(scenario.base.at(0.0).pose);
            let left = single
                .forward_dynamics(&at_rest, &PlatformState::at_rest(start.pose), force)
                .expect("in reach");
            assert!(left.to_vector().amax() < 1e-9, "{left:?}");
            let grid = scenario.grid;
            let base: Vec<BaseMotion> =
                sample(grid, &scenario.base, |_| {}).iter().map(BodyMotion::as_base).collect();
            let drive = Drive { grid, actuator_force_n: vec![*force; base.len()], base };
            let run = simulate(&single, &drive, start, None, |_| {});
            let found = swept.found[k].as_ref().expect("computed");
            let counted = scenario.spectrum.first_step..grid.steps;
            for i in 0..6 {
                let of = |step: usize| run.series.acceleration[step][i];
                let square: f64 = counted.clone().map(|step| of(step) * of(step)).sum();
                close(found.rms_acceleration[i], (square / counted.len() as f64).sqrt(), "rms");
                let peak = counted.clone().fold(0.0_f64, |peak, step| peak.max(of(step).abs()));
                close(found.peak_acceleration[i], peak, "peak");
                let lengths: Vec<f64> = (0..grid.steps)
                    .map(|step| length(&single, &drive.base[2 * step], &run.series.state(step), i))
                    .collect();
                close(found.shortest_m[i], lengths.iter().copied().fold(f64::INFINITY, f64::min), "shortest");
                close(found.longest_m[i], lengths.iter().copied().fold(0.0, f64::max), "longest");
                close(found.force_n[i], force[i].abs(), "force");
                let of_base = |step: usize| drive.base[2 * step].acceleration.to_vector()[i];
                let square: f64 = counted.clone().map(|step| of_base(step) * of_base(step)).sum();
                close(
                    found.base_rms_acceleration[i],
                    (square / counted.len() as f64).sqrt(),
                    "rms of the base",
                );
            }
            let rms = &found.rms_acceleration;
            let linear = norm(&rms[..3]);
            close(measured("rms_linear_m_per_s2", &design.steering, found), linear, "linear");
            close(measured("rms_angular_rad_per_s2", &design.steering, found), norm(&rms[3..]), "angular");
            let of_base = norm(&found.base_rms_acceleration[..3]);
            let transmissibility = measured("transmissibility_percent", &design.steering, found);
            close(transmissibility, 100.0 * linear / of_base, "transmissibility");
        }
    }
}

fn norm(numbers: &[f64]) -> f64 {
    numbers.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A number of the table.
fn measured(name: &str, steering: &Steering, found: &Found) -> f64 {
    let measure = measures(steering).into_iter().find(|measure| measure.name == name).expect("a column");
    (measure.of)(found)
}

fn length(single: &dyn Mechanism, base: &BaseMotion, platform: &PlatformState, leg: usize) -> f64 {
    single.leg_kinematics(base, platform).expect("in reach").actuator_length_m[leg]
}

#[test]
fn platforms_along_a_target_take_the_forces_of_single_calls() {
    for varied in ["platform = \"payload.com_m.2\"", "scenario = \"target.harmonic.0.linear_m.0\""] {
        let vary = format!("[[vary]]\n{varied}\nfrom = 0.001\nto = 0.004\nsteps = 11\n");
        let bench = Bench::new(&format!("version = 1\nname = \"t\"\nscenario = \"target.toml\"\n{vary}"));
        let sweep = bench.sweep();
        let swept = swept(&sweep, 1);
        assert_eq!(swept.designs.len(), 11);
        for k in [0, 3, 8, 10] {
            let scenario = sweep.scenario_with(&swept.designs[k].0).expect("a sound scenario");
            let (single, _) = mechanism::of_platform(&scenario.platform, false);
            let Steering::Target(target) = &scenario.steering else { panic!("a target") };
            let grid = scenario.grid;
            let (base, target) = (sample(grid, &scenario.base, |_| {}), sample(grid, target, |_| {}));
            let (drive, stop) = forces_along(&*single, grid, &base, &target, None, |_| {});
            assert_eq!(stop, None);
            let found = swept.found[k].as_ref().expect("computed");
            for leg in 0..6 {
                let forces = drive.actuator_force_n.iter().step_by(2).map(|force| force[leg].abs());
                close(found.force_n[leg], forces.fold(0.0, f64::max), "force");
                let lengths = (0..=grid.steps)
                    .map(|k| length(&*single, &drive.base[2 * k], &target[2 * k].as_platform(), leg));
                close(found.longest_m[leg], lengths.clone().fold(0.0, f64::max), "longest");
                close(found.shortest_m[leg], lengths.fold(f64::INFINITY, f64::min), "shortest");
            }
            let of_all = |name| measured(name, &scenario.steering, found);
            let largest = |numbers: [f64; 6]| numbers.into_iter().fold(f64::NEG_INFINITY, f64::max);
            close(of_all("peak_force_n"), largest(found.force_n), "largest force");
            close(of_all("longest_length_m"), largest(found.longest_m), "longest of all");
            close(of_all("shortest_length_m"), -largest(found.shortest_m.map(|x| -x)), "shortest of all");
            let travels = std::array::from_fn(|leg| found.longest_m[leg] - found.shortest_m[leg]);
            close(of_all("travel_m"), largest(travels), "travel");
        }
        // What varies matters.
        let force = |k: usize| swept.found[k].as_ref().expect("computed").force_n;
        assert_ne!(force(0), force(10));
    }
}

/// Numbers are drawn from the whole of their range and from nowhere else.
#[test]
fn draws_fill_their_ranges() {
    let values = "[[vary]]\nscenario = \"base.harmonic.0.frequency_hz\"\nvalues = [20.0, 30.0]\n";
    let sweep = Bench::new(&format!("{MANY}{values}")).sweep();
    let labels = sweep.labels();
    let numbers = sweep.numbers();
    let mut ranges = vec![(4.0, 8.0), (0.98 * 0.12, 1.02 * 0.12)];
    ranges.extend([(0.95 * 21_555.9, 1.05 * 21_555.9); 6]);
    ranges.extend([(0.0, 0.002), (20.0, 30.0)]);
    assert_eq!(labels.len(), ranges.len(), "{labels:?}");
    for (k, (label, (least, most))) in labels.iter().zip(ranges).enumerate() {
        let drawn = || numbers.iter().map(|design| design[k]);
        assert!(drawn().all(|number| (least..=most).contains(&number)), "{label}");
        // Of 70 none in an outer fifth of the range happens once in six million times.
        let fifth = 0.2 * (most - least);
        assert!(drawn().any(|number| number < least + fifth), "{label}");
        assert!(drawn().any(|number| number > most - fifth), "{label}");
    }
}

/// A tolerance of a parameter is added to what another variation makes of it.
#[test]
fn tolerances_add_to_what_else_varies() {
    let sweep = Bench::new(
        "version = 1\nname = \"t\"\nscenario = \"free.toml\"\ndesigns = 3\n\
         [[vary]]\nplatform = \"legs.axial_stiffness_n_per_m\"\nfrom = 10000.0\nto = 11000.0\n\
         [[vary]]\nparameter = \"axial_stiffness\"\nabsolute = 50.0\n",
    )
    .sweep();
    for numbers in sweep.numbers() {
        let scenario = sweep.scenario_with(&numbers).expect("a sound scenario");
        let stiffness = scenario.platform.parameter("axial_stiffness").expect("a parameter");
        for (found, drawn) in stiffness.iter().zip(&numbers[1..]) {
            close(*found, numbers[0] + (drawn - 21_555.9), "stiffness");
        }
    }
}

/// A leg that is too short, too long or too strong for the platform file's limits is named.
#[test]
fn limits_that_are_exceeded_are_named() {
    let bench = Bench::new(
        "version = 1\nname = \"t\"\nscenario = \"target.toml\"\n[[vary]]\nplatform = \"payload.mass_kg\"\nvalues = [6.0]\n",
    );
    let file = bench.0.path().join("uhp_2016.toml");
    let unlimited = fs::read_to_string(&file).expect("a platform");
    let exceeded = |limit: &str| {
        fs::write(&file, unlimited.replacen("[legs]", &format!("[legs]\n{limit} "), 1)).expect("a file");
        swept(&bench.sweep(), 1).found[0].as_ref().expect("computed").exceeded.clone()
    };
    assert_eq!(exceeded(""), None);
    let found = swept(&bench.sweep(), 1).found[0].clone().expect("computed");
    for (key, what, numbers, beyond) in [
        ("minimum_length_m", "length", found.shortest_m, -1e-6),
        ("maximum_length_m", "length", found.longest_m, 1e-6),
        ("maximum_force_n", "force", found.force_n, 1e-6),
    ] {
        // Between the worst leg and the others, so that it alone exceeds the limit.
        let (worst, most) = numbers.iter().enumerate().fold((0, numbers[0]), |worst, (leg, x)| {
            if beyond * (x - worst.1) > 0.0 { (leg, *x) } else { worst }
        });
        let first = numbers.iter().position(|x| (x - most).abs() < 1e-9).expect("the worst");
        assert!(worst >= first, "{key}: of two alike the first is named");
        assert_eq!(exceeded(&format!("{key} = {}", most + beyond)), None, "{key}");
        let named = exceeded(&format!("{key} = {}", most - beyond));
        assert_eq!(named, Some(format!("{what} of leg {}", first + 1)), "{key}");
    }
}

/// A design that cannot go on ends there; what came before is kept.
#[test]
fn designs_end_where_they_cannot_go_on() {
    let bench = Bench::new(
        "version = 1\nname = \"t\"\nscenario = \"target.toml\"\n\
         [[vary]]\nscenario = \"target.harmonic.0.linear_m.0\"\nvalues = [0.5, 0.003]\n",
    );
    let sweep = bench.sweep();
    let followed = swept(&sweep, 1);
    let scenario = sweep.scenario_with(&followed.designs[0].0).expect("a sound scenario");
    let (single, _) = mechanism::of_platform(&scenario.platform, false);
    let Steering::Target(target) = &scenario.steering else { panic!("a target") };
    let grid = scenario.grid;
    let (base, target) = (sample(grid, &scenario.base, |_| {}), sample(grid, target, |_| {}));
    let (drive, stop) = forces_along(&*single, grid, &base, &target, None, |_| {});
    let stop = stop.expect("half a metre aside is out of reach");
    let found = followed.found[0].as_ref().expect("computed");
    let ending = found.ended.as_ref().expect("an end");
    // A single call looks at half steps too.
    assert!((0.0..=grid.step_s).contains(&(ending.time_s - stop.time_s)), "{ending:?} {}", stop.time_s);
    let before = (ending.time_s / grid.step_s).round() as usize;
    for leg in 0..6 {
        let lengths =
            (0..before).map(|k| length(&*single, &base[2 * k].as_base(), &target[2 * k].as_platform(), leg));
        close(found.longest_m[leg], lengths.fold(0.0, f64::max), "longest");
        let forces = drive.actuator_force_n.iter().step_by(2).take(before).map(|force| force[leg].abs());
        close(found.force_n[leg], forces.fold(0.0, f64::max), "force");
    }
    assert_eq!(followed.found[1].as_ref().expect("computed").ended, None);

    let bench = Bench::new(
        "version = 1\nname = \"f\"\nscenario = \"free.toml\"\n\
         [[vary]]\nscenario = \"free.actuator_force_n.0\"\nvalues = [9000.0, 30.0]\n",
    );
    let pushed = format!("{FREE}actuator_force_n = [30.0, 30.0, 30.0, 30.0, 30.0, 30.0]\n");
    fs::write(bench.0.path().join("free.toml"), pushed).expect("a file");
    let sweep = bench.sweep();
    let flown = swept(&sweep, 1);
    let scenario = sweep.scenario_with(&flown.designs[0].0).expect("a sound scenario");
    let Steering::Free(start, force) = &scenario.steering else { panic!("nobody steers it") };
    let single = mechanism::Model::with_gravity(mechanism::run_time_model(&scenario.platform));
    let grid = scenario.grid;
    let base: Vec<BaseMotion> =
        sample(grid, &scenario.base, |_| {}).iter().map(BodyMotion::as_base).collect();
    let drive = Drive { grid, actuator_force_n: vec![*force; base.len()], base };
    let run = simulate(&single, &drive, start, None, |_| {});
    let stop = run.stop.expect("9 kN push a leg out of reach");
    let found = flown.found[0].as_ref().expect("computed");
    let ending = found.ended.as_ref().expect("an end");
    assert!((ending.time_s - stop.time_s).abs() <= 8.0 * grid.step_s, "{ending:?} {}", stop.time_s);
    let longest = found.longest_m[0];
    let before = (ending.time_s / grid.step_s).round() as usize;
    let lengths = (0..before.min(run.series.time_s.len()))
        .map(|step| length(&single, &drive.base[2 * step], &run.series.state(step), 0));
    close(longest, lengths.fold(0.0, f64::max), "longest before the end");
    assert_eq!(flown.found[1].as_ref().expect("computed").ended, None);
}

#[test]
fn threads_and_repetition_change_nothing() {
    let bench = Bench::new(MANY);
    let sweep = bench.sweep();
    let numbers =
        |swept: &Swept| swept.designs.iter().map(|(numbers, _)| numbers.clone()).collect::<Vec<_>>();
    let (one, two) = (swept(&sweep, 1), swept(&sweep, 2));
    assert_eq!(numbers(&one), numbers(&two));
    assert_eq!(one.found, two.found);
    let mut other = sweep.clone();
    other.random = Some((70, 4));
    assert_ne!(numbers(&swept(&other, 1)), numbers(&one));
}

#[test]
fn designs_that_cannot_be_are_lines_of_the_table() {
    let bench = Bench::new(
        "version = 1\nname = \"far\"\nscenario = \"target.toml\"\n\
         [[vary]]\nplatform = \"legs.rod_length_m\"\nvalues = [0.05, 0.206]\n\
         [[vary]]\nscenario = \"target.harmonic.0.linear_m.0\"\nvalues = [0.003, 0.5]\n",
    );
    let output = bench.run(&[]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains("1 computed, 1 ended early, 2 refused"), "{said}");
    assert!(said.contains("designs per second"), "{said}");
    let table = fs::read_to_string(bench.0.path().join("report/csv/designs.csv")).expect("a table");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 5, "{table}");
    assert!(
        lines[0].starts_with("design,legs.rod_length_m,target.harmonic.0.linear_m.0,outcome,peak_force_n")
    );
    assert!(lines[1].starts_with("0,0.05,0.003,refused,"), "{table}");
    assert!(lines[3].starts_with("2,0.206,0.003,ok,"), "{table}");
    assert!(lines[4].starts_with("3,0.206,0.5,ended,") && lines[4].contains("is out of reach"), "{table}");
    for file in ["index.html", "svg/in_order.svg", "svg/over_legs_rod_length_m.svg"] {
        assert!(bench.0.path().join("report").join(file).is_file(), "{file}");
    }
    let again = bench.run(&["--json"]);
    let json: serde_json::Value = serde_json::from_slice(&again.stdout).expect("JSON");
    assert_eq!(json["designs"][3]["outcome"], "ended");
    assert_eq!(json["designs"][2]["numbers"]["legs.rod_length_m"], 0.206);
    assert!(json["designs"][0]["found"]["peak_force_n"].is_null());
    assert!(json["designs"][2]["found"]["peak_force_n"].as_f64().is_some_and(|force| force > 1.0));
}

#[test]
fn mistakes_are_shown_where_they_are() {
    let head = "version = 1\nname = \"s\"\nscenario = \"free.toml\"\n";
    let with = |vary: &str| format!("{head}[[vary]]\n{vary}\n");
    Bench::refused(
        &with("platform = \"payload.mas_kg\"\nvalues = [1.0]"),
        &["did you mean `payload.mass_kg`?", "sweep.toml:5"],
    );
    Bench::refused(&with("platform = \"payload.mass_kg\"\nfrom = 5.0\nto = 4.0\nsteps = 3"), &["in one way"]);
    Bench::refused(&with("platform = \"payload.mass_kg\"\nfrom = 4.0\nto = 5.0"), &["a range needs `steps`"]);
    Bench::refused(
        &with("platform = \"payload.mass_kg\"\nrelative = 0.1"),
        &["drawn at random", "designs = 1000"],
    );
    Bench::refused(
        &with("parameter = \"axial_stifness\"\nrelative = 0.1"),
        &["did you mean `axial_stiffness`?"],
    );
    Bench::refused(&with("parameter = \"axial_stiffness\"\nvalues = [1.0]"), &["each for itself"]);
    Bench::refused(&with("scenario = \"step_s\"\nvalues = [1.0]"), &["must be the same for all designs"]);
    Bench::refused(&with("values = [1.0]"), &["names one thing that varies"]);
    Bench::refused(head, &["nothing varies"]);
    Bench::refused(&head.replace("free.toml", "fre.toml"), &["there is no scenario file"]);
    Bench::refused(&head.replace("version = 1", "version = 2"), &["must be 1"]);
    Bench::refused(
        &format!("{head}seed = 1\n[[vary]]\nplatform = \"payload.mass_kg\"\nvalues = [5.0]\n"),
        &["`seed` means nothing"],
    );
    Bench::refused(
        &format!("{head}designs = 0\n[[vary]]\nplatform = \"payload.mass_kg\"\nrelative = 0.1\n"),
        &["how many"],
    );
    Bench::refused(
        &format!("{head}desings = 5\n[[vary]]\nplatform = \"payload.mass_kg\"\nrelative = 0.1\n"),
        &["did you mean `designs`?"],
    );
    let tenth = "values = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\n";
    let many = format!("[[vary]]\nplatform = \"payload.mass_kg\"\n{tenth}").repeat(7);
    Bench::refused(&format!("{head}{many}"), &["10000000 designs"]);
    Bench::refused(
        &format!(
            "{}hold = true\n[[vary]]\nplatform = \"payload.mass_kg\"\nvalues = [5.0]\n",
            head.replace("free", "target")
        ),
        &["nothing is to be held"],
    );
}

#[test]
fn no_design_at_all_is_a_failure() {
    let output = Bench::new("version = 1\nname = \"s\"\nscenario = \"free.toml\"\n[[vary]]\nplatform = \"payload.mass_kg\"\nvalues = [-1.0]\n").run(&[]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert!(said.contains("none of the 1 designs can be computed") && said.contains("mass_kg"), "{said}");
}
