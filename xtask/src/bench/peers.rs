//! Other people's code for the functions that dyn-gen generates, compiled into a library under `target/`: C by CasADi, and
//! Pinocchio in C++. What cannot be had is said in one line and left out.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::thread;
use std::time::Instant;

use super::{one_line, say};
use crate::runner::{Failure, succeed};
use crate::workspace;

/// Compilers of C with their C++ halves.
const COMPILERS: [(&str, &str, &str); 2] = [("gcc", "g++", "gcc"), ("clang", "clang++", "clang")];
/// Flags besides optimisation and processor: as they are, and with liberties that Rust never takes.
const LIBERTIES: [(&str, &str); 2] = [("strict", ""), ("fast", "-ffast-math")];
/// Macros that Pinocchio's own build defines.
const PINOCCHIO_MACROS: [&str; 5] = [
    "-DNDEBUG",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
];
/// Where Debian's package libeigen3-dev puts its headers.
const EIGEN: &str = "/usr/include/eigen3";

/// Pinocchio's object, beside the folders of the platforms.
pub const PINOCCHIO: &str = "pinocchio_peer.o";

/// A row of the index that `python -m peers` writes: function, implementation, way, symbol.
struct Source {
    function: String,
    implementation: String,
    way: String,
    symbol: String,
}

/// Fills `folder` with a library and its table for `benches/build.rs`, made from what `inputs` holds about the platform and
/// compiled for `processor`. Returns `folder`.
pub fn prepare(inputs: &Path, folder: &Path, processor: &str) -> Result<PathBuf, Failure> {
    say(&format!("preparing peers for {processor}"));
    fs::create_dir_all(folder).map_err(|error| unusable(folder, &error))?;
    let mut table = Table::default();
    match casadi_sources(inputs) {
        Ok(sources) => table.peers = compile_casadi(inputs, folder, processor, &sources)?,
        Err(failure) => println!("absent: casadi_c_same, casadi_c_naive: {}", one_line(&failure)),
    }
    match pinocchio(&inputs.with_file_name(PINOCCHIO)) {
        Ok(object) => table.pinocchio = Some(object),
        Err(reason) => println!("absent: pinocchio: {reason}"),
    }
    let library = folder.join("libpeers.a");
    let _ = fs::remove_file(&library);
    succeed(Command::new("ar").arg("crs").arg(&library).args(table.objects()))?;
    let path = folder.join("peers.rs");
    // A table that is written again is compiled again, and everything that is measured with it.
    let text = table.text();
    if fs::read_to_string(&path).ok().as_ref() != Some(&text) {
        fs::write(&path, text).map_err(|error| unusable(&path, &error))?;
    }
    Ok(folder.to_owned())
}

/// The C sources, written by CasADi beside the inputs.
fn casadi_sources(inputs: &Path) -> Result<Vec<Source>, Failure> {
    let environment = workspace::environment("derivation", "codegen/requirements.lock")?;
    let folder = inputs.join("c");
    let paths = std::env::join_paths(["codegen", "benches"]).unwrap_or_default();
    let mut python = environment.command();
    python.current_dir(workspace::root()).env("PYTHONPATH", paths).args(["-m", "peers"]);
    python.arg("--vectors").arg(inputs.join("vectors.json"));
    python.arg("--explained").arg(inputs.join("explained.json"));
    succeed(python.arg("--folder").arg(&folder))?;
    let index = folder.join("index.tsv");
    let text = fs::read_to_string(&index).map_err(|error| unusable(&index, &error))?;
    let source = |line: &str| match line.split('\t').collect::<Vec<_>>()[..] {
        [function, implementation, way, symbol] => Some(Source {
            function: function.into(),
            implementation: implementation.into(),
            way: way.into(),
            symbol: symbol.into(),
        }),
        _ => None,
    };
    let sources: Option<Vec<Source>> = text.lines().map(source).collect();
    sources.ok_or_else(|| Failure::new(format!("{}: not an index", index.display()), ""))
}

/// A compiler to be run.
struct Job {
    source: PathBuf,
    peer: Entry,
    command: Command,
}

impl Job {
    /// Whether an earlier run compiled it and its source has not changed since.
    fn is_done(&self) -> bool {
        seconds_of(&self.peer.object).is_file() && is_younger(&self.peer.object, &self.source)
    }
}

/// Where the time is kept that an object took to compile.
pub fn seconds_of(object: &Path) -> PathBuf {
    object.with_extension("seconds")
}

/// Whether both are there and `object` was written later.
fn is_younger(object: &Path, source: &Path) -> bool {
    let written = |path: &Path| fs::metadata(path).and_then(|file| file.modified()).ok();
    written(object).is_some_and(|object| written(source).is_some_and(|source| source < object))
}

/// Every source by every compiler with all flags, as many at once as there are processors.
fn compile_casadi(
    inputs: &Path,
    folder: &Path,
    processor: &str,
    sources: &[Source],
) -> Result<Vec<Entry>, Failure> {
    let mut jobs = Vec::new();
    for (compiler, _, package) in COMPILERS {
        if !is_installed(compiler) {
            println!("absent: peers compiled by {compiler}: not installed (apt-get install {package})");
            continue;
        }
        for source in sources {
            jobs.extend(LIBERTIES.map(|liberty| job(inputs, folder, processor, source, compiler, liberty)));
        }
    }
    let (kept, jobs): (Vec<Job>, Vec<Job>) = jobs.into_iter().partition(Job::is_done);
    println!("compiling {} variants of CasADi's C, {} are there", jobs.len(), kept.len());
    let queue = Mutex::new(jobs.into_iter());
    let next = || queue.lock().ok()?.next();
    let work = || {
        let mut done = Vec::new();
        while let Some(Job { peer, mut command, .. }) = next() {
            let started = Instant::now();
            succeed(&mut command)?;
            let path = seconds_of(&peer.object);
            let seconds = format!("{:.2}", started.elapsed().as_secs_f64());
            fs::write(&path, seconds).map_err(|error| unusable(&path, &error))?;
            done.push(peer);
        }
        Ok(done)
    };
    let count = thread::available_parallelism().map_or(1, usize::from);
    let results: Vec<Result<Vec<Entry>, Failure>> = thread::scope(|scope| {
        let workers: Vec<_> = (0..count).map(|_| scope.spawn(work)).collect();
        let died = |_| Err(Failure::new("a thread that compiles peers died", ""));
        workers.into_iter().map(|worker| worker.join().unwrap_or_else(died)).collect()
    });
    let mut peers: Vec<Entry> = kept.into_iter().map(|job| job.peer).collect();
    for result in results {
        peers.extend(result?);
    }
    peers.sort_by(|one, other| one.symbol.cmp(&other.symbol));
    Ok(peers)
}

fn job(
    inputs: &Path,
    folder: &Path,
    processor: &str,
    source: &Source,
    compiler: &str,
    (suffix, liberty): (&str, &str),
) -> Job {
    let symbol = format!("{}_{compiler}_{suffix}", source.symbol);
    let object = folder.join(&symbol).with_extension("o");
    let mut command = Command::new(compiler);
    command.args(["-O3", &format!("-march={processor}"), "-c"]);
    command.args(Some(liberty).filter(|flag| !flag.is_empty()));
    command.args(["-DCASADI_SYMBOL_EXPORT=static", &format!("-DPEER={symbol}")]);
    let text = inputs.join("c").join(&source.symbol).with_extension("c");
    command.arg(&text).arg("-o").arg(&object);
    let flags = format!("-O3 -march={processor} {liberty}");
    let peer = Entry {
        function: source.function.clone(),
        implementation: source.implementation.clone(),
        variant: format!("{}, {compiler} {}", source.way, flags.trim_end()),
        symbol,
        object,
    };
    Job { source: text, peer, command }
}

/// Pinocchio's part, compiled once for all platforms: a minute or two, so an object younger than its source is kept. Or why
/// there is none.
///
/// From headers alone, for any x86-64: instructions of the very processor make it slower.
fn pinocchio(object: &Path) -> Result<PathBuf, String> {
    let source = workspace::root().join("benches/peers/pinocchio_peer.cpp");
    if is_younger(object, &source) {
        return Ok(object.to_owned());
    }
    let compilers = COMPILERS.iter().rev().map(|(_, compiler, _)| *compiler);
    let compiler = compilers.into_iter().find(|&compiler| is_installed(compiler)).ok_or("no C++ compiler")?;
    if !Path::new(EIGEN).is_dir() {
        return Err("no headers of Eigen (apt-get install libeigen3-dev)".into());
    }
    let environment = workspace::environment("engines", "tests/engines/requirements.lock")
        .map_err(|failure| one_line(&failure))?;
    let headers = headers(environment.folder()).ok_or("the wheel of Pinocchio has no headers")?;
    println!("compiling Pinocchio's constrained dynamics with {compiler} (a minute or two)");
    let mut compile = Command::new(compiler);
    compile.args(["-std=c++17", "-O3", "-w", "-c"]).args(PINOCCHIO_MACROS);
    compile.arg("-I").arg(headers).args(["-I", EIGEN]).arg(source).arg("-o").arg(object);
    succeed(&mut compile).map_err(|failure| one_line(&failure))?;
    Ok(object.to_owned())
}

/// `lib/python3.*/site-packages/cmeel.prefix/include` of an environment.
fn headers(environment: &Path) -> Option<PathBuf> {
    let versions = fs::read_dir(environment.join("lib")).ok()?;
    versions
        .filter_map(|entry| Some(entry.ok()?.path().join("site-packages/cmeel.prefix/include")))
        .find(|folder| folder.join("pinocchio").is_dir())
}

fn is_installed(program: &str) -> bool {
    let status = Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.is_ok_and(|status| status.success())
}

/// A compiled peer.
struct Entry {
    function: String,
    implementation: String,
    variant: String,
    symbol: String,
    object: PathBuf,
}

/// What is in the library, and the tables of `benches/src/peers.rs`.
#[derive(Default)]
struct Table {
    peers: Vec<Entry>,
    /// Pinocchio's object.
    pinocchio: Option<PathBuf>,
}

impl Table {
    fn objects(&self) -> impl Iterator<Item = &Path> {
        self.peers.iter().map(|peer| &peer.object).chain(&self.pinocchio).map(PathBuf::as_path)
    }

    fn text(&self) -> String {
        let mut text = String::from("unsafe extern \"C\" {\n");
        for Entry { symbol, .. } in &self.peers {
            let _ = writeln!(text, "    fn {symbol}(inputs: *const *const f64, outputs: *const *mut f64);");
        }
        if self.pinocchio.is_some() {
            text += PINOCCHIO_ENTRIES;
        }
        text += "}\nstatic PEERS: &[Peer] = &[\n";
        for Entry { function, implementation, variant, symbol, .. } in &self.peers {
            let _ = writeln!(
                text,
                "    Peer {{ function: {function:?}, implementation: {implementation:?}, variant: {variant:?}, \
                 entry: {symbol} }},"
            );
        }
        text += "];\n";
        text += if self.pinocchio.is_some() { PINOCCHIO_TABLE } else { NO_PINOCCHIO };
        text
    }
}

/// Declarations of the entries of benches/peers/pinocchio_peer.cpp.
const PINOCCHIO_ENTRIES: &str = "    \
    fn pinocchio_new(numbers: *const f64, states: *const f64, count: usize) -> *mut c_void;
    fn pinocchio_forward_dynamics(peer: *mut c_void, state: *const f64, index: usize, output: *mut f64);
    fn pinocchio_free(peer: *mut c_void);
";
/// The table of them.
const PINOCCHIO_TABLE: &str = "static PINOCCHIO: Option<PinocchioFunctions> = Some(PinocchioFunctions {
    new: pinocchio_new, forward_dynamics: pinocchio_forward_dynamics, free: pinocchio_free,
});
";
const NO_PINOCCHIO: &str = "static PINOCCHIO: Option<PinocchioFunctions> = None;\n";

fn unusable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::new(format!("{}: {error}", path.display()), "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_declares_what_it_lists() {
        let mut table = Table::default();
        assert!(table.text().contains("PEERS: &[Peer] = &[\n];") && table.text().contains("= None;"));
        table.peers.push(Entry {
            function: "matrices".into(),
            implementation: "casadi_c_same".into(),
            variant: "gcc -O3".into(),
            symbol: "entry_1".into(),
            object: "entry_1.o".into(),
        });
        table.pinocchio = Some("pinocchio.o".into());
        assert_eq!(table.objects().count(), 2);
        let text = table.text();
        for expected in ["fn entry_1(", "entry: entry_1", "variant: \"gcc -O3\"", "new: pinocchio_new"] {
            assert!(text.contains(expected), "{text}");
        }
    }
}
