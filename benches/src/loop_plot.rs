//! The times of a control loop as a plot: how many cycles took longer than a time.

use std::error::Error;
use std::path::Path;

use hdrhistogram::Histogram;
use plotters::prelude::*;

const SIZE: (u32, u32) = (860, 480);
/// Colours of implementations: legible side by side and in grey.
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 90, 160), RGBColor(215, 90, 0), RGBColor(0, 130, 90), RGBColor(120, 120, 120)];

/// A curve: share of cycles that took longer, over time; one histogram per run.
pub struct Curve<'a> {
    /// For the legend.
    pub name: &'a str,
    /// One thin line each.
    pub runs: Vec<&'a Histogram<u64>>,
}

/// Writes an SVG file.
///
/// # Errors
/// If it cannot be written.
pub fn write(path: &Path, title: &str, curves: &[Curve<'_>]) -> Result<(), Box<dyn Error>> {
    let histograms = || curves.iter().flat_map(|curve| &curve.runs);
    let shortest = histograms().map(|histogram| histogram.min()).min().unwrap_or(1).max(1);
    let longest = histograms().map(|histogram| histogram.max()).max().unwrap_or(1).max(2);
    let cycles = histograms().map(|histogram| histogram.len()).max().unwrap_or(1);

    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let times = (shortest as f64 * 0.8..longest as f64 * 1.25).log_scale();
    let shares = (0.5 / cycles as f64..1.0).log_scale();
    let mut chart = ChartBuilder::on(&root)
        .caption(title, ("sans-serif", 17))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(70)
        .build_cartesian_2d(times, shares)?;
    chart
        .configure_mesh()
        .x_desc("time of the model in one cycle, ns")
        .y_desc("share of cycles that took longer")
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y:.0e}"))
        .label_style(("sans-serif", 13))
        .light_line_style(WHITE)
        .draw()?;
    for (curve, colour) in curves.iter().zip(COLOURS.iter().cycle()) {
        for (number, histogram) in curve.runs.iter().enumerate() {
            let line = chart.draw_series(LineSeries::new(exceeded(histogram), colour))?;
            if number == 0 {
                let colour = *colour;
                line.label(curve.name)
                    .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
            }
        }
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .label_font(("sans-serif", 13))
        .background_style(WHITE)
        .border_style(BLACK)
        .draw()?;
    root.present()?;
    Ok(())
}

/// Points of a curve that falls in steps.
fn exceeded(histogram: &Histogram<u64>) -> Vec<(f64, f64)> {
    let all = histogram.len() as f64;
    let mut left = all;
    let mut points = vec![(histogram.min() as f64, 1.0)];
    for value in histogram.iter_recorded() {
        let time = value.value_iterated_to() as f64;
        let share = left / all;
        left -= value.count_since_last_iteration() as f64;
        // Steps that nobody would see make large files only.
        if points.last().is_none_or(|&(before, above)| time > 1.01 * before || share < 0.97 * above) {
            points.push((time, share));
            // A logarithmic axis has no zero: the last step ends at half a cycle.
            points.push((time, left.max(0.5) / all));
        }
    }
    points.push((histogram.max() as f64, 0.5 / all));
    points
}
