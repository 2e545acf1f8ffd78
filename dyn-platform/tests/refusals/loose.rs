//! Legs that leave the platform loose at home.

use expect_test::expect;

use crate::{UPS, check, check_free, check_text, check_ups, free, with};

#[test]
fn equal_pair_angles() {
    check(
        "platform_pair_angle_rad = 0.5",
        "platform_pair_angle_rad = 1.2",
        expect![[r#"
        Error:
          × the legs cannot hold the platform at home: they resist motion in 3 of 6 directions only
            ╭─[bench.toml:14:27]
         13 │ base_pair_angle_rad = 1.2
         14 │ platform_pair_angle_rad = 1.2
            ·                           ─┬─
            ·                            ╰── singular at home
         15 │
            ╰────
          help: make `base_pair_angle_rad` and `platform_pair_angle_rad` differ: with equal ones every leg is in a
                plane with the z axis; forces of legs 1, 2, 3, 4, 5 and 6 can balance each other without effect
    "#]],
    );
}

#[test]
fn equal_pair_angles_of_telescopic_legs() {
    check_ups(
        "platform_pair_angle_rad = 1.7",
        "platform_pair_angle_rad = 0.4",
        expect![[r#"
        Error:
          × the legs cannot hold the platform at home: they resist motion in 3 of 6 directions only
            ╭─[bench.toml:13:27]
         12 │ base_pair_angle_rad = 0.4
         13 │ platform_pair_angle_rad = 0.4
            ·                           ─┬─
            ·                            ╰── singular at home
         14 │
            ╰────
          help: make `base_pair_angle_rad` and `platform_pair_angle_rad` differ: with equal ones every leg is in a
                plane with the z axis; forces of legs 1, 2, 3, 4, 5 and 6 can balance each other without effect
    "#]],
    );
}

#[test]
fn parallel_legs() {
    let text = with(UPS, "platform_pair_angle_rad = 1.7", "platform_pair_angle_rad = 0.4");
    check_text(
        &with(&text, "platform_radius_m = 0.3", "platform_radius_m = 0.45"),
        expect![[r#"
            Error:
              × all legs are parallel at home: nothing holds the platform across them
                ╭─[bench.toml:13:27]
             12 │ base_pair_angle_rad = 0.4
             13 │ platform_pair_angle_rad = 0.4
                ·                           ─┬─
                ·                            ╰── singular at home
             14 │
                ╰────
              help: make `base_pair_angle_rad` and `platform_pair_angle_rad` differ: with equal ones every leg is in a
                    plane with the z axis; forces of legs 1, 2, 3, 4, 5 and 6 can balance each other without effect
        "#]],
    );
}

#[test]
fn both_pairs_closed() {
    let text = with(UPS, "platform_pair_angle_rad = 1.7", "platform_pair_angle_rad = 0.0");
    check_text(
        &with(&text, "base_pair_angle_rad = 0.4", "base_pair_angle_rad = 0.0"),
        expect![[r#"
            Error:
              × legs 1 and 2, 3 and 4, 5 and 6 are the same: both joints of one are those of the other
                ╭─[bench.toml:11:21]
             10 │ base_radius_m = 0.45
             11 │ platform_radius_m = 0.3
                ·                     ─┬─
                ·                      ╰── the same again
             12 │ base_pair_angle_rad = 0.0
                ╰────
              help: two legs in one place hold no more than one: make `base_pair_angle_rad` and
                    `platform_pair_angle_rad` differ: with equal ones every leg is in a plane with the z axis
        "#]],
    );
}

#[test]
fn leg_given_twice_under_two_numbers() {
    check_free(
        "base_point_m = [0.16, 0.11, 0.0]\nplatform_point_m = [0.12, 0.03, 0.0]",
        "base_point_m = [0.16, -0.11, 0.0]\nplatform_point_m = [0.12, -0.03, 0.0]",
        expect![[r#"
            Error:
              × legs 1 and 2 are the same: both joints of one are those of the other
                ╭─[bench.toml:34:20]
             33 │ base_point_m = [0.16, -0.11, 0.0]
             34 │ platform_point_m = [0.12, -0.03, 0.0]
                ·                    ─────────┬────────
                ·                             ╰── the same again
             35 │ [[leg]]
                ╰────
              help: two legs in one place hold no more than one: move the joints of these legs, or the home pose
        "#]],
    );
}

/// Six legs to one point of the platform hold it like a ball.
#[test]
fn platform_joints_in_one_point() {
    let mut text = free();
    for point in
        ["[0.12, -0.03", "[0.12, 0.03", "[-0.03, 0.12", "[-0.09, 0.09", "[-0.09, -0.09", "[-0.03, -0.12"]
    {
        text = with(&text, point, "[0.0, 0.0");
    }
    check_text(
        &with(&text, "rod_length_m = 0.25", "rod_length_m = 0.35"),
        expect![[r#"
            Error:
              × the platform joints of all legs are in one point, the platform's origin
               ╭─[bench.toml:7:14]
             6 │ [home]
             7 │ position_m = [0.0, 0.0, 0.4]
               ·              ───────┬───────
               ·                     ╰── no extent
             8 │ rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
               ╰────
              help: give the platform joints some distance
        "#]],
    );
}

/// All platform joints on the x axis: nothing resists a turn about it.
#[test]
fn all_legs_meet_one_line() {
    let mut text = free();
    for (good, bad) in [
        ("[0.12, -0.03,", "[0.12, 0.0,"),
        ("[0.12, 0.03,", "[0.15, 0.0,"),
        ("[-0.03, 0.12,", "[0.05, 0.0,"),
        ("[-0.09, 0.09,", "[-0.09, 0.0,"),
        ("[-0.09, -0.09,", "[-0.14, 0.0,"),
        ("[-0.03, -0.12,", "[-0.03, 0.0,"),
    ] {
        text = with(&text, good, bad);
    }
    check_text(
        &text,
        expect![[r#"
        Error:
          × the legs cannot hold the platform at home: nothing resists a turn about the axis [1.000, 0.000, 0.000]
          │ (base axes) through the platform's origin
           ╭─[bench.toml:7:14]
         6 │ [home]
         7 │ position_m = [0.0, 0.0, 0.4]
           ·              ───────┬───────
           ·                     ╰── singular at home
         8 │ rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
           ╰────
          help: move the joints of these legs, or the home pose; forces of legs 1, 2, 3, 4, 5 and 6 can balance each
                other without effect
    "#]],
    );
}
