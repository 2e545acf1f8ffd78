//! Random platforms: no symmetry, every number its own, all of them valid.

use std::fmt::Write;

use dyn_platform::{LegType, Platform};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// Random numbers.
pub struct Draw(Pcg64Mcg);

impl Draw {
    pub fn new(seed: u64) -> Draw {
        Draw(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Uniform between these.
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn below(&mut self, end: usize) -> usize {
        (self.0.next_u64() % end as u64) as usize
    }

    /// A random third of `names`.
    pub fn some<'n>(&mut self, names: impl Iterator<Item = &'n str>) -> Vec<&'n str> {
        names.filter(|_| self.below(3) == 0).collect()
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.between(-size, size))
    }
}

fn list(v: [f64; 3]) -> String {
    format!("[{:?}, {:?}, {:?}]", v[0], v[1], v[2])
}

fn sum(a: [f64; 3], b: [f64; 3], factor: f64) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + factor * b[k])
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The text of a platform file of a size between 5 cm and 2 m, from 0.1 to 100 kg.
pub fn text(leg_type: LegType, seed: u64) -> String {
    let mut draw = Draw::new(seed);
    let size = 0.05 * 40_f64.powf(draw.between(0.0, 1.0));
    let mass = 0.1 * 1000_f64.powf(draw.between(0.0, 1.0));
    let inertia = mass * size * size;
    let height = size * draw.between(1.2, 2.0);
    let home = sum([0.0, 0.0, height], draw.vector(0.1 * size), 1.0);
    let mut text = format!(
        "version = 1\nname = \"random_{seed}\"\nleg_type = \"{}\"\ngravity_m_per_s2 = {}\n\n[home]\nposition_m = {}\n",
        leg_type.name(),
        list(draw.vector(10.0)),
        list(home)
    );
    let moments: [f64; 3] = std::array::from_fn(|_| inertia * draw.between(0.1, 0.15));
    let products = draw.vector(0.01 * inertia);
    let rows = [
        [moments[0], products[0], products[1]],
        [products[0], moments[1], products[2]],
        [products[1], products[2], moments[2]],
    ];
    let rows = rows.map(list).join(", ");
    write!(
        text,
        "\n[payload]\nmass_kg = {mass:?}\ncom_m = {}\ninertia_kg_m2 = [{rows}]\n",
        list(draw.vector(0.3 * size))
    )
    .unwrap();
    let (base_half, platform_half) = (draw.between(0.6, 0.9), draw.between(0.15, 0.4));
    for leg in 0..6 {
        let centre = 2.0 * std::f64::consts::PI / 3.0 * f64::from(leg / 2);
        let side = if leg % 2 == 0 { -1.0 } else { 1.0 };
        let mut around = |radius: f64, half: f64| {
            let angle = centre + side * half;
            sum([radius * angle.cos(), radius * angle.sin(), 0.0], draw.vector(0.06 * size), 1.0)
        };
        let (base, platform) = (around(size, base_half), around(0.7 * size, platform_half));
        let tilt = draw.vector(0.1);
        let axis = [tilt[0], tilt[1], 1.0];
        let axis = axis.map(|x| x / norm(axis));
        writeln!(
            text,
            "\n[[leg]]\nnumber = {}\nbase_point_m = {}\nplatform_point_m = {}",
            leg + 1,
            list(base),
            list(platform)
        )
        .unwrap();
        let mut put = |key: &str, value: f64| writeln!(text, "{key} = {value:?}").unwrap();
        let reach = sum(home, platform, 1.0);
        let length = match leg_type {
            LegType::Uhp => {
                let length = height * draw.between(0.3, 0.5);
                let rod = norm(sum(sum(reach, base, -1.0), axis, -length));
                put("rod_length_m", rod);
                put("rod_mass_kg", mass * draw.between(0.05, 0.2));
                put("rod_inertia_kg_m2", inertia * draw.between(0.002, 0.01));
                put("rod_com_fraction", draw.between(0.1, 0.9));
                put("mover_mass_kg", mass * draw.between(0.05, 0.2));
                put("mover_offset_m", size * draw.between(-0.2, 0.3));
                length
            }
            LegType::Ups => {
                let length = norm(sum(reach, base, -1.0));
                put("lower_mass_kg", mass * draw.between(0.05, 0.2));
                put("lower_com_distance_m", length * draw.between(0.1, 0.4));
                put("lower_inertia_kg_m2", inertia * draw.between(0.002, 0.01));
                put("upper_mass_kg", mass * draw.between(0.05, 0.2));
                put("upper_com_distance_m", length * draw.between(0.1, 0.4));
                put("upper_inertia_kg_m2", inertia * draw.between(0.002, 0.01));
                length
            }
        };
        put("rest_length_m", length * draw.between(0.9, 1.1));
        put("axial_stiffness_n_per_m", mass * draw.between(0.0, 5000.0));
        put("axial_damping_n_s_per_m", mass * draw.between(0.0, 50.0));
        if leg_type == LegType::Uhp {
            writeln!(text, "actuator_axis = {}", list(axis)).unwrap();
        }
    }
    text
}

/// The platform.
pub fn random(leg_type: LegType, seed: u64) -> Platform {
    let text = text(leg_type, seed);
    Platform::from_toml("random.toml", &text)
        .unwrap_or_else(|error| panic!("{:?}\n{text}", miette::Report::new(error)))
}
