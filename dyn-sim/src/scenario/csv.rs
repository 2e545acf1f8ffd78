//! Measured motion: a CSV file with time and six accelerations per line.
//!
//! ```text
//! time_s, x_m_per_s2, y_m_per_s2, z_m_per_s2, rx_rad_per_s2, ry_rad_per_s2, rz_rad_per_s2
//! 0.000, 0.1, 0.0, -0.2, 0.0, 0.0, 0.0
//! ```
//!
//! A first line that does not begin with a number names the columns; lines that begin with `#` are comments.

use std::ops::Range;

use dyn_platform::Refusal;

use crate::measured::{LEAST_SAMPLES, Record};

/// Time and six accelerations.
const COLUMNS: usize = 7;

/// A time step may differ from the usual one by this fraction: clocks print rounded numbers.
const UNEVEN: f64 = 1e-3;

/// Mistakes told one by one; more say nothing new.
const MOST: usize = 10;

const EXAMPLE: &str = "each line has time (s), three accelerations (m/s^2) and three angular accelerations (rad/s^2), \
                       separated by commas";

/// Reads a measured motion or says what is wrong with it.
pub(super) fn read(text: &str) -> Result<Record, Vec<Refusal>> {
    let mut refusals = Vec::new();
    let mut rows: Vec<(Range<usize>, [f64; COLUMNS])> = Vec::new();
    let mut start = 0;
    let mut header_may_come = true;
    for line in text.split_inclusive('\n') {
        let span = start..start + line.trim_end().len();
        start += line.len();
        let content = line.trim();
        if content.is_empty() || content.starts_with('#') {
            continue;
        }
        let first = content.split(',').next().unwrap_or_default().trim();
        let is_header = header_may_come && first.parse::<f64>().is_err();
        header_may_come = false;
        if is_header {
            if let Err(refusal) = count(content, span) {
                refusals.push(refusal);
            }
            continue;
        }
        match row(content, span.clone()) {
            Ok(row) => rows.push((span, row)),
            Err(refusal) => refusals.push(refusal),
        }
    }
    if refusals.is_empty() {
        refusals = uneven_times(&rows);
    }
    if refusals.is_empty() && rows.len() < LEAST_SAMPLES {
        let what = format!("{} samples are too few for a motion", rows.len());
        let end = text.trim_end().len();
        refusals.push(Refusal::new(
            end..end,
            "the file ends here",
            what,
            format!("give at least {LEAST_SAMPLES}"),
        ));
    }
    if !refusals.is_empty() {
        refusals.truncate(MOST);
        return Err(refusals);
    }
    let spacing_s = (rows[rows.len() - 1].1[0] - rows[0].1[0]) / (rows.len() - 1) as f64;
    let acceleration = rows.iter().map(|(_, row)| std::array::from_fn(|i| row[1 + i])).collect();
    Ok(Record { spacing_s, acceleration })
}

fn count(content: &str, span: Range<usize>) -> Result<(), Refusal> {
    let found = content.split(',').count();
    if found == COLUMNS {
        return Ok(());
    }
    let what = format!("a line has {found} columns instead of {COLUMNS}");
    Err(Refusal::new(span, format!("{found} columns"), what, EXAMPLE))
}

fn row(content: &str, span: Range<usize>) -> Result<[f64; COLUMNS], Refusal> {
    count(content, span.clone())?;
    let mut row = [0.0; COLUMNS];
    for (value, field) in row.iter_mut().zip(content.split(',')) {
        let field = field.trim();
        *value = match field.parse::<f64>() {
            Ok(number) if number.is_finite() => number,
            Ok(_) => {
                let help = "repair or cut the record there; missing samples cannot be guessed";
                return Err(Refusal::new(
                    span,
                    "not finite",
                    format!("`{field}` is not a finite number"),
                    help,
                ));
            }
            Err(_) => {
                return Err(Refusal::new(
                    span,
                    "not a number",
                    format!("`{field}` is not a number"),
                    EXAMPLE,
                ));
            }
        };
    }
    Ok(row)
}

fn uneven_times(rows: &[(Range<usize>, [f64; COLUMNS])]) -> Vec<Refusal> {
    let mut steps: Vec<f64> = rows.windows(2).map(|pair| pair[1].1[0] - pair[0].1[0]).collect();
    let ordered = steps.clone();
    steps.sort_by(f64::total_cmp);
    let Some(&usual) = steps.get(steps.len() / 2) else { return Vec::new() };
    let goes_back = ordered.iter().any(|step| *step <= 0.0);
    let mut refusals = Vec::new();
    for (k, step) in ordered.into_iter().enumerate() {
        // Where lines are out of order, gaps and uneven steps only follow from that.
        if goes_back && step > 0.0 {
            continue;
        }
        let (at, row) = &rows[k + 1];
        let (label, what, help) = if step <= 0.0 {
            (
                "not later",
                format!("the time {} s does not come after {} s", row[0], rows[k].1[0]),
                "order the lines by time and remove repetitions".to_owned(),
            )
        } else if step > 1.5 * usual {
            (
                "after a gap",
                format!("a gap of {step:.6} s where samples usually follow after {usual:.6} s"),
                "cut the record there, or fill the gap with what was measured".to_owned(),
            )
        } else if (step - usual).abs() > UNEVEN * usual {
            (
                "uneven",
                format!("uneven time: {step:.6e} s after the line before, usually {usual:.6e} s"),
                "resample to even times, and print them with enough digits".to_owned(),
            )
        } else {
            continue;
        };
        refusals.push(Refusal::new(at.clone(), label, what, help));
    }
    refusals
}
