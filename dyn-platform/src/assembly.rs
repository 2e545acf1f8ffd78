//! The platform at home as a whole: six legs that must hold it.

use std::ops::Range;

use nalgebra::{SMatrix, SVector, Vector3 as Vector};

use crate::findings::Findings;
use crate::legs::{Geometry, Leg, named};
use crate::refusal::Refusal;

/// Singular values of `J_dp` (moments divided by the size of the platform) below this part of the largest count as zero:
/// some load would ask a million times its own size of the actuators.
const SINGULAR: f64 = 1e-6;

/// A leg whose share in a self-balanced set of forces is below this plays no part in it.
const NO_SHARE: f64 = 1e-3;

/// Points nearer than this part of the platform's size, and directions nearer than this, are the same.
const SAME: f64 = 1e-9;

/// Enough for any 6x6 matrix; ordinary ones take about twenty.
const MOST_ITERATIONS: usize = 10_000;

/// Refuses legs that are given twice or leave the platform loose. `at` and `remedy` are those of the layout.
pub(crate) fn refuse_loose(
    legs: &[Leg; 6],
    home: &[Geometry; 6],
    at: Range<usize>,
    remedy: &str,
    findings: &mut Findings,
) {
    let arms: [Vector<f64>; 6] = std::array::from_fn(|leg| legs[leg].platform_arm());
    let size = (arms.iter().map(Vector::norm_squared).sum::<f64>() / 6.0).sqrt();
    if size == 0.0 {
        let what = "the platform joints of all legs are in one point, the platform's origin";
        findings.refuse(Refusal::new(at, "no extent", what, "give the platform joints some distance"));
        return;
    }
    if refuse_twins(legs, home, size, remedy, findings) {
        return;
    }
    // Rows of J_dp, (31), each divided by its force: a scale of a leg makes nothing loose.
    let jacobian = SMatrix::<f64, 6, 6>::from_fn(|leg, axis| {
        let along = home[leg].line_of_force.normalize();
        if axis < 3 { along[axis] } else { arms[leg].cross(&along)[axis - 3] / size }
    });
    let Some(svd) = jacobian.try_svd(true, true, f64::EPSILON, MOST_ITERATIONS) else { return };
    let (Some(forces), Some(motions)) = (svd.u, svd.v_t) else { return };
    let largest = svd.singular_values.max();
    let loose: Vec<usize> = (0..6).filter(|&k| svd.singular_values[k] <= SINGULAR * largest).collect();
    if loose.is_empty() {
        return;
    }
    let share = |leg: usize| loose.iter().map(|&k| forces[(leg, k)].powi(2)).sum::<f64>().sqrt();
    let involved: Vec<usize> = (0..6).filter(|&leg| share(leg) > NO_SHARE).map(|leg| leg + 1).collect();
    let first = home[0].line_of_force;
    let parallel = |leg: &Geometry| {
        let line = leg.line_of_force;
        line.cross(&first).norm() <= SINGULAR * line.norm() * first.norm()
    };
    let what = match loose.as_slice() {
        _ if home.iter().all(parallel) => {
            "all legs are parallel at home: nothing holds the platform across them".to_owned()
        }
        [only] => format!(
            "the legs cannot hold the platform at home: nothing resists {}",
            motion(&motions.row(*only).transpose(), size)
        ),
        _ => format!(
            "the legs cannot hold the platform at home: they resist motion in {} of 6 directions only",
            6 - loose.len()
        ),
    };
    let help = format!("{remedy}; forces of {} can balance each other without effect", named(&involved));
    findings.refuse(Refusal::new(at, "singular at home", what, help));
}

/// Refuses legs with the same joints and the same line of force; whether there are any. Legs whose joints stand in one
/// place of the file share a refusal.
fn refuse_twins(
    legs: &[Leg; 6],
    home: &[Geometry; 6],
    size: f64,
    remedy: &str,
    findings: &mut Findings,
) -> bool {
    let near = |one: &Vector<f64>, other: &Vector<f64>| (one - other).norm() <= SAME * size;
    let twins = |first: usize, second: usize| {
        let same = |name: &str| near(&legs[first].vector(name), &legs[second].vector(name));
        let (one, other) = (home[first].line_of_force, home[second].line_of_force);
        same("base_point")
            && same("platform_point")
            && one.cross(&other).norm() <= SAME * one.norm() * other.norm()
    };
    let mut places: Vec<(Range<usize>, Vec<String>)> = Vec::new();
    for (second, leg) in legs.iter().enumerate().skip(1) {
        let Some(first) = (0..second).find(|&first| twins(first, second)) else { continue };
        let (at, pair) = (leg.span("platform_point"), format!("{} and {}", first + 1, second + 1));
        match places.iter_mut().find(|(place, _)| *place == at) {
            Some((_, pairs)) => pairs.push(pair),
            None => places.push((at, vec![pair])),
        }
    }
    let found = !places.is_empty();
    for (at, pairs) in places {
        let what =
            format!("legs {} are the same: both joints of one are those of the other", pairs.join(", "));
        let help = format!("two legs in one place hold no more than one: {remedy}");
        findings.refuse(Refusal::new(at, "the same again", what, help));
    }
    found
}

/// A motion in words, from `[v; w size]` of the platform's origin in base axes.
fn motion(twist: &SVector<f64, 6>, size: f64) -> String {
    let (shift, turn) = (twist.fixed_rows::<3>(0).into_owned(), twist.fixed_rows::<3>(3).into_owned());
    if turn.norm() <= 1e-6 * shift.norm() {
        return format!("a shift along {}", direction(&shift));
    }
    let axis = direction(&turn);
    if shift.norm() <= 1e-6 * turn.norm() {
        return format!("a turn about the axis {axis} through the platform's origin");
    }
    // The point of the axis nearest to the platform's origin, w x v / w.w, with w = turn / size.
    let w = turn / size;
    let offset = w.cross(&shift) / w.norm_squared();
    format!("a turn about the axis {axis} that passes {:.3} m from the platform's origin", offset.norm())
}

/// A unit vector, its largest component positive, in base axes.
fn direction(vector: &Vector<f64>) -> String {
    let unit = vector.normalize();
    let sign = if unit[unit.iamax()] < 0.0 { -1.0 } else { 1.0 };
    // Adding zero turns -0 into 0.
    let [x, y, z]: [f64; 3] = (unit * sign).map(|c| (c * 1e3).round() / 1e3 + 0.0).into();
    format!("[{x:.3}, {y:.3}, {z:.3}] (base axes)")
}
