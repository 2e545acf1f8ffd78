//! The report of an experiment: one self-contained page, every curve as CSV, every figure as SVG.
//!
//! | module | holds |
//! | --- | --- |
//! | `analysis` | differences from the target, spectra, the window worth a close look |
//! | `curves` | CSV files |
//! | `table` | Table 4, for the page and for the screen, and the headline |
//! | `figures` | which figures there are |
//! | `figure` | how a figure is laid out |
//! | `axis`, `decimate`, `svg` | ticks and labels, thinning, shapes |
//! | `drawing` | the platform |
//! | `page` | the HTML |
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
mod page;
mod svg;
mod table;

pub use error::ReportError;
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
}

/// Writes the report to `folder`, which appears under that name when it is complete.
///
/// Folders that lead to it are created; an earlier report there is replaced.
///
/// # Errors
/// Something else stands there, the folder cannot be written to, or the disk is full. Then nothing of the new report
/// stays, and an earlier one is untouched.
pub fn write_report(outcome: &Outcome, folder: &Path) -> Result<ReportFiles, ReportError> {
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

    let page = page::page(outcome, &platform, &drawn, &files);
    let html = staged.write(folder::MARKER_FILE, |out| out.write_all(page.as_bytes()))?;
    Ok(ReportFiles { folder: staged.publish()?, html, csv, svg })
}

#[cfg(test)]
mod tests;
