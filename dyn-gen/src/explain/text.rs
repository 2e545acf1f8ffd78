//! The explanation for people.

use dyn_platform::Limit;

use super::{Elimination, Explanation, SAMPLE_ACCELERATION};

impl Explanation {
    /// All of it, in lines.
    pub fn text(&self) -> String {
        let mut lines = vec![
            format!("Platform {} (legs {}), mobility (1): {}", self.platform, self.leg_type, self.mobility),
            String::new(),
            format!("home position [m, base axes]       {}", numbers(&self.home_position, 5)),
        ];
        if self.home_rotation != [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            lines.push("home rotation (platform to base axes)".into());
            lines.extend(self.home_rotation.iter().map(|row| format!("  {}", numbers(row, 5))));
        }
        lines.extend([
            format!("actuator lengths at home [m]       {}", numbers(&self.actuator_length_at_home, 5)),
            format!("cosine of rod and actuator         {}", numbers(&self.cosines(), 5)),
            format!("actuator forces that hold home [N] {}", numbers(&self.holding_force, 3)),
            format!("actuator forces of a motion [N]    {}", numbers(&self.sample_actuator_force, 3)),
            format!(
                "  (at home, base at rest, platform accelerating upwards by {SAMPLE_ACCELERATION} m/s^2)"
            ),
            "mass matrix M_p at home [kg, kg m, kg m^2]".into(),
        ]);
        lines.extend(self.mass_matrix_p_at_home.chunks(6).map(|row| format!("  {}", numbers(row, 5))));
        lines.extend([String::new(), "Small motions about home, held by constant actuator forces".into()]);
        lines.push(format!("  {:>10}    displacement and rotation of the platform, m and rad", "Hz"));
        for mode in &self.modes {
            let frequency = match mode.angular_frequency_squared {
                squared if squared < 0.0 => "unstable".to_owned(),
                _ => format!("{:.4}", mode.frequency_hz),
            };
            lines.push(format!("  {frequency:>10}    {}", numbers(&mode.shape, 3)));
        }
        lines.extend([
            String::new(),
            "Condition of J_dp (moments over the radius of the platform joints; 6 is the least)".into(),
            format!(
                "  home {:.1}, median {:.1}, worst {:.1} of {} poses of the workspace, seed {}",
                self.conditioning.home,
                self.conditioning.median,
                self.conditioning.worst,
                self.conditioning.sampling.states,
                self.conditioning.sampling.seed
            ),
            format!(
                "  the worst: position [m] {}, turned from home by [rad] {}",
                numbers(&self.conditioning.worst_pose.position, 4),
                numbers(&self.conditioning.worst_pose.rotation_from_home, 4)
            ),
            String::new(),
        ]);
        if let Some(margins) = &self.margins {
            lines.push("What limits leave, leg by leg: at home, at the worst sampled pose".into());
            let legs = |limit: &Limit| {
                limit
                    .iter()
                    .map(|left| left.map_or(format!("{:>10}", "-"), |left| format!("{left:>10.4}")))
                    .collect::<String>()
            };
            for row in &margins.limits {
                lines.push(format!("  {:<33}{}", row.limit, legs(&row.left_at_home)));
                lines.push(format!("  {:<33}{}", "", legs(&row.left_at_worst)));
            }
            lines.push(format!(
                "  {:.0} % of the sampled poses are within all of these limits",
                100.0 * margins.share_of_poses_within
            ));
            lines.push(String::new());
        }
        let list = |names: &[String]| if names.is_empty() { "none".into() } else { names.join(", ") };
        lines.push(format!("baked in        {}", list(&self.baked)));
        lines.push(format!("at run time     {}", list(&self.at_run_time)));
        lines.extend([String::new(), "Operations (+ - * / sqrt) as derived and after each pass".into()]);
        if let Some(first) = self.operations.first() {
            let passes: String = first.after.iter().map(|(pass, _)| format!("{pass:>9}")).collect();
            lines.push(format!("  {:<20}{:>9}{passes}", "function", "derived"));
        }
        for row in &self.operations {
            let counts: String = row.after.iter().map(|(_, count)| format!("{count:>9}")).collect();
            lines.push(format!("  {:<20}{:>9}{counts}", row.function, row.derived));
        }
        for Elimination { function, order } in &self.eliminations {
            lines.push(format!(
                "  the 6 x 6 solve of {function} lets rounding errors grow by {:.1} at the worst of {} states (complete pivoting: {:.1})",
                order.growth, order.states, order.growth_of_complete_pivoting
            ));
        }
        lines.extend([String::new(), self.evidence.text()]);
        lines.join("\n")
    }

    /// u.a
    fn cosines(&self) -> Vec<f64> {
        self.rod_alignment_at_home.iter().map(|squared| squared.sqrt()).collect()
    }
}

fn numbers(values: &[f64], decimals: usize) -> String {
    // No minus sign on what rounds to zero.
    let half = 0.5 * 0.1_f64.powi(decimals as i32);
    let shown = |value: &f64| if value.abs() < half { 0.0 } else { *value };
    values.iter().map(|value| format!(" {:>9.decimals$}", shown(value))).collect()
}
