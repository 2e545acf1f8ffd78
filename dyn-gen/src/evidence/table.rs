//! Evidence for people: one line per function, one per law.

use super::{Agreement, Evidence, Worst};

impl Evidence {
    /// A table of several lines.
    pub fn text(&self) -> String {
        let mut lines = vec![
            format!(
                "evidence: {} states over the workspace of {}, seed {}",
                self.sampling.states, self.platform, self.sampling.seed
            ),
            "  largest relative error of any output against the graph as derived (a) and hand-written dynamics (b)".into(),
            format!("  {:<20}{:>9}{:>9}{:>11}   output, worst state", "function", "(a)", "(b)", "tolerance"),
        ];
        for rows in self.outputs.chunk_by(|one, other| one.function == other.function) {
            let share = |row: &Agreement| overall(row).share();
            // The row nearest to its tolerance, or the first that is no number.
            let nearest = rows.iter().max_by(|one, other| share(one).total_cmp(&share(other)));
            let Some(row) = rows.iter().find(|row| share(row).is_nan()).or(nearest) else { continue };
            let worst = overall(row);
            lines.push(format!(
                "  {:<20}{:>9.1e}{:>9.1e}{:>11.0e}   {}, {} ({})",
                row.function,
                row.unoptimised.error,
                row.reference.error,
                worst.tolerance,
                row.output,
                worst.state,
                worst.kind
            ));
        }
        let examined: Vec<_> = self.laws.iter().filter_map(|row| Some((row, row.worst?))).collect();
        let width = examined.iter().map(|(row, _)| row.law.chars().count()).max().unwrap_or(0);
        if !examined.is_empty() {
            lines.push(format!("  {:<width$}{:>10}{:>11}   worst state", "law", "violation", "tolerance"));
        }
        for (row, worst) in &examined {
            lines.push(format!(
                "  {:<width$}{:>10.1e}{:>11.0e}   {} ({})",
                row.law, worst.error, row.tolerance, worst.state, worst.kind
            ));
        }
        match self.laws.len() - examined.len() {
            0 => {}
            left => lines
                .push(format!("  {left} laws take functions that are not generated and were not examined")),
        }
        lines.push(String::new());
        lines.join("\n")
    }

    /// What a generated file says of it, in lines without figures that rounding could change.
    pub fn summary(&self) -> Vec<String> {
        let examined: Vec<&str> =
            self.laws.iter().filter(|row| row.worst.is_some()).map(|row| row.law).collect();
        let mut lines = vec![
            format!(
                "{} states over the workspace, seed {}: every output agrees with the graph as derived and with",
                self.sampling.states, self.sampling.seed
            ),
            format!("hand-written dynamics to a relative error below {:.0e}", self.decade()),
        ];
        if !examined.is_empty() {
            lines.push("laws that hold at all of them:".into());
            lines.extend(examined.iter().map(|law| format!("  {law}")));
        }
        lines
    }

    /// The power of ten above every relative error, one above rounding at least.
    fn decade(&self) -> f64 {
        let worst = self.outputs.iter().map(|row| overall(row).error).fold(0.0, f64::max);
        (-14..0).map(|exponent| 10_f64.powi(exponent)).find(|decade| worst < *decade).unwrap_or(1.0)
    }
}

fn overall(row: &Agreement) -> Worst {
    row.reference.or(row.unoptimised)
}
