//! The report as a whole.

use std::fs;
use std::path::Path;

use super::*;

#[test]
fn the_page_shows_every_cell_and_needs_nothing_else() {
    let parent = tempfile::tempdir().expect("temporary folder");
    let outcome = example::outcome();
    let files = write_report(&outcome, &parent.path().join("reports/published"), false).expect("written");
    let page = fs::read_to_string(&files.html).expect("readable");

    let groups = table::groups(&outcome.amplitude_tables);
    assert_eq!(groups.len(), 3);
    for row in groups.iter().flat_map(|group| &group.rows) {
        let cells: String = row.cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
        assert!(page.contains(&cells), "{}: {cells}", row.label);
    }
    let paper = groups[1].rows.last().expect("rows");
    assert_eq!(paper.cells, ["0.70", "4.62", "2.38", "2.53", "5.40", "2.80"]);
    let exudyn = &groups[2].rows[1];
    assert_eq!((exudyn.label.as_str(), exudyn.cells[5].as_str()), ("Exudyn 1.13.8", "0.0040"));

    for external in ["http:", "https:", "//", "src=", "@import", "url(", "<script", "<link"] {
        assert!(!page.contains(external), "{external}");
    }
    for text in
        [outcome.command.as_str(), "duration_s = 0.2 # &lt; 1 &amp; more", "8 periods of 40 Hz", "1.13.8"]
    {
        assert!(page.contains(text), "{text}");
    }
}

#[test]
fn every_file_that_is_named_is_there() {
    let parent = tempfile::tempdir().expect("temporary folder");
    let files = write_report(&example::outcome(), &parent.path().join("report"), false).expect("written");
    let page = fs::read_to_string(&files.html).expect("readable");
    for path in files.csv.iter().chain(&files.svg) {
        assert!(path.is_file(), "{}", path.display());
        let relative = path.strip_prefix(&files.folder).expect("inside").display().to_string();
        assert!(page.contains(&format!("href=\"{relative}\"")), "{relative}");
    }
    assert_eq!(fs::read_dir(parent.path()).expect("readable").count(), 1, "no temporary folder stays");
    for path in &files.svg {
        let drawing = fs::read_to_string(path).expect("readable");
        assert!(drawing.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""), "{}", path.display());
        assert!(!drawing.contains("NaN") && drawing.contains("<text"), "{}", path.display());
    }
}

#[test]
fn an_unwritable_folder_leaves_nothing() {
    let parent = tempfile::tempdir().expect("temporary folder");
    let blocking = parent.path().join("file");
    fs::write(&blocking, "not a folder").expect("writable");
    let error =
        write_report(&example::outcome(), &blocking.join("report"), false).expect_err("a file is in the way");
    assert!(matches!(error, ReportError::Folder { .. }), "{error:?}");
    assert!(error.to_string().contains(&blocking.display().to_string()), "{error}");
    assert_eq!(fs::read_dir(parent.path()).expect("readable").count(), 1);

    let error = write_report(&example::outcome(), &blocking, false).expect_err("a file is in the way");
    assert!(matches!(error, ReportError::Occupied { .. }), "{error:?}");
    assert_eq!(fs::read_to_string(&blocking).expect("readable"), "not a folder");
}

#[test]
fn a_read_only_file_system_is_named() {
    if Path::new("/proc/self").exists() {
        let error =
            write_report(&example::outcome(), Path::new("/proc/report"), false).expect_err("not writable");
        assert!(error.to_string().contains("`/proc/report`"), "{error}");
    }
}

#[test]
fn a_run_that_stopped_early_or_had_no_target_is_still_shown() {
    let parent = tempfile::tempdir().expect("temporary folder");
    let mut outcome = example::outcome();
    for simulation in &mut outcome.simulations {
        simulation.time_s.truncate(57);
        simulation.acceleration.truncate(57);
        simulation.velocity.truncate(57);
        simulation.position_m.truncate(57);
        simulation.rotation.truncate(57);
        simulation.acceleration[56] = [f64::NAN; 6];
    }
    outcome.amplitude_tables[1].error_percent.clear();
    outcome.amplitude_tables[1].amplitude.clear();
    let files = write_report(&outcome, &parent.path().join("stopped"), false).expect("written");
    let page = fs::read_to_string(files.html).expect("readable");
    assert!(page.contains("Exudyn 1.13.8 did not run to the end"));

    outcome.target = crate::outcome::Series::default();
    outcome.amplitude_tables.clear();
    outcome.time_errors.clear();
    outcome.actuator_force_n.clear();
    outcome.simulations.truncate(1);
    let files = write_report(&outcome, &parent.path().join("free"), false).expect("written");
    let page = fs::read_to_string(files.html).expect("readable");
    assert!(page.contains("Free motion of the platform, simulated by dyn-gen."));

    outcome.simulations.clear();
    outcome.base = crate::outcome::Series::default();
    outcome.actuator_length_m.clear();
    write_report(&outcome, &parent.path().join("nothing"), false).expect("written");
}
