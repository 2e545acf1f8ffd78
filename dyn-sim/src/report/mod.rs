//! The report of an experiment: one self-contained page, every curve as CSV, every figure as SVG.
//!
//! | module | holds |
//! | --- | --- |
//! | `analysis` | differences from the target, spectra, the window worth a close look |
//! | `curves` | CSV files |
//! | `table` | Table 4, for the page and for the screen, and the headline |
//! | `json` | tables for other programs |
//! | `figures` | which figures there are |
//! | `figure` | how a figure is laid out |
//! | `axis`, `decimate`, `svg` | ticks and labels, thinning, shapes |
//! | `drawing` | the platform |
//! | `page` | the HTML |
//! | `sweep` | table, figures and page of a sweep |
//! | `folder`, `error` | all or nothing on disk |

use std::path::{Path, PathBuf};

use crate::outcome::Outcome;

mod analysis;
mod axis;
mod curves;
mod decimate;
mod drawing;
mod error;
#[cfg(test)]
mod example;
mod figure;
mod figures;
mod folder;
mod json;
mod page;
mod svg;
mod sweep;
mod table;

pub use error::ReportError;
pub use json::tables_json;
pub use sweep::{sweep_json, sweep_summary, write_sweep};
pub use table::terminal_table;

/// Where everything went.
#[derive(Clone, Debug, PartialEq)]
pub struct ReportFiles {
    /// The report's folder, absolute.
    pub folder: PathBuf,
    /// The page to open.
    pub html: PathBuf,
    /// Curves.
    pub csv: Vec<PathBuf>,
    /// Figures.
    pub svg: Vec<PathBuf>,
    /// Tables for other programs, if wanted.
    pub tables: Option<PathBuf>,
}

/// Writes the report to `folder`, which appears under that name when it is complete.
///
/// Folders that lead to it are created; an earlier report there is replaced. `with_tables` adds `tables.json`.
///
/// # Errors
/// Something else stands there, the folder cannot be written to, or the disk is full. Then nothing of the new report
/// stays, and an earlier one is untouched.
pub fn write_report(outcome: &Outcome, folder: &Path, with_tables: bool) -> Result<ReportFiles, ReportError> {
    let staged = folder::StagedFolder::new(folder)?;
    let analysis = analysis::Analysis::new(outcome);

    let files = curves::curve_files(outcome, &analysis);
    let csv = files
        .iter()
        .map(|file| staged.write(&file.path, |out| file.write(out)))
        .collect::<Result<Vec<_>, _>>()?;

    let platform = drawing::platform_drawing(&outcome.platform);
    let drawn: Vec<page::Drawn> = figures::figures(outcome, &analysis)
        .into_iter()
        .map(|figure| page::Drawn { svg: figure.draw(), figure })
        .collect();
    let mut svg = vec![staged.write("svg/platform.svg", |out| out.write_all(platform.file().as_bytes()))?];
    for page::Drawn { figure, svg: drawing } in &drawn {
        let path = format!("svg/{}.svg", figure.name);
        svg.push(staged.write(&path, |out| out.write_all(drawing.file().as_bytes()))?);
    }

    let tables = if with_tables { Some(stage_tables(&staged, outcome)?) } else { None };
    let page = page::page(outcome, &platform, &drawn, &files);
    let html = staged.write(folder::MARKER_FILE, |out| out.write_all(page.as_bytes()))?;
    Ok(ReportFiles { folder: staged.publish()?, html, csv, svg, tables })
}

/// Writes `tables.json` alone to `folder`, as [`write_report`] does, and says where it is.
///
/// # Errors
/// As [`write_report`].
pub fn write_tables(outcome: &Outcome, folder: &Path) -> Result<PathBuf, ReportError> {
    let staged = folder::StagedFolder::new(folder)?;
    let tables = stage_tables(&staged, outcome)?;
    staged.publish()?;
    Ok(tables)
}

fn stage_tables(staged: &folder::StagedFolder, outcome: &Outcome) -> Result<PathBuf, ReportError> {
    staged.write(folder::TABLES, |out| writeln!(out, "{:#}", tables_json(outcome)))
}

#[cfg(test)]
mod tests;
