//! Platforms of all kinds.

use dyn_runtime::lanes::Generic;
use dyn_runtime::models::{Parameters, Uhp};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::fused::Fused;

/// Platforms that differ in all parameters.
pub fn platforms(count: usize) -> Vec<Uhp> {
    let mut random = Pcg64::seed_from_u64(3);
    let circle = |radius: f64, half_angle: f64| {
        std::array::from_fn(|leg: usize| {
            let sign = if leg.is_multiple_of(2) { 1.0 } else { -1.0 };
            let angle = ((leg / 2) as f64 * 120.0 + sign * half_angle).to_radians();
            [radius * angle.cos(), radius * angle.sin(), 0.0]
        })
    };
    let mut near = |value: f64| value * random.random_range(0.95..1.05);
    (0..count)
        .map(|_| {
            let (base, platform) = (circle(near(0.18), 43.0), circle(near(0.12), 15.0));
            let parameters = Parameters {
                base_point: base,
                actuator_axis: [[0.0, 0.0, 1.0]; 6],
                platform_point: platform,
                rod_length: [near(0.206); 6],
                rod_mass: [near(1.024); 6],
                rod_inertia: [near(0.0036); 6],
                rod_com_fraction: [near(0.5); 6],
                mover_mass: [near(0.611); 6],
                mover_offset: [near(0.05); 6],
                rest_length: [near(0.198); 6],
                axial_stiffness: [near(21555.9); 6],
                axial_damping: [near(20.0); 6],
                payload_mass: near(6.092),
                payload_com: [0.0, near(0.001), near(0.031)],
                payload_inertia: [[near(0.025), 0.0, 0.0], [0.0, near(0.025), 0.0], [0.0, 0.0, near(0.035)]],
                gravity: [0.0, 0.0, -9.81],
            };
            Uhp { parameters }
        })
        .collect()
}

pub fn in_fused(p: &Parameters) -> <Uhp as Generic>::Parameters<Fused<f64>> {
    let vectors = |vectors: [[f64; 3]; 6]| vectors.map(|vector| vector.map(Fused));
    Parameters {
        base_point: vectors(p.base_point),
        actuator_axis: vectors(p.actuator_axis),
        platform_point: vectors(p.platform_point),
        rod_length: p.rod_length.map(Fused),
        rod_mass: p.rod_mass.map(Fused),
        rod_inertia: p.rod_inertia.map(Fused),
        rod_com_fraction: p.rod_com_fraction.map(Fused),
        mover_mass: p.mover_mass.map(Fused),
        mover_offset: p.mover_offset.map(Fused),
        rest_length: p.rest_length.map(Fused),
        axial_stiffness: p.axial_stiffness.map(Fused),
        axial_damping: p.axial_damping.map(Fused),
        payload_mass: Fused(p.payload_mass),
        payload_com: p.payload_com.map(Fused),
        payload_inertia: p.payload_inertia.map(|row| row.map(Fused)),
        gravity: p.gravity.map(Fused),
    }
}
