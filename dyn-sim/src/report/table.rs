//! Table 4: relative errors of complex amplitudes, ours beside the paper's, and the sentence that sums it up.

use super::axis::power_of_ten;
use super::curves::COMPONENTS;
use crate::outcome::{AmplitudeTable, Outcome, TimeErrors};

/// All rows of one frequency.
pub(super) struct Group {
    pub(super) frequency_hz: f64,
    pub(super) rows: Vec<Row>,
}

/// Six cells, %.
pub(super) struct Row {
    pub(super) label: String,
    pub(super) cells: [String; 6],
    pub(super) is_paper: bool,
}

/// Rows by frequency: every simulation's, then the paper's.
pub(super) fn groups(tables: &[AmplitudeTable]) -> Vec<Group> {
    let mut frequencies: Vec<f64> = tables.iter().flat_map(|table| table.frequencies_hz.clone()).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    let group = |frequency_hz: f64| {
        let row_of = |table: &AmplitudeTable| table.frequencies_hz.iter().position(|hz| *hz == frequency_hz);
        let ours = tables.iter().filter_map(|table| {
            let cells = table.error_percent.get(row_of(table)?)?.map(percent);
            Some(Row { label: table.label.clone(), cells, is_paper: false })
        });
        let paper = tables.iter().find_map(|table| {
            let cells = table.paper_percent.as_ref()?.get(row_of(table)?)?.map(printed);
            Some(Row { label: "paper".into(), cells, is_paper: true })
        });
        Group { frequency_hz, rows: ours.chain(paper).collect() }
    };
    frequencies.into_iter().map(group).collect()
}

/// Two significant digits of an error; a dash where the target is zero.
pub(super) fn percent(value: f64) -> String {
    if value.is_nan() { "\u{2013}".into() } else { significant(value, 2) }
}

/// As the paper prints it.
fn printed(value: f64) -> String {
    format!("{value:.2}")
}

/// So many significant digits; powers of ten outside 0.0001 to 100 000.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return if value.is_nan() { "not a number" } else { "infinite" }.into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let rounded = format!("{value:.*e}", digits.saturating_sub(1));
    let Some((mantissa, exponent)) = rounded.split_once('e') else { return rounded };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-4..5).contains(&exponent) {
        return format!("{mantissa}\u{b7}{}", power_of_ten(exponent));
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    // From the rounded text, so that 0.000996 comes out as 0.0010 and 1234 as 1200.
    rounded.parse::<f64>().map_or(rounded, |value| format!("{value:.decimals$}"))
}

/// Up to five significant digits, without zeros at the end.
pub(super) fn plain(value: f64) -> String {
    let text = significant(value, 5);
    if text.contains('.') && !text.contains('\u{b7}') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// The largest of a table's cells and where it stands.
struct Largest {
    percent: f64,
    component: &'static str,
    frequency_hz: f64,
}

/// Of the cells of `rows` that are numbers, or that `failed` says are none for a reason that counts as infinite.
fn largest(
    frequencies_hz: &[f64],
    rows: &[[f64; 6]],
    failed: impl Fn(usize, usize) -> bool,
) -> Option<Largest> {
    let mut found: Option<Largest> = None;
    for (row, (cells, &frequency_hz)) in rows.iter().zip(frequencies_hz).enumerate() {
        for (i, component) in COMPONENTS.into_iter().enumerate() {
            let percent = if failed(row, i) { f64::INFINITY } else { cells[i] };
            if !percent.is_nan() && found.as_ref().is_none_or(|found| percent > found.percent) {
                found = Some(Largest { percent, component, frequency_hz });
            }
        }
    }
    found
}

/// A cell without a target does not count; a simulation that came to no number does.
fn largest_of_ours(table: &AmplitudeTable) -> Option<Largest> {
    let no_number = |row: usize, i: usize| table.amplitude.get(row).is_some_and(|row| !row[i].is_finite());
    largest(&table.frequencies_hz, &table.error_percent, no_number)
}

/// The result in one sentence: against the paper's table where there is one, else in the time domain.
pub(super) fn headline(outcome: &Outcome) -> String {
    let has_rows = |table: &AmplitudeTable| table.error_percent.len() >= table.frequencies_hz.len();
    if let Some(table) = outcome.amplitude_tables.iter().find(|table| !has_rows(table)) {
        return format!("{} did not run to the end: there is nothing to compare.", table.label);
    }
    let worst = outcome
        .amplitude_tables
        .iter()
        .filter_map(|table| Some((table, largest_of_ours(table)?)))
        .max_by(|(_, a), (_, b)| a.percent.total_cmp(&b.percent));
    if let Some((AmplitudeTable { label, frequencies_hz, paper_percent: Some(paper), .. }, ours)) = &worst
        && let Some(theirs) = largest(frequencies_hz, paper, |_, _| false)
    {
        if outcome.simulations.len() == 1 {
            // Against itself a model proves nothing: no comparison with the paper's independent program.
            return format!(
                "By {label}\u{2019}s own simulation, without an independent engine, the largest cell of Table 4 is {} % \
                 ({} at {} Hz).",
                significant(ours.percent, 2),
                ours.component,
                ours.frequency_hz
            );
        }
        let times = theirs.percent / ours.percent;
        let comparison =
            if times >= 2.0 { format!(", {} times as much", significant(times, 2)) } else { String::new() };
        return format!(
            "The largest cell of Table 4 is {} % ({} at {} Hz, {label}); the paper\u{2019}s largest is {} % ({} at {} Hz)\
             {comparison}.",
            significant(ours.percent, 2),
            ours.component,
            ours.frequency_hz,
            printed(theirs.percent),
            theirs.component,
            theirs.frequency_hz,
        );
    }
    let worst_in_time =
        outcome.time_errors.iter().max_by(|a, b| a.linear_m_s2.abs().total_cmp(&b.linear_m_s2.abs()));
    if let Some(worst) = worst_in_time {
        return strays(worst);
    }
    if let Some((table, ours)) = worst {
        return format!(
            "The largest error of an amplitude is {} % ({} at {} Hz, {}).",
            significant(ours.percent, 2),
            ours.component,
            ours.frequency_hz,
            table.label
        );
    }
    let labels: Vec<&str> = outcome.simulations.iter().map(|series| series.label.as_str()).collect();
    match labels.as_slice() {
        [] => "No simulation came to a result.".into(),
        labels => format!("Free motion of the platform, simulated by {}.", labels.join(" and ")),
    }
}

/// One simulation's errors in the time domain, as a sentence.
fn strays(errors: &TimeErrors) -> String {
    let TimeErrors { label, acceleration_relative, linear_m_s2, angular_rad_s2, position_m, .. } = errors;
    if !(linear_m_s2.is_finite() && angular_rad_s2.is_finite()) {
        return format!("{label} came to accelerations that are not numbers.");
    }
    let acceleration = if acceleration_relative.is_nan() {
        format!("{} m/s², {} rad/s²", significant(*linear_m_s2, 2), significant(*angular_rad_s2, 2))
    } else {
        format!("{} of the largest acceleration", significant(*acceleration_relative, 2))
    };
    format!(
        "{label} strays from {} by at most {acceleration} and by {}.",
        reference(errors),
        length(*position_m)
    )
}

/// What errors in the time domain are measured against, in words.
pub(super) fn reference(errors: &TimeErrors) -> String {
    if errors.reference == "target" { "the target".into() } else { errors.reference.clone() }
}

/// "Table 4" where the paper's stands beside ours.
pub(super) fn title(tables: &[AmplitudeTable]) -> &'static str {
    if tables.iter().any(|table| table.paper_percent.is_some()) {
        "Table 4: relative error of the platform\u{2019}s acceleration (complex amplitudes), %"
    } else {
        "Relative error of the platform\u{2019}s acceleration (complex amplitudes), %"
    }
}

/// Metres with a fitting prefix, two significant digits.
pub(super) fn length(metres: f64) -> String {
    let (symbol, factor) = super::axis::prefix(metres.abs());
    format!("{} {symbol}m", significant(metres / factor, 2))
}

/// Table 4 for the screen, with the headline under it; at most 80 columns unless a label is long.
pub fn terminal_table(outcome: &Outcome) -> String {
    let groups = groups(&outcome.amplitude_tables);
    let mut text = String::new();
    if !groups.is_empty() {
        let rows = || groups.iter().flat_map(|group| &group.rows);
        let width = rows().map(|row| row.label.chars().count()).max().unwrap_or(0);
        let widest = rows().flat_map(|row| &row.cells).map(|cell| cell.chars().count()).max().unwrap_or(0);
        let column = 2 + widest.max(5);
        text += title(&outcome.amplitude_tables);
        text += "\n\n";
        text += &format!("{:>5}  {:width$}", "Hz", "");
        text += &COMPONENTS.map(|component| format!("{component:>column$}")).concat();
        for group in &groups {
            text.push('\n');
            for (number, row) in group.rows.iter().enumerate() {
                let frequency = if number == 0 { group.frequency_hz.to_string() } else { String::new() };
                text += &format!("\n{frequency:>5}  {:width$}", row.label);
                text += &row.cells.each_ref().map(|cell| format!("{cell:>column$}")).concat();
            }
        }
        text += "\n\n";
    }
    text + &headline(outcome) + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::expect;

    #[test]
    fn digits_are_sensible() {
        let two = [0.004_444, 0.000_996, 0.9999, 12.34, 1234.0, 3.14e-6, 7.77e9, 0.0, -0.5]
            .map(|x| significant(x, 2));
        assert_eq!(two, ["0.0044", "0.0010", "1.0", "12", "1200", "3.1·10⁻⁶", "7.8·10⁹", "0", "-0.50"]);
        assert_eq!(percent(f64::NAN), "–");
        assert_eq!(
            [206.0, 0.611, 21.5559, 120_000.0, 0.0].map(plain),
            ["206", "0.611", "21.556", "1.2000·10⁵", "0"]
        );
        assert_eq!(length(3.4e-7), "340 nm");
    }

    #[test]
    fn the_screen_shows_both_tables() {
        let outcome = super::super::example::outcome();
        expect![[r#"
            Table 4: relative error of the platform’s acceleration (complex amplitudes), %

               Hz                       Ax        Ay        Az       Arx       Ary       Arz

               40  dyn-gen        3.0·10⁻⁸  6.0·10⁻⁸  9.0·10⁻⁸  1.2·10⁻⁷  1.5·10⁻⁷  1.8·10⁻⁷
                   Exudyn 1.13.8   0.00022   0.00044   0.00066   0.00088    0.0011    0.0013
                   paper              0.25      1.80      2.07      1.80      5.15      2.98

              100  dyn-gen        6.0·10⁻⁸  1.2·10⁻⁷  1.8·10⁻⁷  2.4·10⁻⁷  3.0·10⁻⁷  3.6·10⁻⁷
                   Exudyn 1.13.8   0.00044   0.00088    0.0013    0.0018    0.0022    0.0026
                   paper              0.70      4.62      2.38      2.53      5.40      2.80

              200  dyn-gen        9.0·10⁻⁸  1.8·10⁻⁷  2.7·10⁻⁷  3.6·10⁻⁷  4.5·10⁻⁷  5.4·10⁻⁷
                   Exudyn 1.13.8   0.00066    0.0013    0.0020    0.0026    0.0033    0.0040
                   paper              1.08      2.75      2.07      3.12      5.12      2.27

            The largest cell of Table 4 is 0.0040 % (Arz at 200 Hz, Exudyn 1.13.8); the paper’s largest is 5.40 % (Ary at 100 Hz), 1400 times as much.
        "#]].assert_eq(&terminal_table(&outcome));
    }

    #[test]
    fn without_harmonics_the_time_errors_speak() {
        let mut outcome = super::super::example::outcome();
        outcome.amplitude_tables.clear();
        assert_eq!(
            terminal_table(&outcome),
            "Exudyn 1.13.8 strays from the target by at most 3.2·10⁻⁵ of the largest acceleration and by 41 pm.\n"
        );
        outcome.time_errors[1].acceleration_relative = f64::NAN;
        assert_eq!(
            headline(&outcome),
            "Exudyn 1.13.8 strays from the target by at most 3.2·10⁻⁷ m/s², 3.2·10⁻⁶ rad/s² and by 41 pm."
        );
        outcome.time_errors[0].linear_m_s2 = f64::INFINITY;
        assert_eq!(headline(&outcome), "dyn-gen came to accelerations that are not numbers.");
        outcome.time_errors.clear();
        assert_eq!(
            terminal_table(&outcome),
            "Free motion of the platform, simulated by dyn-gen and Exudyn 1.13.8.\n"
        );
        outcome.simulations.clear();
        assert_eq!(terminal_table(&outcome), "No simulation came to a result.\n");
    }

    #[test]
    fn alone_the_model_is_not_compared() {
        let mut outcome = super::super::example::outcome();
        outcome.simulations.truncate(1);
        outcome.amplitude_tables.truncate(1);
        assert_eq!(
            headline(&outcome),
            "By dyn-gen\u{2019}s own simulation, without an independent engine, the largest cell of Table 4 is \
             5.4\u{b7}10⁻⁷ % (Arz at 200 Hz)."
        );
    }

    #[test]
    fn without_the_paper_there_is_no_table_4() {
        let mut outcome = super::super::example::outcome();
        for table in &mut outcome.amplitude_tables {
            table.paper_percent = None;
        }
        outcome.time_errors.clear();
        let text = terminal_table(&outcome);
        assert!(!text.contains("Table 4") && !text.contains("paper"), "{text}");
        assert!(
            text.ends_with("The largest error of an amplitude is 0.0040 % (Arz at 200 Hz, Exudyn 1.13.8).\n")
        );
    }

    #[test]
    fn a_cell_that_is_not_a_number_is_the_largest() {
        let mut outcome = super::super::example::outcome();
        outcome.amplitude_tables[0].error_percent[2][3] = f64::NAN;
        // Nothing to compare with: the cell is empty.
        assert!(!headline(&outcome).contains("infinite"));
        outcome.amplitude_tables[0].amplitude[2][3] = f64::NAN;
        assert!(headline(&outcome).contains("infinite % (Arx at 200 Hz, dyn-gen)"), "{}", headline(&outcome));
    }
}
