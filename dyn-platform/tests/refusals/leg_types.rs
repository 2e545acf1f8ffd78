//! Legs of type `ups`, and keys of the other leg type.

use expect_test::expect;

use crate::{UPS, check, check_text, check_ups, with};

#[test]
fn rod_in_a_telescopic_leg() {
    check_ups(
        "lower_mass_kg = 3.0\n",
        "lower_mass_kg = 3.0\nrod_length_m = 0.25\n",
        expect![[r#"
        Error:
          × `rod_length_m` belongs to legs of type "uhp", but the legs of this file are "ups"
            ╭─[bench.toml:17:1]
         16 │ lower_mass_kg = 3.0
         17 │ rod_length_m = 0.25
            · ──────┬─────
            ·       ╰── of legs "uhp"
         18 │ lower_com_distance_m = 0.2
            ╰────
          help: remove it, or write `leg_type = "uhp"`; legs "ups" have lower_mass_kg, lower_com_distance_m,
                lower_inertia_kg_m2, upper_mass_kg, upper_com_distance_m, upper_inertia_kg_m2, rest_length_m,
                axial_stiffness_n_per_m, axial_damping_n_s_per_m
    "#]],
    );
}

#[test]
fn telescopic_part_in_a_leg_with_a_rod() {
    check(
        "rod_mass_kg = 1.0\n",
        "rod_mass_kg = 1.0\nlower_mass_kg = 1.0\n",
        expect![[r#"
        Error:
          × `lower_mass_kg` belongs to legs of type "ups", but the legs of this file are "uhp"
            ╭─[bench.toml:20:1]
         19 │ rod_mass_kg = 1.0
         20 │ lower_mass_kg = 1.0
            · ──────┬──────
            ·       ╰── of legs "ups"
         21 │ rod_inertia_kg_m2 = 0.005
            ╰────
          help: remove it, or write `leg_type = "ups"`; legs "uhp" have actuator_axis, rod_length_m, rod_mass_kg,
                rod_inertia_kg_m2, rod_com_fraction, mover_mass_kg, mover_offset_m, rest_length_m,
                axial_stiffness_n_per_m, axial_damping_n_s_per_m
    "#]],
    );
}

#[test]
fn key_of_other_legs_in_the_wrong_table() {
    check_ups(
        "[payload]\n",
        "[payload]\nmover_mass_kg = 0.6\n",
        expect![[r#"
        Error:
          × `mover_mass_kg` belongs to legs of type "uhp", but the legs of this file are "ups"
            ╭─[bench.toml:27:1]
         26 │ [payload]
         27 │ mover_mass_kg = 0.6
            · ──────┬──────
            ·       ╰── of legs "uhp"
         28 │ mass_kg = 20.0
            ╰────
          help: remove it, or write `leg_type = "uhp"`; legs "ups" have lower_mass_kg, lower_com_distance_m,
                lower_inertia_kg_m2, upper_mass_kg, upper_com_distance_m, upper_inertia_kg_m2, rest_length_m,
                axial_stiffness_n_per_m, axial_damping_n_s_per_m
    "#]],
    );
}

#[test]
fn property_missing() {
    check_ups(
        "upper_com_distance_m = 0.18\n",
        "",
        expect![[r#"
        Error:
          × `upper_com_distance_m` is missing: neither [legs] nor every leg has it
            ╭─[bench.toml:15:1]
         14 │
         15 │ [legs]
            · ───┬──
            ·    ╰── no `upper_com_distance_m` here
         16 │ lower_mass_kg = 3.0
            ╰────
          help: give the distance of the upper part's centre of mass from the platform joint towards the base joint,
                m, for example `upper_com_distance_m = 0.1`
    "#]],
    );
}

#[test]
fn negative_lower_inertia() {
    check_ups(
        "lower_inertia_kg_m2 = 0.06",
        "lower_inertia_kg_m2 = -0.06",
        expect![[r#"
        Error:
          × `lower_inertia_kg_m2` must be positive, but is -0.06
            ╭─[bench.toml:18:23]
         17 │ lower_com_distance_m = 0.2
         18 │ lower_inertia_kg_m2 = -0.06
            ·                       ──┬──
            ·                         ╰── must be positive
         19 │ upper_mass_kg = 1.5
            ╰────
          help: give the lower part's transverse inertia about its centre of mass, kg m^2, for example
                `lower_inertia_kg_m2 = 0.008`
    "#]],
    );
}

#[test]
fn joints_coincide() {
    let text = with(UPS, "position_m = [0.0, 0.0, 0.7]", "position_m = [0.0, 0.0, 0.0]");
    let text = with(&text, "base_radius_m = 0.45", "base_radius_m = 0.3");
    check_text(
        &with(&text, "platform_pair_angle_rad = 1.7", "platform_pair_angle_rad = 0.4"),
        expect![[r#"
        Error:
          × legs 1, 2, 3, 4, 5 and 6: the joints on base and platform coincide at home
            ╭─[bench.toml:11:21]
         10 │ base_radius_m = 0.3
         11 │ platform_radius_m = 0.3
            ·                     ─┬─
            ·                      ╰── no distance to the other joint
         12 │ base_pair_angle_rad = 0.4
            ╰────
          help: a leg needs a length: move the home position or the joints
    "#]],
    );
}

#[test]
fn leg_type_missing() {
    check_ups(
        "leg_type = \"ups\"\n",
        "",
        expect![[r#"
        Error:
          × `leg_type` is missing in the file
           ╭─[bench.toml:1:1]
         1 │ version = 1
           · ─────┬─────
           ·      ╰── no `leg_type` here
         2 │ name = "bench"
           ╰────
          help: give the build of the legs, for example `leg_type = "uhp"`
    "#]],
    );
}
