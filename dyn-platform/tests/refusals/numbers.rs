//! Numbers out of bounds.

use expect_test::expect;

use crate::{check, check_free};

#[test]
fn not_a_number() {
    check(
        "rest_length_m = 0.2",
        "rest_length_m = nan",
        expect![[r#"
        Error:
          × `rest_length_m` needs finite numbers, none beyond 1e30
            ╭─[bench.toml:24:17]
         23 │ mover_offset_m = 0.05
         24 │ rest_length_m = nan
            ·                 ─┬─
            ·                  ╰── not such a number
         25 │ axial_stiffness_n_per_m = 20000.0
            ╰────
          help: give the actuator length at which the axial spring is relaxed, m, for example `rest_length_m =
                0.198`
    "#]],
    );
}

#[test]
fn infinite() {
    check(
        "axial_stiffness_n_per_m = 20000.0",
        "axial_stiffness_n_per_m = inf",
        expect![[r#"
        Error:
          × `axial_stiffness_n_per_m` needs finite numbers, none beyond 1e30
            ╭─[bench.toml:25:27]
         24 │ rest_length_m = 0.2
         25 │ axial_stiffness_n_per_m = inf
            ·                           ─┬─
            ·                            ╰── not such a number
         26 │ axial_damping_n_s_per_m = 2.0
            ╰────
          help: give the axial stiffness of one actuator's springs, N/m, for example `axial_stiffness_n_per_m =
                21555.9`
    "#]],
    );
}

#[test]
fn too_large() {
    check(
        "mover_mass_kg = 0.6",
        "mover_mass_kg = 6e999",
        expect![[r#"
        Error:
          × `mover_mass_kg` needs finite numbers, none beyond 1e30
            ╭─[bench.toml:22:17]
         21 │ rod_com_fraction = 0.5
         22 │ mover_mass_kg = 6e999
            ·                 ──┬──
            ·                   ╰── not such a number
         23 │ mover_offset_m = 0.05
            ╰────
          help: give the moving mass of one actuator, kg, for example `mover_mass_kg = 0.611`
    "#]],
    );
}

#[test]
fn whole_number_too_large() {
    check(
        "mover_mass_kg = 0.6",
        "mover_mass_kg = 9999999999999999999999999999999999",
        expect![[r#"
        Error:
          × `mover_mass_kg` needs finite numbers, none beyond 1e30
            ╭─[bench.toml:22:17]
         21 │ rod_com_fraction = 0.5
         22 │ mover_mass_kg = 9999999999999999999999999999999999
            ·                 ─────────────────┬────────────────
            ·                                  ╰── not such a number
         23 │ mover_offset_m = 0.05
            ╰────
          help: give the moving mass of one actuator, kg, for example `mover_mass_kg = 0.611`
    "#]],
    );
}

#[test]
fn not_a_number_in_a_vector() {
    check(
        "gravity_m_per_s2 = [0.0, 0.0, -9.81]",
        "gravity_m_per_s2 = [0.0, nan, -9.81]",
        expect![[r#"
        Error:
          × `gravity_m_per_s2` needs finite numbers, none beyond 1e30
           ╭─[bench.toml:4:26]
         3 │ leg_type = "uhp"
         4 │ gravity_m_per_s2 = [0.0, nan, -9.81]
           ·                          ─┬─
           ·                           ╰── not such a number
         5 │
           ╰────
          help: give gravity in inertial axes, m/s^2, for example `gravity_m_per_s2 = [0.0, 0.0, -9.81]`
    "#]],
    );
}

#[test]
fn negative_rod_mass() {
    check(
        "rod_mass_kg = 1.0",
        "rod_mass_kg = -1.0",
        expect![[r#"
        Error:
          × `rod_mass_kg` must be positive, but is -1
            ╭─[bench.toml:19:15]
         18 │ rod_length_m = 0.25
         19 │ rod_mass_kg = -1.0
            ·               ──┬─
            ·                 ╰── must be positive
         20 │ rod_inertia_kg_m2 = 0.005
            ╰────
          help: give the mass of one rod, kg, for example `rod_mass_kg = 1.024`
    "#]],
    );
}

#[test]
fn zero_mover_mass() {
    check(
        "mover_mass_kg = 0.6",
        "mover_mass_kg = 0.0",
        expect![[r#"
        Error:
          × `mover_mass_kg` must be positive, but is 0
            ╭─[bench.toml:22:17]
         21 │ rod_com_fraction = 0.5
         22 │ mover_mass_kg = 0.0
            ·                 ─┬─
            ·                  ╰── must be positive
         23 │ mover_offset_m = 0.05
            ╰────
          help: give the moving mass of one actuator, kg, for example `mover_mass_kg = 0.611`
    "#]],
    );
}

#[test]
fn negative_payload_mass() {
    check(
        "\nmass_kg = 6.0",
        "\nmass_kg = -6.0",
        expect![[r#"
        Error:
          × `mass_kg` must be positive, but is -6
            ╭─[bench.toml:29:11]
         28 │ [payload]
         29 │ mass_kg = -6.0
            ·           ──┬─
            ·             ╰── must be positive
         30 │ com_m = [0.0, 0.0, 0.03]
            ╰────
          help: give the mass of platform and payload together, kg, for example `mass_kg = 6.1`
    "#]],
    );
}

#[test]
fn zero_rod_length() {
    check(
        "rod_length_m = 0.25",
        "rod_length_m = 0",
        expect![[r#"
        Error:
          × `rod_length_m` must be positive, but is 0
            ╭─[bench.toml:18:16]
         17 │ actuator_axis = [0.0, 0.0, 1.0]
         18 │ rod_length_m = 0
            ·                ┬
            ·                ╰── must be positive
         19 │ rod_mass_kg = 1.0
            ╰────
          help: give the rod's length from Hooke joint to platform joint, m, for example `rod_length_m = 0.206`
    "#]],
    );
}

#[test]
fn negative_rod_inertia() {
    check(
        "rod_inertia_kg_m2 = 0.005",
        "rod_inertia_kg_m2 = -0.005",
        expect![[r#"
        Error:
          × `rod_inertia_kg_m2` must be positive, but is -0.005
            ╭─[bench.toml:20:21]
         19 │ rod_mass_kg = 1.0
         20 │ rod_inertia_kg_m2 = -0.005
            ·                     ───┬──
            ·                        ╰── must be positive
         21 │ rod_com_fraction = 0.5
            ╰────
          help: give the rod's transverse inertia about its centre of mass, kg m^2, for example `rod_inertia_kg_m2 =
                0.0036`
    "#]],
    );
}

#[test]
fn negative_radius() {
    check(
        "base_radius_m = 0.2",
        "base_radius_m = -0.2",
        expect![[r#"
        Error:
          × `base_radius_m` must be positive, but is -0.2
            ╭─[bench.toml:11:17]
         10 │ [circular_layout]
         11 │ base_radius_m = -0.2
            ·                 ──┬─
            ·                   ╰── must be positive
         12 │ platform_radius_m = 0.13
            ╰────
          help: give the radius of the base's joint circle, m, for example `base_radius_m = 0.18`
    "#]],
    );
}

#[test]
fn negative_stiffness() {
    check(
        "axial_stiffness_n_per_m = 20000.0",
        "axial_stiffness_n_per_m = -20000.0",
        expect![[r#"
        Error:
          × `axial_stiffness_n_per_m` must not be negative, but is -20000
            ╭─[bench.toml:25:27]
         24 │ rest_length_m = 0.2
         25 │ axial_stiffness_n_per_m = -20000.0
            ·                           ────┬───
            ·                               ╰── must not be negative
         26 │ axial_damping_n_s_per_m = 2.0
            ╰────
          help: give the axial stiffness of one actuator's springs, N/m, for example `axial_stiffness_n_per_m =
                21555.9`
    "#]],
    );
}

#[test]
fn negative_damping() {
    check(
        "axial_damping_n_s_per_m = 2.0",
        "axial_damping_n_s_per_m = -2.0",
        expect![[r#"
        Error:
          × `axial_damping_n_s_per_m` must not be negative, but is -2
            ╭─[bench.toml:26:27]
         25 │ axial_stiffness_n_per_m = 20000.0
         26 │ axial_damping_n_s_per_m = -2.0
            ·                           ──┬─
            ·                             ╰── must not be negative
         27 │
            ╰────
          help: give the axial damping of one actuator, N s/m, for example `axial_damping_n_s_per_m = 0.0`
    "#]],
    );
}

#[test]
fn com_beyond_the_rod() {
    check(
        "rod_com_fraction = 0.5",
        "rod_com_fraction = 1.5",
        expect![[r#"
        Error:
          × `rod_com_fraction` must lie between 0 and 1, but is 1.5
            ╭─[bench.toml:21:20]
         20 │ rod_inertia_kg_m2 = 0.005
         21 │ rod_com_fraction = 1.5
            ·                    ─┬─
            ·                     ╰── must lie between 0 and 1
         22 │ mover_mass_kg = 0.6
            ╰────
          help: give the place of the rod's centre of mass between Hooke joint (0) and platform joint (1), for
                example `rod_com_fraction = 0.5`
    "#]],
    );
}

#[test]
fn angle_in_degrees() {
    check(
        "base_pair_angle_rad = 1.2",
        "base_pair_angle_rad = 86.0",
        expect![[r#"
        Error:
          × `base_pair_angle_rad` must lie between 0 and 2 pi rad, but is 86
            ╭─[bench.toml:13:23]
         12 │ platform_radius_m = 0.13
         13 │ base_pair_angle_rad = 86.0
            ·                       ──┬─
            ·                         ╰── must lie between 0 and 2 pi
         14 │ platform_pair_angle_rad = 0.5
            ╰────
          help: give radians: 86 degrees would be 1.5009831567151235 rad
    "#]],
    );
}

#[test]
fn negative_mass_of_one_leg() {
    check_free(
        "number = 5\n",
        "number = 5\nrod_mass_kg = -2.0\n",
        expect![[r#"
        Error:
          × `rod_mass_kg` must be positive, but is -2
            ╭─[bench.toml:45:15]
         44 │ number = 5
         45 │ rod_mass_kg = -2.0
            ·               ──┬─
            ·                 ╰── must be positive
         46 │ base_point_m = [-0.18, -0.08, 0.0]
            ╰────
          help: give the mass of one rod, kg, for example `rod_mass_kg = 1.024`
    "#]],
    );
}
