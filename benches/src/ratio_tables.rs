//! Times and ratios as tables: text for a terminal, Markdown for a document; all that is written of them.

use std::path::Path;

use crate::cases::{FUNCTIONS, IMPLEMENTATIONS};
use crate::ratio_plot;
use crate::ratios::{Ratio, Row, Summary};
use crate::results::{MEASURES, Time};
use crate::selection::Variant;
use crate::table;

/// A table with its caption.
struct Table {
    caption: &'static str,
    heading: Vec<&'static str>,
    rows: Vec<Vec<String>>,
    /// How many columns hold words.
    left: usize,
}

impl Summary {
    /// The tables, and what one must know to read them.
    pub fn text(&self) -> String {
        let variants = (!self.variants.is_empty()).then(|| self.variant_table());
        let tables = self.tables().into_iter().chain(variants);
        let tables = tables.map(|Table { caption, heading, rows, left }| {
            format!("{caption}\n{}\n", table::text(&heading, &rows, left))
        });
        format!("{}\n\n{}{}", self.circumstances(), tables.collect::<String>(), self.warnings())
    }

    /// The same in Markdown, without the variants of peers.
    pub fn markdown(&self) -> String {
        let tables = self.tables().into_iter().map(|Table { caption, heading, rows, left }| {
            format!("{caption}:\n\n{}\n", table::markdown(&heading, &rows, left))
        });
        format!("{}\n\n{}{}", self.circumstances(), tables.collect::<String>(), self.warnings())
    }

    /// In JSON.
    ///
    /// # Errors
    /// If it cannot be written so, in words.
    pub fn json(&self) -> Result<String, String> {
        serde_json::to_string_pretty(self).map(|json| json + "\n").map_err(|error| error.to_string())
    }

    /// Writes `ratios.json`, `ratios.svg` and `table.md` into a folder; says so, a line for each.
    ///
    /// # Errors
    /// If one cannot be written, in words.
    pub fn write(&self, folder: &Path) -> Result<String, String> {
        let [data, plot, table] = ["ratios.json", "ratios.svg", "table.md"].map(|name| folder.join(name));
        std::fs::write(&data, self.json()?).map_err(|error| refusal(&data, &error))?;
        std::fs::write(&table, self.markdown()).map_err(|error| refusal(&table, &error))?;
        ratio_plot::write(&plot, self).map_err(|error| refusal(&plot, &*error))?;
        Ok([data, plot, table].map(|path| format!("written: {}\n", path.display())).concat())
    }

    /// Processor and load.
    fn circumstances(&self) -> String {
        self.machine
            .as_ref()
            .map_or_else(|| "The benchmark has not ended.".into(), |machine| machine.text() + ".")
    }

    fn warnings(&self) -> String {
        let mut text = String::new();
        let mut times = self.rows.iter().flat_map(|row| row.nanoseconds.values());
        if times.any(Time::disturbed) {
            text +=
                "* disturbed: a median is more than 10 % above the fastest sample. Close other programs.\n";
        }
        if !self.one_run {
            text +=
                "These times come from different runs: their ratios mean little. Run all benchmarks again.\n";
        }
        text
    }

    /// Times, ratios, single calls.
    fn tables(&self) -> Vec<Table> {
        let mut tables = vec![self.times(), self.ratio_table()];
        if !self.single_calls.is_empty() {
            tables.push(self.tails());
        }
        tables
    }

    fn times(&self) -> Table {
        let time = |row: &Row, name: &str| {
            row.nanoseconds.get(name).map_or_else(
                || "absent".to_owned(),
                |time| format!("{:.1}{}", time.median, if time.disturbed() { "*" } else { "" }),
            )
        };
        let cells = |row: &Row| {
            let names = [row.function.clone(), row.measure.clone()];
            names.into_iter().chain(IMPLEMENTATIONS.map(|name| time(row, name))).collect()
        };
        Table {
            caption: "Nanoseconds per call, median",
            heading: ["function", "measure"].into_iter().chain(IMPLEMENTATIONS).collect(),
            rows: self.rows.iter().map(cells).collect(),
            left: 2,
        }
    }

    fn ratio_table(&self) -> Table {
        let cells = |row: &Ratio| {
            let mark = if row.disturbed { "*" } else { "" };
            let ratio = row.ratio.map_or_else(|| "absent".into(), |ratio| format!("{ratio:.2}{mark}"));
            vec![
                row.function.clone(),
                row.measure.clone(),
                row.ours.name().into(),
                row.against.clone(),
                ratio,
                verdict(row),
            ]
        };
        Table {
            caption: "How many times faster",
            heading: vec!["function", "measure", "ours", "against", "ratio", "target"],
            rows: self.ratios.iter().map(cells).collect(),
            left: 4,
        }
    }

    fn tails(&self) -> Table {
        let cell = |function: &str, name: &str| {
            let tail = self.single_calls.get(function).and_then(|row| row.get(name));
            tail.map_or_else(|| "absent".into(), |tail| format!("{} / {}", tail.median, tail.p99))
        };
        let functions = FUNCTIONS.iter().filter(|&&function| self.single_calls.contains_key(function));
        let rows = functions.map(|&function| {
            let cells = IMPLEMENTATIONS.map(|name| cell(function, name));
            [function.to_owned()].into_iter().chain(cells).collect()
        });
        Table {
            caption: "Nanoseconds of single calls, median / 99th percentile",
            heading: ["function"].into_iter().chain(IMPLEMENTATIONS).collect(),
            rows: rows.collect(),
            left: 1,
        }
    }

    fn variant_table(&self) -> Table {
        let cells = |row: &Variant| {
            let cell = |measure: &str| {
                let time = row.nanoseconds.get(measure).copied().unwrap_or(f64::NAN);
                let best = row.best.get(measure).copied().unwrap_or(false);
                format!("{}{time:.1}", if best { "best " } else { "" })
            };
            let [throughput, latency] = MEASURES.map(cell);
            vec![row.function.clone(), row.implementation.clone(), row.variant.clone(), throughput, latency]
        };
        Table {
            caption: "Variants of peers, nanoseconds per call in a short run",
            heading: vec!["function", "implementation", "variant", "throughput", "latency"],
            rows: self.variants.iter().map(cells).collect(),
            left: 3,
        }
    }
}

fn refusal(path: &Path, reason: &dyn std::error::Error) -> String {
    format!("{}: {reason}", path.display())
}

/// The factor aimed at and what became of it.
fn verdict(row: &Ratio) -> String {
    match (row.target, row.ratio) {
        (None, _) => String::new(),
        (Some(target), None) => format!("{target:.2} not measured"),
        (Some(target), Some(ratio)) if ratio >= target => format!("{target:.2} met"),
        (Some(target), Some(ratio)) => {
            format!("{target:.2} MISSED by {:.0} %", 100.0 * (1.0 - ratio / target))
        }
    }
}
