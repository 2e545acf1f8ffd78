//! Amplitudes of known signals.

use std::f64::consts::TAU;

use dyn_sim::spectrum::{Plan, Window};

/// Amplitude, frequency, phase of sines, the same in all components but for a factor.
fn signal(lines: &[(f64, f64, f64)], step: f64, samples: usize) -> Vec<[f64; 6]> {
    let value =
        |k: usize| -> f64 { lines.iter().map(|(a, f, p)| a * (TAU * f * step * k as f64 + p).sin()).sum() };
    (0..samples).map(|k| std::array::from_fn(|i| value(k) * (1.0 + i as f64))).collect()
}

#[test]
fn whole_periods_are_exact() {
    let (step, lines) = (1e-3, [(2.0, 40.0, 0.3), (0.5, 100.0, -1.2), (1.0, 120.0, 2.0)]);
    let frequencies = lines.map(|line| line.1);
    // From the second period on: phases still count from time zero.
    let plan = Plan::new(50, 550, step, &frequencies, Window::Auto);
    assert_eq!(plan.warning, None);
    assert!(!plan.is_hann());
    let amplitudes = plan.amplitudes(&signal(&lines, step, 600), &frequencies);
    for ((a, _, p), row) in lines.iter().zip(&amplitudes) {
        for (i, found) in row.iter().enumerate() {
            let (size, phase) = ((1.0 + i as f64) * a, found.arg() - p);
            assert!((found.norm() - size).abs() < 1e-12 * size, "{found}");
            assert!(phase.sin().abs() < 1e-12 && phase.cos() > 0.0, "{found}");
        }
    }
    let (found, magnitudes) = plan.magnitudes(&signal(&lines, step, 600));
    let at = found.iter().position(|f| (f - 100.0).abs() < 1e-9).expect("a line at 100 Hz");
    assert!((magnitudes[at][0] - 0.5).abs() < 1e-12);
    assert!(magnitudes[at + 1][0] < 1e-12);
}

#[test]
fn partial_periods_warn_and_take_hann() {
    let (step, lines) = (1e-3, [(2.0, 40.0, 0.3), (0.5, 100.0, -1.2)]);
    let frequencies = lines.map(|line| line.1);
    let plan = Plan::new(0, 513, step, &frequencies, Window::Auto);
    let warning = plan.warning.clone().expect("513 ms are no whole periods");
    assert_eq!(
        warning,
        "the spectrum spans 0.513000 s, not a whole number of periods of 40 Hz (20.520 periods), 100 Hz (51.300 periods): \
         Hann's window is used, and neighbouring lines still leak a little"
    );
    let leak = |window| {
        let plan = Plan::new(0, 513, step, &frequencies, window);
        let found = plan.amplitudes(&signal(&lines, step, 513), &frequencies);
        (found[1][0].norm() / 0.5 - 1.0).abs()
    };
    let (hann, rectangular) = (leak(Window::Auto), leak(Window::Rectangular));
    assert!(hann < 1e-3, "{hann:e}");
    assert!(rectangular > 10.0 * hann, "{rectangular:e} {hann:e}");
}

#[test]
fn a_constant_and_the_highest_line_stand_alone() {
    let plan = Plan::new(0, 8, 0.125, &[], Window::Rectangular);
    let signal: Vec<[f64; 6]> = (0..8).map(|k| [3.0 + if k % 2 == 0 { 1.0 } else { -1.0 }; 6]).collect();
    let (frequencies, magnitudes) = plan.magnitudes(&signal);
    assert_eq!(frequencies, [0.0, 1.0, 2.0, 3.0, 4.0]);
    assert!((magnitudes[0][0] - 3.0).abs() < 1e-15 && (magnitudes[4][0] - 1.0).abs() < 1e-15);
}
