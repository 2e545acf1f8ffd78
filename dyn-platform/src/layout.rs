//! Layouts: from a few lengths and angles to the twelve joint points.

use std::array;
use std::f64::consts::PI;

use crate::parameters::Vector3;

/// Directions of the three pairs of legs. The third is -120 degrees rather than 240, so that the mirror images across
/// the x axis (legs 1-2, 3-6, 4-5) have exactly equal coordinates up to sign.
const PAIR_CENTRES: [f64; 3] = [0.0, 2.0 * PI / 3.0, -2.0 * PI / 3.0];

/// Six joints on a circle in the plane z = 0: legs 1 and 2 stand `pair_angle / 2` before and after 0 degrees, legs 3
/// and 4 around 120 degrees, legs 5 and 6 around 240 degrees, counter-clockwise about z.
pub(crate) fn circle(radius: f64, pair_angle: f64) -> [Vector3; 6] {
    array::from_fn(|leg| {
        let side = if leg % 2 == 0 { -0.5 } else { 0.5 };
        let angle = PAIR_CENTRES[leg / 2] + side * pair_angle;
        // libm, not std: the same digits on every machine.
        [radius * libm::cos(angle), radius * libm::sin(angle), 0.0]
    })
}
