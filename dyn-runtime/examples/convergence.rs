//! From how far forward kinematics finds its pose: random starts at given distances from random poses of the paper's
//! platform, and how many of them lead back. Writes a plot.
//!
//!     cargo run --release -p dyn-runtime --example convergence -- docs/convergence.svg

use std::fmt::Write as _;

use dyn_runtime::models::Uhp2016;
use dyn_runtime::nalgebra::{UnitQuaternion, Vector3, Vector6};
use dyn_runtime::{Acceleration, BaseMotion, Hexapod, PlatformState, Pose};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Distances of the start, mm and mrad.
const SHIFTS_MM: [f64; 10] = [1.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 80.0];
const TURNS_MRAD: [f64; 10] = [1.0, 10.0, 30.0, 60.0, 100.0, 150.0, 200.0, 300.0, 450.0, 600.0];
const STARTS: usize = 500;

fn main() -> std::io::Result<()> {
    let mut random = Pcg64::seed_from_u64(1);
    let mut cells = String::new();
    println!("share of starts that lead back, %; rows mm, columns mrad {TURNS_MRAD:?}");
    for (row, shift) in SHIFTS_MM.into_iter().enumerate() {
        print!("{shift:5} |");
        for (column, turn) in TURNS_MRAD.into_iter().enumerate() {
            let (share, steps) = share(1e-3 * shift, 1e-3 * turn, &mut random);
            print!(" {:5.1} ({steps:2})", 100.0 * share);
            let (x, y, shade) = (80 + 46 * column, 30 + 26 * row, 255.0 - 175.0 * share);
            let _ = writeln!(
                cells,
                r#"<rect x="{x}" y="{y}" width="46" height="26" fill="rgb({shade:.0},{:.0},255)"/>
<text x="{}" y="{}" text-anchor="middle">{:.0}</text>"#,
                (shade + 60.0).min(255.0),
                x + 23,
                y + 17,
                100.0 * share
            );
        }
        println!();
        let _ = writeln!(cells, r#"<text x="74" y="{}" text-anchor="end">{shift} mm</text>"#, 47 + 26 * row);
    }
    for (column, turn) in TURNS_MRAD.into_iter().enumerate() {
        let _ =
            writeln!(cells, r#"<text x="{}" y="308" text-anchor="middle">{turn}</text>"#, 103 + 46 * column);
    }
    let Some(path) = std::env::args().nth(1) else { return Ok(()) };
    std::fs::write(
        path,
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="560" height="340" font-family="sans-serif" font-size="12">
<rect width="560" height="340" fill="white"/>
<text x="310" y="18" text-anchor="middle">Forward kinematics: starts that find the pose again, %</text>
{cells}<text x="310" y="330" text-anchor="middle">rotation of the start from the pose, mrad</text>
</svg>
"#
        ),
    )
}

/// How many starts at this distance lead back, and the most steps that one of these took.
fn share(shift_m: f64, turn_rad: f64, random: &mut Pcg64) -> (f64, u32) {
    let hexapod = Hexapod::new(Uhp2016);
    let base = Pose::identity();
    let (mut back, mut tried, mut most) = (0, 0, 0);
    while tried < STARTS {
        let mut vector = || Vector3::from_fn(|_, _| random.random_range(-1.0..1.0));
        let position = Vector3::new(0.0, 0.0, 0.382) + vector() * 0.015;
        let pose = Pose::from_paper_angles(position, (vector() * 0.05).into());
        let turn = UnitQuaternion::from_scaled_axis(vector().normalize() * turn_rad);
        let start = Pose {
            position_m: position + vector().normalize() * shift_m,
            rotation: turn.to_rotation_matrix() * pose.rotation,
        };
        let lengths = |pose: &Pose| -> Option<Vector6<f64>> {
            let (base, platform) = (BaseMotion::at_rest(base), PlatformState::at_rest(*pose));
            Some(hexapod.leg_kinematics(&base, &platform, &Acceleration::zero()).ok()?.actuator_length_m)
        };
        let Some(wanted) = lengths(&pose) else { continue };
        tried += 1;
        // A start out of reach counts as one that does not lead back.
        if let Ok(found) = hexapod.forward_kinematics(&base, &wanted, &start)
            && (found.pose.position_m - position).amax() < 1e-9
        {
            back += 1;
            most = most.max(found.iterations);
        }
    }
    (f64::from(back) / tried as f64, most)
}
