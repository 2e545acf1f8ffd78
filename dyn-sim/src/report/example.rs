//! A made-up outcome in the size of the published experiment, for the tests of the report.

use std::f64::consts::TAU;

use crate::outcome::{AmplitudeTable, Outcome, Series, TimeErrors};

const FREQUENCIES_HZ: [f64; 3] = [40.0, 100.0, 200.0];
/// The paper's Table 2, m/s^2, rad/s^2.
const BASE: [[f64; 6]; 3] = [
    [4.0e-4, 5.0e-4, 3.0e-4, 0.001, 0.002, 0.002],
    [2.0e-4, 4.0e-4, 4.0e-4, 0.002, 0.003, 0.002],
    [5.0e-4, 7.0e-4, 4.0e-4, 0.006, 0.008, 0.007],
];
/// The paper's Table 3.
const TARGET: [[f64; 6]; 3] = [
    [4.0e-3, 2.0e-3, 3.0e-3, 0.020, 0.020, 0.010],
    [3.0e-3, 1.0e-3, 4.0e-3, 0.030, 0.025, 0.020],
    [4.0e-3, 4.0e-3, 6.0e-3, 0.050, 0.060, 0.030],
];
/// The paper's Table 4.
const PAPER: [[f64; 6]; 3] = [
    [0.25, 1.8, 2.07, 1.80, 5.15, 2.98],
    [0.70, 4.62, 2.38, 2.53, 5.40, 2.80],
    [1.08, 2.75, 2.07, 3.12, 5.12, 2.27],
];
const STEP_S: f64 = 5e-4;
const STEPS: usize = 400;

/// The default platform.
pub(crate) fn platform() -> dyn_platform::Platform {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../platforms/uhp_2016.toml");
    dyn_platform::Platform::from_file(path).expect("the default platform")
}

fn time_errors(label: &str, relative: f64, position_m: f64) -> TimeErrors {
    TimeErrors {
        label: label.into(),
        reference: "target".into(),
        acceleration_relative: relative,
        linear_m_s2: 1e-2 * relative,
        angular_rad_s2: 1e-1 * relative,
        position_m,
    }
}

/// Harmonics of the amplitudes, each relative error `error` too large.
fn series(label: &str, amplitudes: &[[f64; 6]; 3], error: f64, height_m: f64) -> Series {
    let time_s: Vec<f64> = (0..=STEPS).map(|k| k as f64 * STEP_S).collect();
    let sum = |t: f64, i: usize, power: i32| -> f64 {
        let harmonics = FREQUENCIES_HZ.iter().zip(amplitudes).zip(1..);
        let parts = harmonics.map(|((hz, row), number)| {
            let w = TAU * hz;
            let wave = match power {
                0 => (w * t).sin(),
                1 => -(w * t).cos() / w,
                _ => -(w * t).sin() / (w * w),
            };
            row[i] * (1.0 + error * f64::from(number) * (1.0 + i as f64)) * wave
        });
        parts.sum()
    };
    let six = |power: i32| time_s.iter().map(|t| std::array::from_fn(|i| sum(*t, i, power))).collect();
    let position_m = time_s.iter().map(|t| [sum(*t, 0, 2), sum(*t, 1, 2), height_m + sum(*t, 2, 2)]);
    Series {
        label: label.into(),
        position_m: position_m.collect(),
        rotation: vec![[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]; STEPS + 1],
        velocity: six(1),
        acceleration: six(0),
        time_s,
    }
}

fn table(label: &str, error: f64) -> AmplitudeTable {
    let factor = |row: usize, i: usize| error * (1.0 + row as f64) * (1.0 + i as f64);
    let rows = |value: &dyn Fn(usize, usize) -> f64| -> Vec<[f64; 6]> {
        (0..3).map(|row| std::array::from_fn(|i| value(row, i))).collect()
    };
    AmplitudeTable {
        label: label.into(),
        frequencies_hz: FREQUENCIES_HZ.into(),
        error_percent: rows(&|row, i| 100.0 * factor(row, i)),
        amplitude: rows(&|row, i| TARGET[row][i] * (1.0 + factor(row, i))),
        target_amplitude: TARGET.into(),
        paper_percent: Some(PAPER.into()),
    }
}

/// Two simulations of the published experiment, as if they had been run.
pub(crate) fn outcome() -> Outcome {
    let target = series("target", &TARGET, 0.0, 0.382);
    let force =
        |t: f64, leg: usize| (TAU * 40.0 * t + leg as f64).sin() * 0.02 + (TAU * 200.0 * t).cos() * 0.05;
    let length = |t: f64, leg: usize| 0.198_21 + 4e-8 * (TAU * 40.0 * t + leg as f64).sin();
    let legs = |value: &dyn Fn(f64, usize) -> f64| {
        target.time_s.iter().map(|t| std::array::from_fn(|leg| value(*t, leg))).collect()
    };
    Outcome {
        scenario_name: "published".into(),
        description: "An example for tests".into(),
        scenario_text: "name = \"published\"\nplatform = \"uhp_2016.toml\"\nduration_s = 0.2 # < 1 & more\n"
            .into(),
        platform: platform(),
        step_s: STEP_S,
        base: series("base", &BASE, 0.0, 0.0),
        actuator_force_n: legs(&force),
        actuator_length_m: legs(&length),
        simulations: vec![
            series("dyn-gen", &TARGET, 3e-10, 0.382),
            series("Exudyn 1.13.8", &TARGET, 2.2e-6, 0.382),
        ],
        target,
        amplitude_tables: vec![table("dyn-gen", 3e-10), table("Exudyn 1.13.8", 2.2e-6)],
        time_errors: vec![time_errors("dyn-gen", 6e-9, 2e-15), time_errors("Exudyn 1.13.8", 3.2e-5, 4.1e-11)],
        versions: vec![("dyn-sim".into(), "0.1.0".into()), ("Exudyn".into(), "1.13.8".into())],
        seconds: vec![("inverse dynamics".into(), 0.012), ("virtual prototype, Exudyn".into(), 3.41)],
        warnings: vec!["the record is 0.2 s: 8 periods of 40 Hz".into()],
        command: "dyn-sim reproduce --scenario published --output report/published".into(),
    }
}
