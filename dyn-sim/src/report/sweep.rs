//! A sweep on the screen and on disk: a line per design, and what depends on what.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use super::axis::{extent, padded};
use super::error::ReportError;
use super::figure::{Column, Curve, Figure, Panel, Scale};
use super::folder::{MARKER, MARKER_FILE, StagedFolder, TABLES};
use super::svg::{Stroke, escape};
use super::table::significant;
use crate::sweep::{Found, Measure, Sweep, Swept, measures};

const STYLE: &str = include_str!("page.css");
const DOTS: Stroke = Stroke::solid("#0b5cad", 3.0);
/// More numbers that vary than these are not drawn each.
const MOST_FIGURES: usize = 8;

/// Writes table, figures and page to `folder`, which appears under that name when it is complete, and says what to open. An
/// earlier report there is replaced. `with_json` adds `tables.json`.
///
/// # Errors
/// As [`write_report`](super::write_report).
pub fn write_sweep(
    sweep: &Sweep,
    swept: &Swept,
    command: &str,
    folder: &Path,
    with_json: bool,
) -> Result<PathBuf, ReportError> {
    let staged = StagedFolder::new(folder)?;
    staged.write("csv/designs.csv", |out| table(sweep, swept, out))?;
    let mut drawings = String::new();
    for figure in figures(sweep, swept) {
        let drawing = figure.draw();
        let path = format!("svg/{}.svg", figure.name);
        staged.write(&path, |out| out.write_all(drawing.file().as_bytes()))?;
        let (title, caption) = (escape(&figure.title), escape(&figure.caption));
        let inline = drawing.inline();
        let _ = writeln!(
            drawings,
            "<figure>\n{inline}<figcaption><b>{title}.</b> {caption}</figcaption>\n</figure>"
        );
    }
    if with_json {
        staged.write(TABLES, |out| writeln!(out, "{:#}", sweep_json(sweep, swept)))?;
    }
    let page = page(sweep, swept, command, &drawings);
    let html = staged.write(MARKER_FILE, |out| out.write_all(page.as_bytes()))?;
    staged.publish()?;
    Ok(html)
}

/// One word about a design.
fn outcome(swept: &Swept, design: usize) -> &'static str {
    match &swept.found[design] {
        None => "refused",
        Some(Found { ended: Some(_), .. }) => "ended",
        Some(_) => "ok",
    }
}

/// Why a design was refused or ended; empty for others.
fn reason(swept: &Swept, design: usize) -> &str {
    match (&swept.designs[design].1, &swept.found[design]) {
        (Err(reason), _) => reason,
        (_, Some(Found { ended: Some(ending), .. })) => &ending.reason,
        _ => "",
    }
}

/// A line per design. Numbers are the shortest that read back to the same bits.
fn table(sweep: &Sweep, swept: &Swept, out: &mut dyn Write) -> io::Result<()> {
    let measures = measures(&sweep.nominal.steering);
    write!(out, "design")?;
    for label in sweep.labels() {
        write!(out, ",{label}")?;
    }
    write!(out, ",outcome")?;
    for measure in &measures {
        write!(out, ",{}", measure.name)?;
    }
    writeln!(out, ",exceeded,ended_at_s,reason")?;
    for (design, (numbers, _)) in swept.designs.iter().enumerate() {
        write!(out, "{design}")?;
        for number in numbers {
            write!(out, ",{number:?}")?;
        }
        write!(out, ",{}", outcome(swept, design))?;
        let found = swept.found[design].as_ref();
        for measure in &measures {
            write!(out, ",")?;
            if let Some(value) = found.map(measure.of).filter(|value| value.is_finite()) {
                write!(out, "{value:?}")?;
            }
        }
        let exceeded = found.and_then(|found| found.exceeded.as_deref()).unwrap_or_default();
        let ended = found.and_then(|found| found.ended.as_ref());
        let time = ended.map(|ending| format!("{:?}", ending.time_s)).unwrap_or_default();
        writeln!(out, ",{exceeded},{time},\"{}\"", reason(swept, design).replace('"', "\"\""))?;
    }
    Ok(())
}

/// All designs with what was found out, for other programs. What is not a number is null.
pub fn sweep_json(sweep: &Sweep, swept: &Swept) -> Value {
    let (labels, measures) = (sweep.labels(), measures(&sweep.nominal.steering));
    let design = |design: usize| {
        let numbers: Map<String, Value> =
            labels.iter().cloned().zip(swept.designs[design].0.iter().map(|number| json!(number))).collect();
        let found = swept.found[design].as_ref();
        let of = |measure: &Measure| (measure.name.to_owned(), json!(found.map(measure.of)));
        json!({
            "numbers": numbers,
            "outcome": outcome(swept, design),
            "reason": reason(swept, design),
            "ended_at_s": found.and_then(|found| found.ended.as_ref()).map(|ending| ending.time_s),
            "exceeded": found.and_then(|found| found.exceeded.as_ref()),
            "found": measures.iter().map(of).collect::<Map<String, Value>>(),
        })
    };
    json!({
        "version": 1,
        "sweep": sweep.name,
        "scenario": sweep.nominal.name,
        "platform": sweep.nominal.platform.name,
        "seed": sweep.random.map(|(_, seed)| seed),
        "designs": (0..swept.designs.len()).map(design).collect::<Vec<_>>(),
        "seconds": { "making": swept.making_s, "computing": swept.computing_s },
    })
}

/// How many designs came to what, in a sentence.
fn headline(sweep: &Sweep, swept: &Swept) -> String {
    let count = |wanted| (0..swept.designs.len()).filter(|design| outcome(swept, *design) == wanted).count();
    let exceeded = swept.found.iter().flatten().filter(|found| found.exceeded.is_some()).count();
    let mut text = format!(
        "{} designs of platform {} in scenario {}: {} computed",
        swept.designs.len(),
        sweep.nominal.platform.name,
        sweep.nominal.name,
        count("ok")
    );
    for (number, what) in
        [(count("ended"), "ended early"), (count("refused"), "refused"), (exceeded, "beyond a limit")]
    {
        if number > 0 {
            let _ = write!(text, ", {number} {what}");
        }
    }
    text
}

/// Least, median and largest of what is drawn, each with its design, and how long it took.
pub fn sweep_summary(sweep: &Sweep, swept: &Swept, threads: usize) -> String {
    let mut text = headline(sweep, swept) + "\n";
    let _ = writeln!(text, "\n{:<44} {:>12} {:>12} {:>12}   designs", "", "least", "median", "largest");
    for measure in drawn(sweep, swept) {
        let sorted = sorted(swept, &measure);
        let (Some(first), Some(last)) = (sorted.first(), sorted.last()) else { continue };
        let number = |value: f64| significant(value, 4);
        let middle = sorted[sorted.len() / 2];
        let heading = heading(&measure);
        let _ = writeln!(
            text,
            "{heading:<44} {:>12} {:>12} {:>12}   {}, {}, {}",
            number(first.0),
            number(middle.0),
            number(last.0),
            first.1,
            middle.1,
            last.1
        );
    }
    let computed = swept.found.iter().flatten().count();
    let _ = writeln!(
        text,
        "\ntime: {:.2} s for making the designs, {:.2} s for {} steps of each: {} designs per second, {} steps per second, in \
         {threads} thread{}",
        swept.making_s,
        swept.computing_s,
        sweep.nominal.grid.steps,
        significant(computed as f64 / (swept.making_s + swept.computing_s), 3),
        significant((computed * sweep.nominal.grid.steps) as f64 / swept.computing_s, 3),
        if threads == 1 { "" } else { "s" },
    );
    text
}

fn heading(measure: &Measure) -> String {
    format!("{}, {}", measure.heading, measure.unit)
}

/// What is drawn: where there is anything.
fn drawn(sweep: &Sweep, swept: &Swept) -> Vec<Measure> {
    let mut measures = measures(&sweep.nominal.steering);
    measures.retain(|measure| measure.drawn && !sorted(swept, measure).is_empty());
    // Where the base moves, what counts is the share of that.
    if measures.iter().any(|measure| measure.unit == "%") {
        measures.retain(|measure| measure.name != "rms_linear_m_per_s2");
    }
    measures
}

/// The finite values of a measure, ascending, with their designs.
fn sorted(swept: &Swept, measure: &Measure) -> Vec<(f64, usize)> {
    let mut values: Vec<(f64, usize)> = swept
        .found
        .iter()
        .enumerate()
        .filter_map(|(design, found)| Some(((measure.of)(found.as_ref()?), design)))
        .filter(|(value, _)| value.is_finite())
        .collect();
    values.sort_by(|one, other| one.0.total_cmp(&other.0));
    values
}

/// One figure for each number that varies, and one with all designs in order.
fn figures(sweep: &Sweep, swept: &Swept) -> Vec<Figure> {
    let measures = drawn(sweep, swept);
    let labels = sweep.labels();
    let mut figures = Vec::new();
    if labels.len() <= MOST_FIGURES {
        for (k, label) in labels.iter().enumerate() {
            let across = |design: usize| swept.designs[design].0[k];
            let Some(range) = extent((0..swept.designs.len()).map(across)) else { continue };
            let line = labels.len() == 1 && sweep.random.is_none();
            figures.push(Figure {
                name: format!("over_{}", label.replace(['.', ' '], "_")),
                title: format!("Over {label}"),
                caption: match labels.len() {
                    1 => String::new(),
                    _ => "Each point is a design; the other numbers vary as well.".into(),
                },
                x_label: label.clone(),
                ..figure(&measures, padded(range), |measure| {
                    let mut points: Vec<(f64, f64)> = sorted(swept, measure)
                        .into_iter()
                        .map(|(value, design)| (across(design), value))
                        .collect();
                    points.sort_by(|one, other| one.0.total_cmp(&other.0));
                    (points, !line)
                })
            });
        }
    }
    figures.push(Figure {
        name: "in_order".into(),
        title: "All designs in order".into(),
        caption: "So many percent of all computed designs have at most this value, each quantity in an order of its own.".into(),
        x_label: "share of designs, %".into(),
        ..figure(&measures, [0.0, 100.0], |measure| {
            let values = sorted(swept, measure);
            let share = 100.0 / values.len() as f64;
            (values.iter().enumerate().map(|(k, (value, _))| ((k as f64 + 0.5) * share, *value)).collect(), false)
        })
    });
    figures
}

/// A column per measure; `points` are abscissa and ordinate, and whether they stand for themselves.
fn figure(
    measures: &[Measure],
    x_range: [f64; 2],
    points: impl Fn(&Measure) -> (Vec<(f64, f64)>, bool),
) -> Figure {
    let column = |measure: &Measure| {
        let (points, dots) = points(measure);
        let (x, y) = points.into_iter().unzip();
        Column {
            heading: measure.heading,
            unit: measure.unit,
            panels: vec![Panel { label: String::new(), curves: vec![Curve { entry: 0, x, y, dots }] }],
        }
    };
    Figure {
        name: String::new(),
        title: String::new(),
        caption: String::new(),
        x_label: String::new(),
        x_range,
        scale: Scale::Linear,
        columns: measures.iter().map(column).collect(),
        legend: vec![("designs".into(), DOTS)],
        marks: Vec::new(),
    }
}

/// The page: figures, extremes, the sweep file.
fn page(sweep: &Sweep, swept: &Swept, command: &str, drawings: &str) -> String {
    let name = escape(&sweep.name);
    let mut rows = String::new();
    for measure in drawn(sweep, swept) {
        let sorted = sorted(swept, &measure);
        let cell = |(value, design): (f64, usize)| {
            let numbers: Vec<String> = sweep
                .labels()
                .iter()
                .zip(&swept.designs[design].0)
                .take(MOST_FIGURES)
                .map(|(label, number)| format!("{label} {}", significant(*number, 5)))
                .collect();
            let title = escape(&numbers.join(", "));
            format!(
                "<td title=\"{title}\">{}<br><span class=\"unit\">design {design}</span></td>",
                significant(value, 4)
            )
        };
        if let (Some(first), Some(last)) = (sorted.first(), sorted.last()) {
            let _ = writeln!(
                rows,
                "<tr><td class=\"text\">{}</td>{}{}{}</tr>",
                escape(&heading(&measure)),
                cell(*first),
                cell(sorted[sorted.len() / 2]),
                cell(*last)
            );
        }
    }
    let description = match sweep.description.trim() {
        "" => String::new(),
        words => format!("{}.<br>", escape(words.trim_end_matches('.'))),
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n{MARKER}\n\
         <title>{name}: dyn-sim sweep</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <header>\n<h1>Sweep \u{201c}{name}\u{201d}</h1>\n<p class=\"headline\">{}</p>\n\
         <p class=\"facts\">{description}{} steps of {} s each.</p>\n</header>\n\
         <h2>Extremes</h2>\n<table>\n<thead><tr><th class=\"text\"></th><th>least</th><th>median</th><th>largest</th></tr></thead>\n\
         <tbody>\n{rows}</tbody></table>\n<p>Every design is a line of <a href=\"csv/designs.csv\">csv/designs.csv</a>.</p>\n\
         <h2>Figures</h2>\n{drawings}<h2>How to repeat it</h2>\n<pre>{}</pre>\n<pre>{}</pre>\n</body>\n</html>\n",
        escape(&headline(sweep, swept)),
        sweep.nominal.grid.steps,
        sweep.nominal.grid.step_s,
        escape(command),
        escape(&sweep.text),
    )
}
