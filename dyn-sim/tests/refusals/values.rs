//! Values that mean nothing, or contradict each other.

use expect_test::expect;

use crate::{check, check_text, with};

#[test]
fn several_mistakes() {
    let text =
        with("duration_s = 0.5", "duration_s = -1").replace("frequency_hz = 5.0", "frequency_hz = nan");
    check_text(
        &text,
        expect![[r#"
        Error:
          × bench.toml: 2 mistakes

        Error:
          × `duration_s` must be positive and finite, but is -1
           ╭─[bench.toml:5:14]
         4 │ gravity = true
         5 │ duration_s = -1
           ·              ─┬
           ·               ╰── must be positive
         6 │ step_s = 1e-3
           ╰────
          help: for example `duration_s = 1.0`

        Error:
          × `frequency_hz` must be positive and finite, but is NaN
            ╭─[bench.toml:10:16]
          9 │ [[base.harmonic]]
         10 │ frequency_hz = nan
            ·                ─┬─
            ·                 ╰── must be positive
         11 │ linear_m_per_s2 = [0.1, 0.0, 0.0]
            ╰────
          help: for example `frequency_hz = 40.0`
    "#]],
    );
}

#[test]
fn broken_steps() {
    check(
        "duration_s = 0.5",
        "duration_s = 0.5005",
        expect![[r#"
        Error:
          × `duration_s` is 500.500000 steps, not a whole number of them
           ╭─[bench.toml:5:14]
         4 │ gravity = true
         5 │ duration_s = 0.5005
           ·              ───┬──
           ·                 ╰── not a whole number of steps
         6 │ step_s = 1e-3
           ╰────
          help: choose a duration of 5e-1 s, or another step
    "#]],
    );
}

#[test]
fn too_many_steps() {
    check(
        "step_s = 1e-3",
        "step_s = 1e-9",
        expect![[r#"
        Error:
          × 500000000 steps are more than 2000000, the most that memory is made for
           ╭─[bench.toml:6:10]
         5 │ duration_s = 0.5
         6 │ step_s = 1e-9
           ·          ──┬─
           ·            ╰── too many steps
         7 │
           ╰────
          help: shorten `duration_s` or lengthen `step_s`
    "#]],
    );
}

#[test]
fn step_too_long() {
    check(
        "frequency_hz = 5.0",
        "frequency_hz = 80.0",
        expect![[r#"
        Error:
          × 80 Hz has 12.5 steps per period, too few
            ╭─[bench.toml:10:16]
          9 │ [[base.harmonic]]
         10 │ frequency_hz = 80.0
            ·                ──┬─
            ·                  ╰── too fast for the step
         11 │ linear_m_per_s2 = [0.1, 0.0, 0.0]
            ╰────
          help: choose `step_s` of at most 6.25e-4
    "#]],
    );
}

#[test]
fn given_twice() {
    check(
        "linear_m = ",
        "linear_m_per_s2 = [1.0, 0.0, 0.0]\nlinear_m = ",
        expect![[r#"
        Error:
          × a harmonic gives both `linear_m_per_s2` and `linear_m`
            ╭─[bench.toml:19:13]
         18 │ linear_m_per_s2 = [1.0, 0.0, 0.0]
         19 │ linear_m = [0.01, 0.0, 0.0]
            ·             ──┬─
            ·               ╰── given twice
         20 │
            ╰────
          help: remove `linear_m_per_s2` or `linear_m`
    "#]],
    );
}

#[test]
fn angular_acceleration_too_large() {
    check(
        "rotation_rad = [0.1, 0.0, 0.0]",
        "angular_rad_per_s2 = [5.0, 0.0, 0.0]",
        expect![[r#"
        Error:
          × the angular accelerations of [base] turn it by up to 5.066e-3 rad, and may turn it by 0.001 rad: larger
          │ rotations do not follow from w' by harmonics
           ╭─[bench.toml:8:1]
         7 │
         8 │ [base]
           · ───┬──
           ·    ╰── turns too far
         9 │ [[base.harmonic]]
           ╰────
          help: give `rotation_rad`, amplitudes of the rotation vector, instead of `angular_rad_per_s2`
    "#]],
    );
}

#[test]
fn neither_target_nor_free() {
    let text = with(
        "[target]\nrelative_to = \"base\"\n[[target.harmonic]]\nfrequency_hz = 2.0\nlinear_m = [0.01, 0.0, 0.0]\n",
        "",
    );
    check_text(
        &text,
        expect![[r#"
        Error:
          × nothing says what the platform does
           ╭─[bench.toml:1:1]
         1 │ version = 1
           · ─────┬─────
           ·      ╰── neither [target] nor [free]
         2 │ name = "bench"
           ╰────
          help: add [target] with its [[target.harmonic]] tables, or [free]
    "#]],
    );
}

#[test]
fn target_and_free() {
    check(
        "[limits]",
        "[free]\n[limits]",
        expect![[r#"
        Error:
          × the platform cannot follow [target] and be [free]
            ╭─[bench.toml:20:1]
         19 │
         20 │ [free]
            · ───┬──
            ·    ╰── and [target] as well
         21 │ [limits]
            ╰────
          help: remove [target] to let the platform go, or [free] to steer it
    "#]],
    );
}

#[test]
fn limits_upside_down() {
    check(
        "[0.15, 0.25]",
        "[0.25, 0.15]",
        expect![[r#"
        Error:
          × `actuator_length_m` must be [shortest, longest], but is [0.25, 0.15]
            ╭─[bench.toml:21:21]
         20 │ [limits]
         21 │ actuator_length_m = [0.25, 0.15]
            ·                     ──────┬─────
            ·                           ╰── not a range
         22 │
            ╰────
          help: for example `actuator_length_m = [0.15, 0.25]`
    "#]],
    );
}

#[test]
fn frequency_above_half_the_sampling_rate() {
    check(
        "[2.0, 5.0]",
        "[2.0, 500.0]",
        expect![[r#"
        Error:
          × 500 Hz is not below 500 Hz, half the sampling rate
            ╭─[bench.toml:24:24]
         23 │ [spectrum]
         24 │ frequencies_hz = [2.0, 500.0]
            ·                        ──┬──
            ·                          ╰── too high
            ╰────
          help: shorten `step_s`, or leave it out
    "#]],
    );
}

#[test]
fn name_that_is_no_folder() {
    check(
        "\"bench\"",
        "\"../bench\"",
        expect![[r#"
        Error:
          × `name` is "../bench", which cannot name a folder
           ╭─[bench.toml:2:8]
         1 │ version = 1
         2 │ name = "../bench"
           ·        ─────┬────
           ·             ╰── cannot name a folder
         3 │ platform = "uhp_2016.toml"
           ╰────
          help: use letters, digits, `_` and `-`: `name = "my_experiment"`
    "#]],
    );
}
