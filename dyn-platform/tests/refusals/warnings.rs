//! Units that are probably wrong: a warning where the file is accepted, part of the help where it is refused.

use dyn_platform::Platform;
use expect_test::{Expect, expect};

use crate::{CIRCULAR, UPS, check_text, free, rendered, with};

/// The only warning about an accepted file.
fn warned(text: &str, good: &str, bad: &str, expected: Expect) {
    let platform =
        Platform::from_toml("bench.toml", &with(text, good, bad)).expect("a warning is no refusal");
    let [warning] = platform.warnings.as_slice() else { panic!("{:?}", platform.warnings) };
    assert!(warning.at().is_some());
    expected.assert_eq(&rendered(warning));
}

#[test]
fn position_in_millimetres() {
    warned(
        CIRCULAR,
        "position_m = [0.0, 0.0, 0.4]",
        "position_m = [0.0, 0.0, 400.0]",
        expect![[r#"
        Error:
          ⚠ `position_m` has 400 in it, unusually large
           ╭─[bench.toml:7:14]
         6 │ [home]
         7 │ position_m = [0.0, 0.0, 400.0]
           ·              ────────┬────────
           ·                      ╰── in mm?
         8 │ rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
           ╰────
          help: if that is in mm, write 0.4
    "#]],
    );
}

#[test]
fn rest_length_in_millimetres() {
    warned(
        CIRCULAR,
        "rest_length_m = 0.2",
        "rest_length_m = 200",
        expect![[r#"
        Error:
          ⚠ `rest_length_m` is 200, unusually large
            ╭─[bench.toml:24:17]
         23 │ mover_offset_m = 0.05
         24 │ rest_length_m = 200
            ·                 ─┬─
            ·                  ╰── in mm?
         25 │ axial_stiffness_n_per_m = 20000.0
            ╰────
          help: if that is in mm, write 0.2
    "#]],
    );
}

#[test]
fn gravity_in_millimetres() {
    warned(
        CIRCULAR,
        "[0.0, 0.0, -9.81]",
        "[0.0, 0.0, -9810.0]",
        expect![[r#"
        Error:
          ⚠ `gravity_m_per_s2` has -9810 in it, unusually large
           ╭─[bench.toml:4:20]
         3 │ leg_type = "uhp"
         4 │ gravity_m_per_s2 = [0.0, 0.0, -9810.0]
           ·                    ─────────┬─────────
           ·                             ╰── in mm/s^2?
         5 │
           ╰────
          help: if that is in mm/s^2, write -9.81
    "#]],
    );
}

#[test]
fn velocity_in_millimetres() {
    warned(
        UPS,
        "[legs]\n",
        "[legs]\nmaximum_velocity_m_per_s = 400.0\n",
        expect![[r#"
        Error:
          ⚠ `maximum_velocity_m_per_s` is 400, unusually large
            ╭─[bench.toml:16:28]
         15 │ [legs]
         16 │ maximum_velocity_m_per_s = 400.0
            ·                            ──┬──
            ·                              ╰── in mm/s?
         17 │ lower_mass_kg = 3.0
            ╰────
          help: if that is in mm/s, write 0.4
    "#]],
    );
}

#[test]
fn pair_angle_in_degrees() {
    warned(
        UPS,
        "platform_pair_angle_rad = 1.7",
        "platform_pair_angle_rad = 5.0",
        expect![[r#"
        Error:
          ⚠ `platform_pair_angle_rad` is 5, unusually large
            ╭─[bench.toml:13:27]
         12 │ base_pair_angle_rad = 0.4
         13 │ platform_pair_angle_rad = 5.0
            ·                           ─┬─
            ·                            ╰── in degrees?
         14 │
            ╰────
          help: if that is in degrees, write 0.08727
    "#]],
    );
}

#[test]
fn payload_in_grams() {
    warned(
        CIRCULAR,
        "\nmass_kg = 6.0",
        "\nmass_kg = 6000.0",
        expect![[r#"
        Error:
          ⚠ `mass_kg` is 6000, heavier than a cube of gold 0.26 m wide, the size of the platform
            ╭─[bench.toml:29:11]
         28 │ [payload]
         29 │ mass_kg = 6000.0
            ·           ───┬──
            ·              ╰── in g?
         30 │ com_m = [0.0, 0.0, 0.03]
            ╰────
          help: if that is in g, write 6
    "#]],
    );
}

#[test]
fn rod_mass_in_grams() {
    warned(
        CIRCULAR,
        "rod_mass_kg = 1.0",
        "rod_mass_kg = 1000.0",
        expect![[r#"
        Error:
          ⚠ `rod_mass_kg` is 1000, heavier than a cube of gold 0.25 m wide, the size of leg 1
            ╭─[bench.toml:19:15]
         18 │ rod_length_m = 0.25
         19 │ rod_mass_kg = 1000.0
            ·               ───┬──
            ·                  ╰── in g?
         20 │ rod_inertia_kg_m2 = 0.005
            ╰────
          help: if that is in g, write 1
    "#]],
    );
}

#[test]
fn payload_inertia_in_kg_mm2() {
    let (good, bad) = (
        "[[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]",
        "[[2e4, 0.0, 0.0], [0.0, 2e4, 0.0], [0.0, 0.0, 3e4]]",
    );
    warned(
        CIRCULAR,
        good,
        bad,
        expect![[r#"
            Error:
              ⚠ `inertia_kg_m2` gives a radius of gyration of 76.38 m, beyond four times the platform's width
                ╭─[bench.toml:31:17]
             30 │ com_m = [0.0, 0.0, 0.03]
             31 │ inertia_kg_m2 = [[2e4, 0.0, 0.0], [0.0, 2e4, 0.0], [0.0, 0.0, 3e4]]
                ·                 ─────────────────────────┬─────────────────────────
                ·                                          ╰── in kg mm^2?
                ╰────
              help: if that is in kg mm^2, multiply it by 1e-6
        "#]],
    );
}

#[test]
fn rod_inertia_in_g_mm2() {
    warned(
        CIRCULAR,
        "rod_inertia_kg_m2 = 0.005",
        "rod_inertia_kg_m2 = 5.2e6",
        expect![[r#"
            Error:
              ⚠ `rod_inertia_kg_m2` is 5200000, which gives a radius of gyration of 2280 m, beyond leg 1
                ╭─[bench.toml:20:21]
             19 │ rod_mass_kg = 1.0
             20 │ rod_inertia_kg_m2 = 5.2e6
                ·                     ──┬──
                ·                       ╰── in g mm^2?
             21 │ rod_com_fraction = 0.5
                ╰────
              help: if that is in g mm^2, write 0.0052
        "#]],
    );
}

#[test]
fn lower_inertia_in_kg_cm2() {
    warned(
        UPS,
        "lower_inertia_kg_m2 = 0.06",
        "lower_inertia_kg_m2 = 600",
        expect![[r#"
            Error:
              ⚠ `lower_inertia_kg_m2` is 600, which gives a radius of gyration of 14.14 m, beyond leg 1
                ╭─[bench.toml:18:23]
             17 │ lower_com_distance_m = 0.2
             18 │ lower_inertia_kg_m2 = 600
                ·                       ─┬─
                ·                        ╰── in kg cm^2?
             19 │ upper_mass_kg = 1.5
                ╰────
              help: if that is in kg cm^2, write 0.06
        "#]],
    );
}

/// One length in millimetres among others in metres: no rod reaches.
#[test]
fn hint_with_a_refusal() {
    check_text(
        &with(CIRCULAR, "base_radius_m = 0.2", "base_radius_m = 200"),
        expect![[r#"
        Error:
          × the rod is too short to reach at home (legs 1, 2, 3, 4, 5 and 6): the platform joint of leg 5 is
          │ 199.877887 m off its actuator's axis, the rod is 0.25 m long
            ╭─[bench.toml:18:16]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ rod_length_m = 0.25
            ·                ──┬─
            ·                  ╰── too short
         19 │ rod_mass_kg = 1.0
            ╰────
          help: make it longer than 199.887882 m, or move the joints, the axis or the home pose; `base_radius_m` is
                200, unusually large: if that is in mm, write 0.2
    "#]],
    );
}

#[test]
fn usual_files_give_no_warning() {
    for text in [CIRCULAR, UPS, &free()] {
        assert_eq!(Platform::from_toml("bench.toml", text).expect("a valid file").warnings, []);
    }
}
