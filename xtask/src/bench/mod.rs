//! `bench`: generated code beside everything it is compared with, from nothing to the table of ratios.
//!
//! | module | holds |
//! |-|-|
//! | `peers` | other people's code: written, compiled, listed for the feature `peers` |
//! | `listing` | code size, stack, compile time |

mod listing;
mod peers;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use clap::Args;

use crate::runner::{Failure, not_started, succeed};
use crate::workspace;

/// Of `cargo xtask bench`.
#[derive(Args)]
pub struct Options {
    /// Measure only what contains this text
    filter: Option<String>,
    /// Measure this platform instead of the paper's (legs of type uhp)
    #[arg(long, value_name = "FILE.toml")]
    platform: Option<PathBuf>,
    /// Leave the instruction counts out, which compile everything once more
    #[arg(long)]
    no_counts: bool,
}

/// The paper's platform, from the root.
const DEFAULT_PLATFORM: &str = "platforms/uhp_2016.toml";
/// The model with some numbers at run time, in the folder of a platform, and its functions.
const PAYLOAD: &str = "payload.rs";
const COMPARED: &str = "inverse_dynamics,forward_dynamics,matrices";
/// States at which peers are compared with dyn-gen, and at which rounding errors are judged.
const STATES: &str = "16";
/// Callgrind of today's distributions stops at AVX-512, so counts are taken with AVX2.
const COUNTED: &str = "x86-64-v3";

/// Where everything lies.
struct Bench {
    /// The platform file, absolute.
    platform: PathBuf,
    /// Whether it is another one than the paper's.
    given: bool,
    /// Cargo's target folder for code compiled for this very processor.
    target: PathBuf,
    /// Inputs, peers and results of this platform.
    folder: PathBuf,
}

/// Prepares peers, measures, prints and writes the tables.
pub fn bench(options: &Options) -> Result<(), Failure> {
    let bench = Bench::new(options.platform.as_deref())?;
    say("preparing: numbers, states and the generated model of the platform");
    bench.describe_platform()?;
    let exact = bench.exact();
    let linked = peers::prepare(&bench.folder, &bench.folder.join("native"), "native")?;

    say(
        "measuring: figures of one run compare with each other, not with another run's; close other programs",
    );
    // What an earlier run left would stand for what is absent now.
    let _ = fs::remove_dir_all(bench.results());
    let mut measure = bench.cargo("native");
    measure.args(["bench", "--package", "dyn-benches", "--features", "peers", "--bench", "dynamics"]);
    measure.env("DYN_PEERS", &linked).env("CRITERION_HOME", bench.results());
    measure.env("DYN_BENCHES_WRITE", &bench.folder);
    if let Some(exact) = &exact {
        measure.env("DYN_EXACT", exact);
    }
    if let Some(filter) = &options.filter {
        measure.args(["--", filter]);
    }
    succeed(&mut measure)?;

    let pinocchio = bench.folder.with_file_name(peers::PINOCCHIO);
    if let Some(listing) = listing::text(&bench.target.join("release"), &bench.model(), &linked, &pinocchio) {
        println!("\n{listing}");
    }
    if !options.no_counts {
        bench.count()?;
    }
    println!("criterion's report: {}", bench.results().join("report/index.html").display());
    Ok(())
}

impl Bench {
    fn new(platform: Option<&Path>) -> Result<Self, Failure> {
        let file = platform.map_or_else(|| workspace::root().join(DEFAULT_PLATFORM), Path::to_owned);
        let file = fs::canonicalize(&file)
            .map_err(|error| Failure::new(format!("{}: {error}", file.display()), "name a platform file"))?;
        let target = dyn_python::target_directory(&workspace::root());
        let target = std::path::absolute(&target).unwrap_or(target);
        let name = file.file_stem().unwrap_or_default().to_owned();
        let folder = target.join("bench").join(name);
        fs::create_dir_all(&folder)
            .map_err(|error| Failure::new(format!("{}: {error}", folder.display()), ""))?;
        Ok(Self {
            platform: file,
            given: platform.is_some(),
            target: target.join("bench").join("native"),
            folder,
        })
    }

    /// Cargo compiling for `processor`, in a target folder of its own, so that other builds stay as they are.
    fn cargo(&self, processor: &str) -> Command {
        let mut cargo = workspace::cargo();
        cargo.env("CARGO_TARGET_DIR", self.target.with_file_name(processor));
        cargo.env("RUSTFLAGS", format!("-C target-cpu={processor}"));
        cargo.env("DYN_BENCHES_PAYLOAD", self.folder.join(PAYLOAD));
        if self.given {
            cargo.env("DYN_BENCHES_PLATFORM", &self.platform).env("DYN_BENCHES_MODEL", self.model());
        }
        cargo
    }

    fn model(&self) -> PathBuf {
        self.folder.join("model.rs")
    }

    fn results(&self) -> PathBuf {
        self.folder.join("criterion")
    }

    /// Generated model, states with results, and what dyn-gen decided, as files in the folder.
    fn describe_platform(&self) -> Result<(), Failure> {
        let dyn_gen = |arguments: &[&str]| {
            let mut cargo = self.cargo("native");
            cargo.args(["run", "--release", "--quiet", "--package", "dyn-gen", "--"]).args(arguments);
            cargo
        };
        let output = |name: &str| self.folder.join(name).to_string_lossy().into_owned();
        let platform = self.platform.to_string_lossy().into_owned();
        let (model, payload, vectors) = (output("model.rs"), output(PAYLOAD), output("vectors.json"));
        succeed(&mut dyn_gen(&["generate", &platform, "--scalar", "f64,f32", "-o", &model]))?;
        let at_run_time = ["--functions", COMPARED, "--runtime", "payload,gravity,legs.k_e", "-o", &payload];
        succeed(dyn_gen(&["generate", &platform]).args(at_run_time))?;
        succeed(&mut dyn_gen(&["vectors", &platform, "-n", STATES, "-o", &vectors]))?;
        let mut explain = dyn_gen(&["explain", &platform, "--json"]);
        let explained =
            explain.stderr(Stdio::inherit()).output().map_err(|error| not_started(&explain, &error))?;
        let path = self.folder.join("explained.json");
        fs::write(&path, explained.stdout)
            .map_err(|error| Failure::new(format!("{}: {error}", path.display()), ""))
    }

    /// Results in fifty digits; the committed ones serve for the paper's platform.
    fn exact(&self) -> Option<PathBuf> {
        if !self.given {
            return None;
        }
        let path = self.folder.join("exact.json");
        let made =
            workspace::environment("derivation", "codegen/requirements.lock").and_then(|environment| {
                let paths = std::env::join_paths(["codegen", "benches"]).unwrap_or_default();
                let mut python = environment.command();
                python.current_dir(workspace::root()).env("PYTHONPATH", paths).args(["-m", "peers.exact"]);
                python
                    .args(["--graph", "codegen/graphs/uhp.json", "--vectors"])
                    .arg(self.folder.join("vectors.json"));
                succeed(python.arg("--output").arg(&path))
            });
        match made {
            Ok(()) => Some(path),
            Err(failure) => {
                println!("absent: rounding errors: {}", one_line(&failure));
                None
            }
        }
    }

    /// Instructions per call; skipped without valgrind.
    fn count(&self) -> Result<(), Failure> {
        let installed =
            Command::new("valgrind").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        if installed.is_err() {
            println!("absent: instruction counts: valgrind is not installed");
            return Ok(());
        }
        say(&format!("counting instructions by callgrind, compiled for {COUNTED}"));
        let linked = peers::prepare(&self.folder, &self.folder.join(COUNTED), COUNTED)?;
        let mut count = self.cargo(COUNTED);
        count.args(["run", "--release", "--quiet", "--package", "dyn-benches", "--features", "peers"]);
        succeed(count.args(["--bin", "instruction_counts"]).env("DYN_PEERS", linked))
    }
}

/// A heading of a stage.
fn say(text: &str) {
    println!("\n== {text}");
    let _ = io::stdout().flush();
}

/// A failure as a reason in one line.
fn one_line(failure: &Failure) -> String {
    failure.to_string().replace("error: ", "").replace('\n', ";")
}
