//! Limits that contradict themselves or the home pose.

use expect_test::expect;

use crate::{check, check_free};

const FIRST_OF_LEGS: &str = "actuator_axis = [0.0, 0.0, 1.0]\n";

/// The circular file with lines added to [legs].
fn with_limits(lines: &str) -> String {
    format!("{FIRST_OF_LEGS}{lines}")
}

#[test]
fn no_stroke() {
    check(
        FIRST_OF_LEGS,
        &with_limits("minimum_length_m = 0.17\nmaximum_length_m = 0.17\n"),
        expect![[r#"
        Error:
          × the stroke is zero (legs 1, 2, 3, 4, 5 and 6): shortest and longest length are both 0.17 m
            ╭─[bench.toml:19:20]
         18 │ minimum_length_m = 0.17
         19 │ maximum_length_m = 0.17
            ·                    ──┬─
            ·                      ╰── no stroke
         20 │ rod_length_m = 0.25
            ╰────
          help: make `maximum_length_m` larger than `minimum_length_m`
    "#]],
    );
}

#[test]
fn stroke_reversed() {
    check(
        FIRST_OF_LEGS,
        &with_limits("minimum_length_m = 0.2\nmaximum_length_m = 0.15\n"),
        expect![[r#"
        Error:
          × the stroke is reversed (legs 1, 2, 3, 4, 5 and 6): the shortest length, 0.2 m, exceeds the longest, 0.15
          │ m
            ╭─[bench.toml:19:20]
         18 │ minimum_length_m = 0.2
         19 │ maximum_length_m = 0.15
            ·                    ──┬─
            ·                      ╰── shorter than the shortest
         20 │ rod_length_m = 0.25
            ╰────
          help: make `maximum_length_m` larger than `minimum_length_m`
    "#]],
    );
}

#[test]
fn stroke_of_one_leg_reversed() {
    check_free(
        "number = 2\n",
        "number = 2\nminimum_length_m = 0.2\nmaximum_length_m = 0.15\n",
        expect![[r#"
            Error:
              × the stroke is reversed (leg 2): the shortest length, 0.2 m, exceeds the longest, 0.15 m
                ╭─[bench.toml:34:20]
             33 │ minimum_length_m = 0.2
             34 │ maximum_length_m = 0.15
                ·                    ──┬─
                ·                      ╰── shorter than the shortest
             35 │ base_point_m = [0.16, 0.11, 0.0]
                ╰────
              help: make `maximum_length_m` larger than `minimum_length_m`
        "#]],
    );
}

#[test]
fn home_below_the_stroke() {
    check(
        FIRST_OF_LEGS,
        &with_limits("minimum_length_m = 0.2\n"),
        expect![[r#"
        Error:
          × home is outside the stroke (legs 1, 2, 3, 4, 5 and 6): the actuator of leg 1 is 0.166660 m long there,
          │ below its shortest length
            ╭─[bench.toml:18:20]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ minimum_length_m = 0.2
            ·                    ─┬─
            ·                     ╰── home is shorter
         19 │ rod_length_m = 0.25
            ╰────
          help: make `minimum_length_m` at most 0.166660 m, or move the home pose
    "#]],
    );
}

#[test]
fn home_above_the_stroke() {
    check(
        FIRST_OF_LEGS,
        &with_limits("minimum_length_m = 0.1\nmaximum_length_m = 0.15\n"),
        expect![[r#"
        Error:
          × home is outside the stroke (legs 1, 2, 3, 4, 5 and 6): the actuator of leg 1 is 0.166660 m long there,
          │ above its longest length
            ╭─[bench.toml:19:20]
         18 │ minimum_length_m = 0.1
         19 │ maximum_length_m = 0.15
            ·                    ──┬─
            ·                      ╰── home is longer
         20 │ rod_length_m = 0.25
            ╰────
          help: make `maximum_length_m` at least 0.166661 m, or move the home pose
    "#]],
    );
}

#[test]
fn no_velocity() {
    check(
        FIRST_OF_LEGS,
        &with_limits("maximum_velocity_m_per_s = 0.0\n"),
        expect![[r#"
        Error:
          × `maximum_velocity_m_per_s` must be positive, but is 0
            ╭─[bench.toml:18:28]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ maximum_velocity_m_per_s = 0.0
            ·                            ─┬─
            ·                             ╰── must be positive
         19 │ rod_length_m = 0.25
            ╰────
          help: give the highest speed of the actuator, m/s, for example `maximum_velocity_m_per_s = 0.5`
    "#]],
    );
}

#[test]
fn negative_force() {
    check(
        FIRST_OF_LEGS,
        &with_limits("maximum_force_n = -200.0\n"),
        expect![[r#"
        Error:
          × `maximum_force_n` must be positive, but is -200
            ╭─[bench.toml:18:19]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ maximum_force_n = -200.0
            ·                   ───┬──
            ·                      ╰── must be positive
         19 │ rod_length_m = 0.25
            ╰────
          help: give the largest force of the actuator, either way, N, for example `maximum_force_n = 200.0`
    "#]],
    );
}

#[test]
fn negative_force_constant() {
    check(
        FIRST_OF_LEGS,
        &with_limits("force_constant_n_per_a = -25.0\n"),
        expect![[r#"
        Error:
          × `force_constant_n_per_a` must be positive, but is -25
            ╭─[bench.toml:18:26]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ force_constant_n_per_a = -25.0
            ·                          ──┬──
            ·                            ╰── must be positive
         19 │ rod_length_m = 0.25
            ╰────
          help: give the force of the voice coil per current, N/A, for example `force_constant_n_per_a = 25.0`
    "#]],
    );
}

#[test]
fn joint_angle_in_degrees() {
    check(
        FIRST_OF_LEGS,
        &with_limits("maximum_hooke_joint_angle_rad = 20.0\n"),
        expect![[r#"
        Error:
          × `maximum_hooke_joint_angle_rad` must lie between 0 and pi rad, but is 20
            ╭─[bench.toml:18:33]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ maximum_hooke_joint_angle_rad = 20.0
            ·                                 ──┬─
            ·                                   ╰── must lie between 0 and pi
         19 │ rod_length_m = 0.25
            ╰────
          help: give radians: 20 degrees would be 0.3490658503988659 rad
    "#]],
    );
}

#[test]
fn no_joint_angle() {
    check(
        FIRST_OF_LEGS,
        &with_limits("maximum_platform_joint_angle_rad = 0.0\n"),
        expect![[r#"
        Error:
          × `maximum_platform_joint_angle_rad` must lie between 0 and pi rad, but is 0
            ╭─[bench.toml:18:36]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ maximum_platform_joint_angle_rad = 0.0
            ·                                    ─┬─
            ·                                     ╰── must lie between 0 and pi
         19 │ rod_length_m = 0.25
            ╰────
          help: give the largest angle between the rod and its direction at home, seen from the platform, rad, for
                example `maximum_platform_joint_angle_rad = 0.35`
    "#]],
    );
}

#[test]
fn misspelt_limit() {
    check(
        FIRST_OF_LEGS,
        &with_limits("max_force_n = 200.0\n"),
        expect![[r#"
        Error:
          × unknown key `max_force_n` in [legs]
            ╭─[bench.toml:18:1]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ max_force_n = 200.0
            · ─────┬─────
            ·      ╰── unknown key
         19 │ rod_length_m = 0.25
            ╰────
          help: did you mean `maximum_force_n`?
    "#]],
    );
}
