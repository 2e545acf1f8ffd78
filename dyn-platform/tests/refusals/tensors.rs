//! Vectors that are not unit vectors, matrices that are not rotations, inertia that no body has.

use expect_test::expect;

use crate::check;

#[test]
fn axis_not_of_length_one() {
    check(
        "actuator_axis = [0.0, 0.0, 1.0]",
        "actuator_axis = [0.0, 0.6, 0.9]",
        expect![[r#"
        Error:
          × `actuator_axis` must be a unit vector, but its length is 1.0816653826391966
            ╭─[bench.toml:17:17]
         16 │ [legs]
         17 │ actuator_axis = [0.0, 0.6, 0.9]
            ·                 ───────┬───────
            ·                        ╰── not of length one
         18 │ rod_length_m = 0.25
            ╰────
          help: write the vector of length one in this direction: `actuator_axis = [0.0, 0.5547001962252291,
                0.8320502943378438]`
    "#]],
    );
}

#[test]
fn axis_of_length_zero() {
    check(
        "actuator_axis = [0.0, 0.0, 1.0]",
        "actuator_axis = [0.0, 0.0, 0.0]",
        expect![[r#"
        Error:
          × `actuator_axis` must be a unit vector, but its length is 0
            ╭─[bench.toml:17:17]
         16 │ [legs]
         17 │ actuator_axis = [0.0, 0.0, 0.0]
            ·                 ───────┬───────
            ·                        ╰── not of length one
         18 │ rod_length_m = 0.25
            ╰────
          help: give the unit vector along the actuator, from the base up, in base axes, for example `actuator_axis
                = [0.0, 0.0, 1.0]`
    "#]],
    );
}

#[test]
fn rotation_not_orthonormal() {
    check(
        "rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]",
        "rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.1]",
        expect![[r#"
            Error:
              × `rotation` is not a rotation: its rows must be unit vectors perpendicular to each other, but R R^T
              │ misses the identity by 1.0e-1
               ╭─[bench.toml:8:12]
             7 │ position_m = [0.0, 0.0, 0.4]
             8 │ rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.1], [0.0, 0.0, 1.0]]
               ·            ─────────────────────────┬─────────────────────────
               ·                                     ╰── not orthonormal
             9 │
               ╰────
              help: check the rows, and give rounded numbers at least ten digits
        "#]],
    );
}

#[test]
fn rotation_left_handed() {
    check(
        "rotation = [[1.0, 0.0, 0.0]",
        "rotation = [[-1.0, 0.0, 0.0]",
        expect![[r#"
        Error:
          × `rotation` is a reflection, not a rotation: its determinant is -1
           ╭─[bench.toml:8:12]
         7 │ position_m = [0.0, 0.0, 0.4]
         8 │ rotation = [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
           ·            ──────────────────────────┬─────────────────────────
           ·                                      ╰── left-handed
         9 │
           ╰────
          help: make the axes right-handed: change the sign of one row
    "#]],
    );
}

#[test]
fn inertia_not_symmetric() {
    check(
        "[[0.02, 0.0, 0.0]",
        "[[0.02, 0.001, 0.0]",
        expect![[r#"
        Error:
          × `inertia_kg_m2` is not symmetric: row 1 column 2 is 0.001, row 2 column 1 is 0
            ╭─[bench.toml:31:17]
         30 │ com_m = [0.0, 0.0, 0.03]
         31 │ inertia_kg_m2 = [[0.02, 0.001, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]
            ·                 ────────────────────────────┬───────────────────────────
            ·                                             ╰── not symmetric
            ╰────
          help: make the two equal: an inertia tensor is symmetric
    "#]],
    );
}

#[test]
fn inertia_not_positive_definite() {
    check(
        "[[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]",
        "[[0.02, 0.025, 0.0], [0.025, 0.02, 0.0], [0.0, 0.0, 0.03]]",
        expect![[r#"
            Error:
              × `inertia_kg_m2` is not positive definite: its principal moments are -5.0000e-3, 3.0000e-2 and 4.5000e-2
              │ kg m^2
                ╭─[bench.toml:31:17]
             30 │ com_m = [0.0, 0.0, 0.03]
             31 │ inertia_kg_m2 = [[0.02, 0.025, 0.0], [0.025, 0.02, 0.0], [0.0, 0.0, 0.03]]
                ·                 ─────────────────────────────┬────────────────────────────
                ·                                              ╰── not positive definite
                ╰────
              help: check the signs and sizes off the diagonal; every principal moment must be positive
        "#]],
    );
}

#[test]
fn inertia_of_no_body() {
    check(
        "[0.0, 0.0, 0.03]]",
        "[0.0, 0.0, 0.05]]",
        expect![[r#"
            Error:
              × `inertia_kg_m2` belongs to no body: its principal moments are 2.0000e-2, 2.0000e-2 and 5.0000e-2 kg m^2,
              │ and the largest exceeds the sum of the others
                ╭─[bench.toml:31:17]
             30 │ com_m = [0.0, 0.0, 0.03]
             31 │ inertia_kg_m2 = [[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.05]]
                ·                 ───────────────────────────┬──────────────────────────
                ·                                            ╰── violates the triangle inequality
                ╰────
              help: check the entries: in a body no principal moment exceeds the sum of the other two
        "#]],
    );
}

#[test]
fn zero_inertia() {
    let (good, bad) =
        ("[[0.02, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.03]]", "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]");
    check(
        good,
        bad,
        expect![[r#"
        Error:
          × `inertia_kg_m2` is not positive definite: its principal moments are 0.0000e0, 0.0000e0 and 0.0000e0 kg
          │ m^2
            ╭─[bench.toml:31:17]
         30 │ com_m = [0.0, 0.0, 0.03]
         31 │ inertia_kg_m2 = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]
            ·                 ────────────────┬────────────────
            ·                                 ╰── not positive definite
            ╰────
          help: check the signs and sizes off the diagonal; every principal moment must be positive
    "#]],
    );
}
