//! With the feature `own-platform`: bakes the platform file that DYN_PLATFORM names into the library. Without it, nothing.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "own-platform")]
    if let Err(reason) = own_platform::bake() {
        for line in reason.lines() {
            println!("cargo::error={line}");
        }
        std::process::exit(1);
    }
}

#[cfg(feature = "own-platform")]
mod own_platform {
    use std::env::var_os;
    use std::path::PathBuf;

    use dyn_gen::emit::RuntimePath;
    use dyn_gen::{GraphFile, Numbers, Options, generate};
    use dyn_platform::Platform;

    /// Writes the model `baked::Model` and the platform's name where `src/model.rs` includes them.
    pub fn bake() -> Result<(), String> {
        println!("cargo::rerun-if-env-changed=DYN_PLATFORM");
        let Some(path) = var_os("DYN_PLATFORM").map(PathBuf::from) else {
            return Err("the feature `own-platform` bakes the platform file that the environment variable DYN_PLATFORM \
                        names; set it to an absolute path"
                .into());
        };
        println!("cargo::rerun-if-changed={}", path.display());
        let platform = Platform::from_file(&path).map_err(|error| format!("{error:?}"))?;
        let options = Options {
            model: "baked".into(),
            runtime: RuntimePath::new("::dyn_runtime").map_err(|error| error.to_string())?,
            functions: None,
            command: "cargo build -p dyn-capi --features own-platform".into(),
        };
        let graph = GraphFile::uhp().map_err(|error| error.to_string())?;
        let source =
            generate(&graph, Numbers::Baked(&platform), &options).map_err(|error| error.to_string())?.source;
        let folder = PathBuf::from(var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?);
        let write = |name: &str, text: &str| {
            std::fs::write(folder.join(name), text).map_err(|error| format!("{name}: {error}"))
        };
        write("baked.rs", &source)?;
        write("baked_name.rs", &format!("c{:?}", platform.name))
    }
}
