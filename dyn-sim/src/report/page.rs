//! The report's page: one HTML file with everything in it.

use std::fmt::Write;

use super::analysis::whole_run;
use super::curves::{COMPONENTS, CurveFile};
use super::figure::Figure;
use super::folder::MARKER;
use super::svg::{Svg, escape};
use super::table::{groups, headline, length, percent, plain, reference, significant, title};
use crate::outcome::{AmplitudeTable, Outcome};

const STYLE: &str = include_str!("page.css");
const UNITS: [&str; 6] = ["m/s²", "m/s²", "m/s²", "rad/s²", "rad/s²", "rad/s²"];

/// A figure, drawn.
pub(super) struct Drawn {
    pub(super) figure: Figure,
    pub(super) svg: Svg,
}

/// The whole page.
pub(super) fn page(outcome: &Outcome, platform: &Svg, figures: &[Drawn], files: &[CurveFile<'_>]) -> String {
    let sections = [
        opening(outcome),
        result(outcome),
        platform_section(outcome, platform),
        curves(outcome, figures),
        amplitudes(&outcome.amplitude_tables),
        procedure(outcome),
        reproduction(outcome),
        file_list(files, figures),
    ];
    let name = escape(&outcome.scenario_name);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n{MARKER}\n\
         <title>{name}: dyn-sim report</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
        sections.concat()
    )
}

/// Appends formatted text; writing to a String cannot fail.
macro_rules! put {
    ($html:expr, $($format:tt)*) => { let _ = write!($html, $($format)*); };
}

fn opening(outcome: &Outcome) -> String {
    let [start, end] = whole_run(outcome);
    let mut html = format!(
        "<header>\n<h1>Experiment \u{201c}{}\u{201d}: a parallel platform on a moving base</h1>\n\
         <p class=\"headline\">{}</p>\n<p class=\"facts\">{}Platform {}, {} s in steps of {} ms",
        escape(&outcome.scenario_name),
        escape(&headline(outcome)),
        description(outcome),
        escape(&outcome.platform.name),
        (1e6 * (end - start)).round() / 1e6,
        (1e9 * outcome.step_s).round() / 1e6,
    );
    let total: f64 = outcome.seconds.iter().map(|(_, seconds)| seconds).sum();
    if !outcome.seconds.is_empty() {
        put!(html, "; {} s of computing", significant(total, 2));
    }
    html += ".</p>\n";
    if !outcome.warnings.is_empty() {
        html += "<div class=\"warnings\"><ul>\n";
        for warning in &outcome.warnings {
            put!(html, "<li>{}</li>\n", escape(warning));
        }
        html += "</ul></div>\n";
    }
    html + "</header>\n"
}

/// The scenario's own words, with a line of their own.
fn description(outcome: &Outcome) -> String {
    match outcome.description.trim() {
        "" => String::new(),
        words => format!("{}.<br>", escape(words.trim_end_matches('.'))),
    }
}

fn result(outcome: &Outcome) -> String {
    let groups = groups(&outcome.amplitude_tables);
    let mut html = String::new();
    if !groups.is_empty() {
        put!(html, "<h2>{}</h2>\n", title(&outcome.amplitude_tables));
        html += "<p>Each cell compares complex amplitudes, so that an error of phase counts as well: \
                 |A<sub>simulated</sub> \u{2212} A<sub>target</sub>| / |A<sub>target</sub>|.</p>\n\
                 <div class=\"wide\"><table>\n<thead><tr><th>Hz</th><th class=\"text\"></th>";
        for component in COMPONENTS {
            put!(html, "<th>{component}</th>");
        }
        html += "</tr></thead>\n";
        for group in &groups {
            html += "<tbody class=\"group\">\n";
            for (number, row) in group.rows.iter().enumerate() {
                let class = if row.is_paper { "paper" } else { "ours" };
                let frequency = if number == 0 { group.frequency_hz.to_string() } else { String::new() };
                put!(html, "<tr class=\"{class}\"><th>{frequency}</th>");
                put!(html, "<td class=\"text\">{}</td>", escape(&row.label));
                for cell in &row.cells {
                    put!(html, "<td>{cell}</td>");
                }
                html += "</tr>\n";
            }
            html += "</tbody>\n";
        }
        html += "</table></div>\n";
        if groups.iter().flat_map(|group| &group.rows).any(|row| row.is_paper) {
            html += "<p>Paper: Table 4 of \u{201c}Dynamic Modeling and Simulation of a 6-UHP Parallel Platform under \
                     Base Excitation\u{201d}, ROBOT 38(6), 2016, doi 10.13973/j.cnki.robot.2016.0687.</p>\n";
        }
    }
    if !outcome.time_errors.is_empty() {
        put!(
            html,
            "<h2>Errors in the time domain</h2>\n<p>Largest differences from {}.</p>\n<table>\n\
             <thead><tr><th class=\"text\"></th><th>acceleration,<br>relative to its largest value</th>\
             <th>linear<br><span class=\"unit\">m/s²</span></th><th>angular<br><span class=\"unit\">rad/s²</span></th>\
             <th>position</th></tr></thead>\n<tbody>\n",
            escape(&reference(&outcome.time_errors[0]))
        );
        for error in &outcome.time_errors {
            put!(
                html,
                "<tr><td class=\"text\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                escape(&error.label),
                percent(error.acceleration_relative),
                significant(error.linear_m_s2, 2),
                significant(error.angular_rad_s2, 2),
                length(error.position_m)
            );
        }
        html += "</tbody></table>\n";
    }
    html
}

fn platform_section(outcome: &Outcome, drawing: &Svg) -> String {
    let platform = &outcome.platform;
    let mut html = format!(
        "<h2>The platform</h2>\n<figure>\n{}<figcaption>{} at home, {} mm above the base: obliquely, and from above \
         with the radii of both joint circles. The actuators are fixed to the base; the numbers are those of \
         the legs.</figcaption>\n</figure>\n",
        drawing.inline(),
        escape(&platform.name),
        plain(1e3 * platform.home.position[2])
    );
    let parameters = &platform.parameters;
    html += "<table>\n<thead><tr><th class=\"text\">leg</th>";
    for leg in 1..=6 {
        put!(html, "<th>{leg}</th>");
    }
    html += "</tr></thead>\n<tbody>\n";
    let rows = [
        ("rod length, mm", 1e3, "rod_length"),
        ("rod mass, kg", 1.0, "rod_mass"),
        ("mover mass, kg", 1.0, "mover_mass"),
        ("actuator length at rest, mm", 1e3, "rest_length"),
        ("axial stiffness, N/mm", 1e-3, "axial_stiffness"),
        ("axial damping, N s/m", 1.0, "axial_damping"),
    ];
    // Legs of other types lack some of these.
    for (name, factor, values) in rows.map(|(name, factor, key)| (name, factor, parameters.get(key))) {
        let Some(values) = values else { continue };
        put!(html, "<tr><td class=\"text\">{name}</td>");
        for value in values {
            put!(html, "<td>{}</td>", plain(factor * value));
        }
        html += "</tr>\n";
    }
    put!(html, "</tbody></table>\n<p>Payload: {} kg.</p>\n", plain(parameters.payload_mass));
    html
}

fn curves(outcome: &Outcome, figures: &[Drawn]) -> String {
    let mut html = "<h2>Curves and spectra</h2>\n".to_owned();
    if outcome.amplitude_tables.iter().any(|table| table.paper_percent.is_some()) {
        html += "<p>The base\u{2019}s disturbance, the platform\u{2019}s acceleration and its spectra are what the paper \
                 shows of this experiment in its Figures 7 to 9.</p>\n";
    }
    for (Drawn { figure, svg }, number) in figures.iter().zip(1..) {
        put!(
            html,
            "<figure id=\"{}\">\n<h3>{}</h3>\n{}<figcaption><b>Figure {number}.</b> {}</figcaption>\n</figure>\n",
            figure.name,
            escape(&figure.title),
            svg.inline(),
            escape(&figure.caption)
        );
    }
    html
}

fn amplitudes(tables: &[AmplitudeTable]) -> String {
    let mut html = String::new();
    if tables.is_empty() {
        return html;
    }
    html += "<h2>Amplitudes of the platform\u{2019}s acceleration</h2>\n<div class=\"wide\"><table>\n\
             <thead><tr><th>Hz</th><th class=\"text\"></th>";
    for (component, unit) in COMPONENTS.iter().zip(UNITS) {
        put!(html, "<th>{component}<br><span class=\"unit\">{unit}</span></th>");
    }
    html += "</tr></thead>\n";
    for (row, frequency) in tables[0].frequencies_hz.iter().enumerate() {
        html += "<tbody class=\"group\">\n";
        let simulated = tables.iter().map(|table| (table.label.as_str(), &table.amplitude));
        let lines = std::iter::once(("target", &tables[0].target_amplitude)).chain(simulated);
        for ((label, values), number) in lines.zip(0..) {
            let Some(values) = values.get(row) else { continue };
            let frequency = if number == 0 { frequency.to_string() } else { String::new() };
            put!(html, "<tr><th>{frequency}</th><td class=\"text\">{}</td>", escape(label));
            for value in values {
                put!(html, "<td>{}</td>", significant(*value, 7));
            }
            html += "</tr>\n";
        }
        html += "</tbody>\n";
    }
    html + "</table></div>\n"
}

fn procedure(outcome: &Outcome) -> String {
    let steps = if outcome.target.time_s.is_empty() {
        "The platform is free: only the actuator forces of the scenario and the motion of the base act on it."
    } else {
        "The inverse dynamics gives the actuator forces that the wanted motion of the platform needs while the base \
         moves. These forces and the motion of the base then drive each simulation, which knows nothing else of the \
         wanted motion, and the acceleration that comes out is compared with it."
    };
    format!(
        "<h2>How it was done</h2>\n<p>{steps} All quantities are in SI units and inertial axes; angular accelerations \
         are derivatives of the angular velocity, never of angles.</p>\n"
    )
}

fn reproduction(outcome: &Outcome) -> String {
    let mut html = format!(
        "<h2>How to repeat it</h2>\n<pre>{}</pre>\n<div class=\"columns\">\n",
        escape(&outcome.command)
    );
    if !outcome.versions.is_empty() {
        html += "<table>\n<thead><tr><th class=\"text\">tool</th><th class=\"text\">version</th></tr></thead>\n<tbody>\n";
        for (tool, version) in &outcome.versions {
            put!(
                html,
                "<tr><td class=\"text\">{}</td><td class=\"text\">{}</td></tr>\n",
                escape(tool),
                escape(version)
            );
        }
        html += "</tbody></table>\n";
    }
    if !outcome.seconds.is_empty() {
        html +=
            "<table>\n<thead><tr><th class=\"text\">step</th><th>wall time, s</th></tr></thead>\n<tbody>\n";
        for (step, seconds) in &outcome.seconds {
            put!(
                html,
                "<tr><td class=\"text\">{}</td><td>{}</td></tr>\n",
                escape(step),
                significant(*seconds, 3)
            );
        }
        html += "</tbody></table>\n";
    }
    put!(html, "</div>\n<h3>The scenario</h3>\n<pre>{}</pre>\n", escape(&outcome.scenario_text));
    html
}

fn file_list(files: &[CurveFile<'_>], figures: &[Drawn]) -> String {
    let mut html =
        "<h2>Files beside this page</h2>\n<p>The curves with every sample, units in the header line and \
                    numbers that read back exactly:</p>\n<table class=\"files\">\n<tbody>\n"
            .to_owned();
    for file in files {
        put!(
            html,
            "<tr><td class=\"text\"><a href=\"{0}\">{0}</a></td><td class=\"text\">{1}</td></tr>\n",
            file.path,
            escape(&file.about)
        );
    }
    html += "</tbody></table>\n<p>The drawings: <a href=\"svg/platform.svg\">svg/platform.svg</a>";
    for Drawn { figure, .. } in figures {
        put!(html, ", <a href=\"svg/{0}.svg\">svg/{0}.svg</a>", figure.name);
    }
    html + ".</p>\n"
}
