//! Tables as JSON, for other programs.

use serde_json::{Value, json};

use crate::outcome::Outcome;

/// Amplitude tables and errors in the time domain. Cells without a target are null.
pub fn tables_json(outcome: &Outcome) -> Value {
    let tables = outcome.amplitude_tables.iter().map(|table| {
        json!({
            "simulation": table.label,
            "frequencies_hz": table.frequencies_hz,
            "error_percent": table.error_percent,
            "amplitude": table.amplitude,
            "target_amplitude": table.target_amplitude,
            "paper_percent": table.paper_percent,
        })
    });
    let errors = outcome.time_errors.iter().map(|errors| {
        json!({
            "simulation": errors.label,
            "reference": errors.reference,
            "acceleration_relative": errors.acceleration_relative,
            "linear_m_s2": errors.linear_m_s2,
            "angular_rad_s2": errors.angular_rad_s2,
            "position_m": errors.position_m,
        })
    });
    json!({
        "version": 1,
        "scenario": outcome.scenario_name,
        "step_s": outcome.step_s,
        "amplitude_tables": tables.collect::<Vec<_>>(),
        "time_errors": errors.collect::<Vec<_>>(),
        "versions": outcome.versions,
        "seconds": outcome.seconds,
        "warnings": outcome.warnings,
    })
}
