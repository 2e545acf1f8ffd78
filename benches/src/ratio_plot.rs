//! Times of every implementation as a plot: one row of bars per function, on a logarithmic axis.

use std::error::Error;
use std::path::Path;

use plotters::prelude::*;

use crate::cases::IMPLEMENTATIONS;
use crate::ratios::{Row, Summary};

const WIDTH: u32 = 900;
/// Height of a bar with its gap, of a group's heading, of the frame.
const BAR: u32 = 20;
const HEADING: u32 = 26;
const FRAME: u32 = 110;
/// Ours and theirs: legible side by side and in grey.
const OURS: RGBColor = RGBColor(0, 90, 160);
const THEIRS: RGBColor = RGBColor(215, 120, 40);

/// Writes an SVG file with the throughput of every function that was measured by more than ours.
///
/// # Errors
/// If it cannot be written.
pub fn write(path: &Path, summary: &Summary) -> Result<(), Box<dyn Error>> {
    let rows: Vec<&Row> = summary
        .rows
        .iter()
        .filter(|row| row.measure == "throughput" && !row.nanoseconds.is_empty())
        .collect();
    let bars: u32 = rows.iter().map(|row| HEADING + BAR * row.nanoseconds.len() as u32).sum();
    let times = || rows.iter().flat_map(|row| row.nanoseconds.values().map(|time| time.median));
    let longest = times().fold(1.0, f64::max) * 2.0;
    let shortest = times().fold(longest, f64::min) / 2.0;

    let root = SVGBackend::new(path, (WIDTH, bars + FRAME)).into_drawing_area();
    root.fill(&WHITE)?;
    let processor = summary.machine.as_ref().map_or("unknown processor", |machine| &machine.processor);
    let mut chart = ChartBuilder::on(&root)
        .caption(format!("Nanoseconds per call, throughput, {processor}"), ("sans-serif", 17))
        .margin(12)
        .x_label_area_size(44)
        .margin_left(180)
        .build_cartesian_2d((shortest..longest).log_scale(), 0..bars as i32)?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .disable_y_axis()
        .x_desc("ns")
        .x_label_formatter(&|x| format!("{x:.0}"))
        .label_style(("sans-serif", 13))
        .draw()?;
    let mut top = bars as i32;
    for row in rows {
        top -= HEADING as i32;
        chart.draw_series([Text::new(
            row.function.clone(),
            (shortest * 1.02, top + 16),
            ("sans-serif", 14),
        )])?;
        for name in IMPLEMENTATIONS {
            let Some(time) = row.nanoseconds.get(name) else { continue };
            let colour = if name.starts_with("generated") { OURS } else { THEIRS };
            let corners = [(shortest, top), (time.median, top - BAR as i32 + 4)];
            chart.draw_series([Rectangle::new(corners, colour.filled())])?;
            let label = format!("{name}  {:.1}", time.median);
            let at = (time.median * 1.03, top - 2);
            chart.draw_series([Text::new(label, at, ("sans-serif", 13))])?;
            top -= BAR as i32;
        }
    }
    root.present()?;
    Ok(())
}
